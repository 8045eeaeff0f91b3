//! The rule that a method is in exact arithmetic, where segments have the nodes that it needs.

use super::rule::{Depth, Law, Place, Power, Rule, Scheme, Segment, Shape, Stop, StopBy, Weight};
use crate::method::{
    Accumulation, Compositing, CompositingOrder, Exponential, Inner, Layers, Method, Nested,
    OpacityFormula, Position, Scope,
};
use crate::quadrature;
use rug::Rational;

/// The rule of a method.
///
/// Compositing has one sample a segment. Nested rules have several, as long as they look at no more than the ends and the
/// middle of one segment: Simpson's and Boole's rule as outer ones take several segments at once, and Gauss's nodes
/// lie elsewhere. Pre-integration follows the field within segments.
#[must_use]
pub fn stated(method: &Method) -> Option<Rule> {
    match method {
        Method::Composited(compositing) => Some(of_compositing(compositing)),
        Method::Nested(nested) => of_nested(nested),
        Method::Preintegrated(_) => None,
        Method::Layered(layers) => of_layers(*layers),
    }
}

/// All but the logarithmic mean, which is no sum of emissions, and Bézier curves, which look at the layers beside.
fn of_layers(layers: Layers) -> Option<Rule> {
    let at = |parts: [(u32, u32); 3]| parts.map(Rational::from);
    let ends = || at([(1, 2), (0, 1), (1, 2)]);
    let of_trapezoid = |weights| Scheme::Segments {
        depth: ends(),
        weights,
        scale: super::rule::Scale::default(),
    };
    let voxel = |passes| Scheme::Sample {
        place: Place::Middle,
        law: neglecting(Shape::Exponential, passes),
    };
    let scheme = match layers {
        Layers::Linear => of_trapezoid(Segment::LinearInDepth { swapped: false }),
        Layers::Mean => of_trapezoid(Segment::Opacity { parts: ends() }),
        Layers::Logarithmic | Layers::Bezier(_) => return None,
        Layers::HalfCells => of_trapezoid(Segment::Halves),
        Layers::Middle => of_trapezoid(Segment::Quadrature {
            parts: at([(0, 1), (1, 1), (0, 1)]),
            half: at([(1, 4), (0, 1), (1, 4)]),
        }),
        Layers::HalfOwn => voxel(Power::HALF),
        Layers::WholeOwn => voxel(Power::ONE),
    };
    Some(Rule {
        scheme,
        ..Rule::default()
    })
}

fn of_compositing(compositing: &Compositing) -> Rule {
    let has_depths = matches!(
        compositing.order,
        CompositingOrder::FrontToBack {
            depth: Accumulation::Depths,
            ..
        }
    );
    let law = match (compositing.opacity, has_depths) {
        (OpacityFormula::Linear, true) => neglecting(Shape::Exponential, Power::ZERO),
        (OpacityFormula::Linear, false) => Law {
            shape: Shape::Linear,
            ..Law::default()
        },
        (OpacityFormula::Subtraction | OpacityFormula::Expm1 | OpacityFormula::Relative, _) => {
            Law::default()
        }
    };
    Rule {
        scheme: Scheme::Sample {
            place: match compositing.position {
                Position::Front => Place::Front,
                Position::Middle => Place::Middle,
                Position::Back => Place::Back,
            },
            law,
        },
        stop: compositing.threshold().map(|threshold| Stop {
            by: StopBy::Transmittance,
            under: threshold.value().to_f64(),
            before: false,
            cut: false,
            renormalised: false,
        }),
        ..Rule::default()
    }
}

/// τ d under a power of the transmittance inside the segment.
fn neglecting(shape: Shape, passes: Power) -> Law {
    Law {
        shape,
        weight: Weight::Depth {
            depth: Depth::default(),
            passes,
        },
        ..Law::default()
    }
}

fn of_nested(nested: &Nested) -> Option<Rule> {
    let Inner::PerSegment(inner) = nested.inner else {
        return None;
    };
    let scheme = match nested.exponential {
        Exponential::Exact => of_rules(inner, nested.outer.0)?,
        // A polynomial of the whole depth is no product over segments.
        _ if nested.scope == Scope::Whole => return None,
        Exponential::Linear => of_one_end(inner, nested.outer.0, Shape::Linear)?,
        Exponential::Quadratic => of_one_end(inner, nested.outer.0, Shape::Quadratic)?,
        Exponential::Cubic => return None,
    };
    Some(Rule {
        scheme,
        ..Rule::default()
    })
}

/// Both rules at the same end of segments.
fn of_one_end(inner: quadrature::Rule, outer: quadrature::Rule, shape: Shape) -> Option<Scheme> {
    use quadrature::Rule::{RiemannLeft, RiemannRight};
    let (place, passes) = match (inner, outer) {
        (RiemannLeft, RiemannLeft) => (Place::Front, Power::ZERO),
        (RiemannRight, RiemannRight) => (Place::Back, Power::ONE),
        _ => return None,
    };
    Some(Scheme::Sample {
        place,
        law: neglecting(shape, passes),
    })
}

fn of_rules(inner: quadrature::Rule, outer: quadrature::Rule) -> Option<Scheme> {
    if let Some(scheme) = of_one_end(inner, outer, Shape::Exponential) {
        return Some(scheme);
    }
    // Laid over the boundaries, it takes several segments at once.
    if outer.intervals().is_some_and(|intervals| intervals > 1) {
        return None;
    }
    let parts = at_three(outer, &Rational::from(1))?;
    let half = if parts[1].is_zero() {
        Default::default()
    } else {
        at_three(inner, &Rational::from((1, 2)))?
    };
    Some(Scheme::Segments {
        depth: at_three(inner, &Rational::from(1))?,
        weights: Segment::Quadrature { parts, half },
        scale: super::rule::Scale::default(),
    })
}

/// The weights in front, in the middle and at the back of a segment of a rule on its first part, where the rule has no
/// nodes elsewhere.
fn at_three(rule: quadrature::Rule, part: &Rational) -> Option<[Rational; 3]> {
    // Gauss's nodes are rounded to the bits asked for, and never in the middle but for one point.
    let table = rule.table(64).ok()?;
    let mut weights: [Rational; 3] = Default::default();
    for (node, weight) in table.nodes.iter().zip(&table.weights) {
        let place: Rational = Rational::from(node * part) * 2;
        let slot = place
            .is_integer()
            .then(|| place.numer().to_usize())
            .flatten()
            .and_then(|at| weights.get_mut(at))?;
        *slot += Rational::from(weight * part);
    }
    Some(weights)
}
