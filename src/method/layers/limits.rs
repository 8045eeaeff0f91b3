//! The orders of layer rules.
//!
//! Depths by the trapezoid rule or by middles have order 2. What a layer's light errs by itself is, expanded about its
//! middle with C as a function of t and x the layer's depth,
//!
//! ```text
//! linear in depth:    x³ C″/12 + O(d⁴)
//! mean of ends:       x³ (C′ + C″)/12 + O(d⁴)
//! logarithmic mean:   that of the mean, less x (Cb − Cf)²/(12 C)
//! half cells:         x³ (2 C″ − C′)/24 where τ is constant, and else as small
//! middle, half own:   what a sample in the middle errs by, and −x³ C/24
//! whole own:          −x² C/2
//! ```
//!
//! so that all sum up to O(d²), but the whole own voxel to O(d).
//!
//! Bézier curves of both degrees have the integral d (f + b)/2 + d² (f′f − f′b)/12, the trapezoid rule with the first
//! correction of Euler and Maclaurin, for any derivatives: in the sum those of inner places cancel, but for what the
//! weights differ, O(d⁴) for derivatives of order 2 (and O(d⁴) where a monotone one is 0 in a few places). At the ends of the
//! ray the derivative is a slope, off by d f″/2. That leaves O(d³),
//!
//! ```text
//! d³/24 [τ″ (C − I) + C″ τ − C′ τ′] in front and d³/24 T [τ″ C + C″ τ − C′ τ′] at the far end
//! ```
//!
//! with derivatives along the ray. A point that is cut off, beside an extremum, moves one curve by O(d²) and the sum by
//! O(d³), but how much depends on where in its layer the extremum lies: errors scatter, and theory says nothing.
//!
//! With depths that are exact, rules between ends and curves are exact where C is constant, and the linear one and
//! curves where C is linear in t; voxels never are.
//!
//! A break inside a layer is met as by the rule that looks at the same places; but where C and τ both jump the product
//! of two means is no mean of products, nor is a logarithmic mean one: there the order is 1 wherever the jump is. Curves
//! err by O(d^(1+α)) wherever the break lies: on a node too, since one derivative there is none of both sides'.

use super::{Layers, Limiter};
use crate::case::{Break, Structure};
use crate::method::breaks::Meeting;
use crate::method::limit::{Limit, Part};
use crate::quadrature::Rule;
use rug::Rational;

impl Layers {
    /// What limits the order on a case of that structure, breaks lying off the nodes.
    #[must_use]
    pub fn limits(&self, structure: &Structure) -> Vec<Limit> {
        self.limits_at(structure, None)
    }

    /// What limits the order on these numbers of layers, where each break has its known place.
    #[must_use]
    pub fn limits_on(&self, structure: &Structure, ladder: &[u64]) -> Vec<Limit> {
        self.limits_at(structure, Some(ladder))
    }

    fn limits_at(self, structure: &Structure, ladder: Option<&[u64]>) -> Vec<Limit> {
        if structure.source_is_zero() {
            return Vec::new();
        }
        let mut limits: Vec<Limit> = self.of_source(structure).into_iter().collect();
        limits.extend(self.own_attenuation());
        for place in &structure.breaks {
            limits.extend(self.of_break(place, ladder));
        }
        limits
    }

    /// The rule for the depth, and that for the source at the same places.
    fn rules(self) -> (Rule, Rule) {
        match self {
            Layers::Linear | Layers::Mean | Layers::Logarithmic | Layers::HalfCells => {
                (Rule::Trapezoid, Rule::Trapezoid)
            }
            Layers::Middle => (Rule::Trapezoid, Rule::Midpoint),
            Layers::HalfOwn | Layers::WholeOwn => (Rule::Midpoint, Rule::Midpoint),
            // As for what is exact, and what a break leaves of it.
            Layers::Bezier(_) => (Rule::Trapezoid, Rule::Trapezoid),
        }
    }

    /// What the source and the depth leave.
    fn of_source(self, structure: &Structure) -> Option<Limit> {
        let (depth, _) = self.rules();
        let degree = structure.extinction_degree();
        let depth_is_exact = degree.is_some_and(|degree| degree <= depth.degree() as usize);
        let emission_is_constant = structure.emission_is_constant();
        let follows_depth = matches!(self, Layers::Linear | Layers::Bezier(_));
        let is_linear = follows_depth && emission_is_linear(structure);
        if depth_is_exact && (emission_is_constant || is_linear) {
            return None;
        }
        // Errors of the depth on either side of a break may cancel behind it.
        let may_cancel = emission_is_constant && !structure.breaks.is_empty();
        // Where C has a zero the logarithmic mean has no such order.
        let may_vanish = self == Layers::Logarithmic
            && !emission_is_constant
            && !structure.along.emission_has_no_zero;
        let part = Part::LayerSource;
        let scatters = matches!(self, Layers::Bezier(bezier) if bezier.limiter == Limiter::Clip);
        Some(if may_cancel || may_vanish || scatters {
            Limit::unknown(part)
        } else if let Layers::Bezier(_) = self {
            Limit::new(part, 3.0)
        } else {
            Limit::new(part, 2.0)
        })
    }

    /// What the attenuation of a layer's light by the layer itself leaves.
    fn own_attenuation(self) -> Option<Limit> {
        let order = match self {
            Layers::Linear
            | Layers::Mean
            | Layers::Logarithmic
            | Layers::HalfCells
            | Layers::Bezier(_) => return None,
            Layers::Middle | Layers::HalfOwn => 2.0,
            Layers::WholeOwn => 1.0,
        };
        Some(Limit::new(Part::OwnAttenuation, order))
    }

    fn of_break(self, place: &Break, ladder: Option<&[u64]>) -> impl Iterator<Item = Limit> {
        let (depth, source) = self.rules();
        let both_jump = [&place.extinction, &place.source]
            .into_iter()
            .all(|power| power.as_ref().is_some_and(|power| *power == 0));
        let means = matches!(self, Layers::Linear | Layers::Mean | Layers::Logarithmic);
        let product = (means && both_jump).then(|| Limit::new(Part::SourceBreak, 1.0));
        let limit = |part, power: &Rational, rule| {
            if let Layers::Bezier(_) = self {
                // Wherever it lies: derivatives on either side are not those of both.
                return Some(Limit::new(part, 1.0 + power.to_f64()));
            }
            let meeting = Meeting::of(place, power, ladder);
            meeting.allows(Some(rule), 1, false).limit(part)
        };
        let of_extinction = place.extinction.as_ref();
        let of_extinction =
            of_extinction.and_then(|power| limit(Part::ExtinctionBreak, power, depth));
        let of_source = place.source.as_ref();
        let of_source = of_source.and_then(|power| limit(Part::SourceBreak, power, source));
        product.into_iter().chain(of_extinction).chain(of_source)
    }
}

/// Whether C is certainly linear in optical depth: C τ = (a + b P) τ for τ = u + v s, P = ∫ τ ds = u s + v s²/2 and s
/// linear along the ray.
fn emission_is_linear(structure: &Structure) -> bool {
    let Some(transfer) = &structure.transfer else {
        return false;
    };
    if structure.field_degree.is_none_or(|degree| degree > 1) {
        return false;
    }
    let at = |coefficients: &[Rational], k: usize| coefficients.get(k).cloned().unwrap_or_default();
    let beyond = |coefficients: &[Rational], k: usize| coefficients.iter().skip(k).any(|c| *c != 0);
    if beyond(&transfer.extinction, 2) || beyond(&transfer.source, 4) {
        return false;
    }
    let extinction: [Rational; 2] = [0, 1].map(|k| at(&transfer.extinction, k));
    let mut source: [Rational; 4] = [0, 1, 2, 3].map(|k| at(&transfer.source, k));
    let [u, v] = &extinction;
    // (u + v s)(u s + v s²/2), from the constant on.
    let of_depth = [
        Rational::new(),
        Rational::from(u * u),
        Rational::from(u * v) * 3 / 2,
        Rational::from(v * v) / 2,
    ];
    // b by the leading coefficients, and then a.
    let rest = take_off(&mut source, &of_depth);
    rest && take_off(&mut source, &extinction) && source.iter().all(|c| *c == 0)
}

/// Takes off so much of a polynomial that what is left has a lower degree than it; `false` of none.
fn take_off(from: &mut [Rational], polynomial: &[Rational]) -> bool {
    let Some(top) = polynomial.iter().rposition(|c| *c != 0) else {
        return false;
    };
    let Some(part) = from.get(top).zip(polynomial.get(top)) else {
        return false;
    };
    let part = Rational::from(part.0 / part.1);
    for (c, of) in from.iter_mut().zip(polynomial) {
        *c -= Rational::from(&part * of);
    }
    true
}
