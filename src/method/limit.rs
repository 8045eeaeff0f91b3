//! What limits a method's order: each part with its own, and where that is known from.

use super::Expected;
use crate::case::Structure;
use crate::quadrature::Rule;
use std::fmt;

/// A part of a method that makes a discretization error of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Part {
    /// The rule for the optical depth: p.
    InnerRule,
    /// The rule for the radiance: q.
    OuterRule,
    /// A Taylor polynomial in place of the exponential.
    Exponential,
    /// The interpolated field in a segment's source term.
    Source,
    /// The interpolated field in a segment's transmittance.
    Opacity,
    /// The interpolated field in the attenuation inside a segment.
    AttenuationInside,
    /// The attenuation inside a segment left out.
    NeglectedAttenuation,
    /// A fixed number of sub-intervals in each segment.
    SubIntervals,
    /// C and τ taken to be constant in each segment, as compositing does.
    ConstantSegments,
    /// The optical depth of a segment in place of its opacity.
    LinearOpacity,
    /// What is taken for the source between the places where a layer is looked at, and for its depth.
    LayerSource,
    /// The attenuation of a layer's light by the layer itself.
    OwnAttenuation,
    /// A place where τ is not analytic, under the rule for the optical depth or opacity.
    ExtinctionBreak,
    /// A place where C·τ or the transmittance is not analytic, under the rule for the radiance or color.
    SourceBreak,
}

impl Part {
    /// Where the part's order is known from.
    #[must_use]
    pub fn source(self) -> &'static str {
        match self {
            Part::InnerRule | Part::OuterRule => {
                "order of the composite rule; Etiene, Kirby and Silva (2013), equation 22"
            }
            Part::Exponential => {
                "a degree k Taylor polynomial leaves O(d^(k+1)) in each of D/d segments"
            }
            Part::Source | Part::Opacity => {
                "interpolation error; Etiene, Kirby and Silva (2013), equation 28"
            }
            Part::AttenuationInside => "interpolation error, integrated once more over a segment",
            Part::NeglectedAttenuation => "Etiene, Kirby and Silva (2013), equation 31",
            Part::SubIntervals => "order of the rule in d for a fixed number of sub-intervals",
            Part::ConstantSegments => {
                "expansion of a segment's error about its one sample; Compositing::limits"
            }
            Part::LinearOpacity => "τ²d²/2 left out in each of D/d segments",
            Part::LayerSource => "expansion of a layer's error about its middle; Layers::limits",
            Part::OwnAttenuation => "a power of e^(−τd) in place of a layer's mean; Layers::limits",
            Part::ExtinctionBreak | Part::SourceBreak => {
                "|λ − b|^α inside one segment leaves O(d^(1+α)); docs/nonsmooth.md"
            }
        }
    }
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Part::InnerRule => "inner rule",
            Part::OuterRule => "outer rule",
            Part::Exponential => "exponential",
            Part::Source => "interpolated source",
            Part::Opacity => "interpolated opacity",
            Part::AttenuationInside => "interpolated attenuation inside segments",
            Part::NeglectedAttenuation => "neglected attenuation inside segments",
            Part::SubIntervals => "sub-integration",
            Part::ConstantSegments => "constant medium in each segment",
            Part::LinearOpacity => "linear opacity",
            Part::LayerSource => "source and depth of layers",
            Part::OwnAttenuation => "own attenuation of layers",
            Part::ExtinctionBreak => "break of the extinction",
            Part::SourceBreak => "break of the source term",
        })
    }
}

/// The order that one part allows on a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limit {
    /// The part.
    pub part: Part,
    /// Its order; `None` where theory does not say.
    pub order: Option<f64>,
    /// Whether its leading error coefficient is 0 on this very case, for a reason that has nothing to do
    /// with the method.
    pub vanishes: bool,
}

impl Limit {
    pub(super) fn new(part: Part, order: f64) -> Self {
        Limit {
            part,
            order: Some(order),
            vanishes: false,
        }
    }

    pub(super) fn unknown(part: Part) -> Self {
        Limit {
            part,
            order: None,
            vanishes: false,
        }
    }
}

/// The orders that a composite rule for ∫ C τ e^(−t) has on a case, up to the first that shows.
///
/// By the Euler–Maclaurin formula its error is Σ cᵣ dʳ [F^(r−1)(D) − F^(r−1)(0)] for F = C τ e^(−t), with r
/// the rule's order and every second number above; for a Riemann sum, which is the trapezoid rule and
/// half a step of F(D) − F(0), with r = 1 and all even numbers. See Davis and
/// Rabinowitz (1984), section 2.9.
pub(super) fn euler_maclaurin(part: Part, rule: Rule, structure: &Structure) -> Vec<Limit> {
    let mut order = rule.order();
    let mut limits = Vec::new();
    loop {
        let derivative = (order as usize).saturating_sub(1);
        let vanishes = structure.is_equal_at_ends(derivative);
        let order_here = f64::from(order);
        limits.push(Limit {
            part,
            order: Some(order_here),
            vanishes,
        });
        if !vanishes {
            return limits;
        }
        order = if order == 1 { 2 } else { order + 2 };
    }
}

impl Expected {
    /// The least of the orders, unknown where one of them is; blind where a part that vanishes on the
    /// case would have been the limiting one.
    #[must_use]
    pub fn from_limits(limits: &[Limit]) -> Self {
        let least = |limits: &mut dyn Iterator<Item = &Limit>| {
            limits.filter_map(|limit| limit.order).reduce(f64::min)
        };
        if limits.iter().any(|limit| limit.order.is_none()) {
            return Expected::Unknown;
        }
        let general = least(&mut limits.iter());
        let here = least(&mut limits.iter().filter(|limit| !limit.vanishes));
        match (general, here) {
            (None, _) => Expected::Exact,
            (Some(general), Some(here)) if general >= here => Expected::Order(general),
            (Some(general), here) => Expected::Blind {
                general,
                here: here.unwrap_or(f64::INFINITY),
            },
        }
    }
}
