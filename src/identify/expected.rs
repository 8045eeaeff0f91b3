//! What a kernel is to compute: the rule that it declares, or the one of the same places without faults.

use super::deviation::right_of;
use super::rule::{Lattice, Law, Place, Rule, Scheme, Shape, Wall};
use super::{Identification, stated};
use crate::kernel::{Declaration, Sampling};
use crate::method::{Expected, Exponential, Inner, Layers, Method, Nested, Outer, Scope};
use crate::quadrature;

/// Thresholds are told to this part of them.
const SAME: f64 = 1e-6;

/// The rules of which a kernel is to have one.
///
/// A declared method states its rule; else it is that of the places that were found, or where no rule is named, one sample
/// a segment in the place that was found, declared, or in each of the three. What else is declared is no deviation.
pub(super) fn expected(found: &Identification, declaration: &Declaration) -> Vec<Rule> {
    let declared = declaration.method.as_ref().and_then(stated);
    let rules = match (found.named(), declared) {
        (Some(rule), Some(declared)) => vec![Rule {
            lattice: rule.lattice.map(Lattice::covering),
            ..declared
        }],
        (Some(rule), None) => vec![Rule {
            lattice: rule.lattice.map(Lattice::covering),
            ..of_order(rule, declaration).unwrap_or_else(|| placed(right_of(rule), declaration))
        }],
        (None, Some(declared)) => vec![declared],
        (None, None) => sampled(found, declaration),
    };
    let but_for = |rule| but_for(on_lattice(rule, found), found, declaration);
    rules.into_iter().map(but_for).collect()
}

/// The rule of layers, of Riemann sums or of an implicit step that it is, where that has the order that is declared: nobody
/// who asks for no more errs by it.
fn of_order(found: &Rule, declaration: &Declaration) -> Option<Rule> {
    let claimed = declaration.order?;
    let place = place(declaration);
    let riemann = [
        quadrature::Rule::RiemannLeft,
        quadrature::Rule::RiemannRight,
    ]
    .map(|rule| {
        Method::Nested(Nested {
            inner: Inner::PerSegment(rule),
            outer: Outer(rule),
            exponential: Exponential::Exact,
            scope: Scope::Whole,
        })
    });
    let layered = Layers::ALL.into_iter().map(Method::Layered);
    let mut rules = layered.chain(riemann).filter_map(|method| {
        let suffices = matches!(method.order(), Expected::Order(own) if own >= claimed);
        stated(&method).filter(|_| suffices)
    });
    let of_steps = implicit(found, place).filter(|(_, own)| *own >= claimed);
    let of_steps = of_steps.map(|(rule, _)| rule);
    let known = rules.find(|rule| {
        let is_placed = match (&rule.scheme, place) {
            (Scheme::Sample { place, .. }, Some(declared)) => *place == declared,
            (Scheme::Sample { .. } | Scheme::Segments { .. }, _) => true,
        };
        is_placed && rule.scheme == found.scheme
    });
    known.or(of_steps)
}

/// dI/dλ = τ (I − C) in one implicit step a segment, and its order: Euler's, which lets 1/(1 + x) through, and the midpoint's,
/// (1 − x/2)/(1 + x/2), with C and τ where they are sampled.
fn implicit(found: &Rule, declared: Option<Place>) -> Option<(Rule, f64)> {
    let Scheme::Sample { place, law } = &found.scheme else {
        return None;
    };
    let of_step = match law.shape {
        Shape::Reciprocal => 1.0,
        Shape::CrankNicolson => 2.0,
        Shape::Exponential | Shape::Linear | Shape::Quadratic | Shape::Clear => return None,
    };
    let of_place = match place {
        Place::Front | Place::Back => 1.0,
        Place::Middle => 2.0,
    };
    let plain = Law {
        shape: law.shape,
        ..Law::default()
    };
    let is_plain = *law == plain && declared.is_none_or(|declared| declared == *place);
    let scheme = Scheme::Sample {
        place: *place,
        law: plain,
    };
    let rule = Rule {
        scheme,
        ..Rule::default()
    };
    is_plain.then_some((rule, f64::min(of_step, of_place)))
}

/// Where a declaration says that the one sample of a segment lies.
fn place(declaration: &Declaration) -> Option<Place> {
    match declaration.sampling? {
        Sampling::Front => Some(Place::Front),
        Sampling::Middle => Some(Place::Middle),
        Sampling::Back => Some(Place::Back),
        Sampling::Ends | Sampling::Jittered => None,
    }
}

/// With the one sample of a segment where it is declared to lie.
fn placed(right: Rule, declaration: &Declaration) -> Rule {
    let scheme = match (right.scheme, place(declaration)) {
        (Scheme::Sample { law, .. }, Some(place)) => Scheme::Sample { place, law },
        (scheme, _) => scheme,
    };
    Rule { scheme, ..right }
}

fn sampled(found: &Identification, declaration: &Declaration) -> Vec<Rule> {
    let places = match place(declaration).or(found.parts.place) {
        Some(place) => vec![place],
        None => vec![Place::Front, Place::Middle, Place::Back],
    };
    let rule = |place| Rule {
        scheme: Scheme::Sample {
            place,
            law: Law::default(),
        },
        ..Rule::default()
    };
    places.into_iter().map(rule).collect()
}

/// As the rule of a kernel is written whose samples lie on a lattice: as if in the middle, where they lie as they are to.
fn on_lattice(right: Rule, found: &Identification) -> Rule {
    let Some(named) = found.named() else {
        return right;
    };
    let lattice = found.optics.map(|optics| optics.lattice).or(named.lattice);
    let (Some(lattice), Scheme::Sample { place: own, .. }) = (lattice, &named.scheme) else {
        return right;
    };
    let (Lattice::Steps { place: part, .. } | Lattice::Even { place: part, .. }) = lattice;
    let Scheme::Sample { place, law } = right.scheme.clone() else {
        return right;
    };
    let wanted = match place {
        Place::Front => 0.0,
        Place::Middle => 0.5,
        Place::Back => 1.0,
    };
    let place = if (part - wanted).abs() <= SAME {
        *own
    } else {
        place
    };
    let scheme = Scheme::Sample { place, law };
    Rule { scheme, ..right }
}

/// With the wall and the quantum that are declared.
fn but_for(right: Rule, found: &Identification, declaration: &Declaration) -> Rule {
    let mut right = right;
    let named = found.named();
    if declaration.far_wall {
        right.wall = match named {
            Some(rule) => rule.wall,
            None => Some(Wall::Opaque),
        };
    }
    let own = match named {
        Some(rule) => rule.output.quantum,
        None => found.parts.output.and_then(|output| output.quantum),
    };
    if let (Some(declared), Some(own)) = (declaration.fixed_quantum(), own)
        && (declared - own).abs() <= 1e-9 * declared
    {
        right.output.quantum = Some(own);
    }
    // A threshold that was bisected is the declared one, but for its last digits.
    if let (Some(stop), Some(own)) = (&mut right.stop, named.and_then(|rule| rule.stop))
        && (stop.under - own.under).abs() <= SAME * stop.under
    {
        stop.under = own.under;
    }
    right
}
