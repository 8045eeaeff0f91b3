//! The theorem behind an expected order, where `proofs/theory/` has one.

use super::{
    Color, Expected, Exponential, Inner, Integration, Interpolant, Method, Nested, Opacity,
    Preintegrated, Scope,
};
use crate::case::Structure;
use crate::quadrature::Rule;
use serde::{Serialize, Serializer};
use std::fmt;

/// A theorem that Coq has checked.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Theorem {
    /// Its name, after which `proofs/README.md` says it in words.
    pub name: &'static str,
    /// Its file, from the top of the repository.
    pub file: &'static str,
    /// The order r that it is about.
    pub order: u32,
}

impl Theorem {
    /// A nested rule's error is at most a constant times d^min(p, q).
    const NESTED: Theorem = Theorem {
        name: "nested_bound",
        file: "proofs/theory/Nested.v",
        order: 0,
    };
    /// A Riemann sum of the radiance over one of the depth.
    const RIEMANN: Theorem = Theorem {
        name: "nested_riemann_first_order",
        file: "proofs/theory/NestedRules.v",
        order: 1,
    };
    /// The trapezoid rule over itself.
    const TRAPEZOID: Theorem = Theorem {
        name: "nested_trapezoid_second_order",
        file: "proofs/theory/NestedRules.v",
        order: 2,
    };
    /// Simpson's rule over itself, with the segments' midpoints for the depth.
    const SIMPSON: Theorem = Theorem {
        name: "nested_simpson_fourth_order",
        file: "proofs/theory/NestedRules.v",
        order: 4,
    };
    /// 1 − x for e⁻ˣ in every segment.
    const LINEAR_EXPONENTIAL: Theorem = Theorem {
        name: "linear_exponential_first_order",
        file: "proofs/theory/LinearExponential.v",
        order: 1,
    };
    /// The attenuation inside segments left out.
    const NEGLECTED_ATTENUATION: Theorem = Theorem {
        name: "neglected_attenuation_order_at_most_one",
        file: "proofs/theory/NeglectedAttenuation.v",
        order: 1,
    };
    /// Pre-integration along a linearly interpolated field.
    const PREINTEGRATION: Theorem = Theorem {
        name: "preintegration_second_order",
        file: "proofs/theory/Preintegration.v",
        order: 2,
    };

    /// All that stand behind an expected order.
    pub const ALL: [Theorem; 7] = [
        Theorem::RIEMANN,
        Theorem::TRAPEZOID,
        Theorem::SIMPSON,
        Theorem::NESTED,
        Theorem::LINEAR_EXPONENTIAL,
        Theorem::NEGLECTED_ATTENUATION,
        Theorem::PREINTEGRATION,
    ];
}

impl Method {
    /// The theorem behind the order expected of the method on a case of that structure; `None` where none
    /// is proved of such a method, where the case has breaks, which the theorems exclude, and where it
    /// shows another order than the method has in general.
    #[must_use]
    pub fn theorem(&self, structure: &Structure) -> Option<Theorem> {
        let (theorem, limits) = match self {
            Method::Nested(nested) => (nested.theorem()?, nested.limits(structure)),
            Method::Preintegrated(preintegrated) => {
                (preintegrated.theorem()?, preintegrated.limits(structure))
            }
            Method::Composited(_) | Method::Layered(_) => return None,
        };
        let expected = Expected::from_limits(&limits);
        let is_its = expected == Expected::Order(f64::from(theorem.order));
        (is_its && structure.breaks.is_empty()).then_some(theorem)
    }
}

impl Nested {
    fn theorem(&self) -> Option<Theorem> {
        let Inner::PerSegment(inner) = self.inner else {
            return None;
        };
        match (self.exponential, self.scope) {
            // The scope is a matter of rounding alone.
            (Exponential::Exact, _) => Some(match (inner, self.outer.0) {
                (Rule::RiemannLeft, Rule::RiemannLeft) => Theorem::RIEMANN,
                (Rule::Trapezoid, Rule::Trapezoid) => Theorem::TRAPEZOID,
                (Rule::Simpson, Rule::Simpson) => Theorem::SIMPSON,
                (inner, outer) => Theorem {
                    order: inner.order().min(outer.order()),
                    ..Theorem::NESTED
                },
            }),
            (Exponential::Linear, Scope::PerSegment) => Some(Theorem::LINEAR_EXPONENTIAL),
            _ => None,
        }
    }
}

impl Preintegrated {
    fn theorem(&self) -> Option<Theorem> {
        if !self.color.attenuated {
            return Some(Theorem::NEGLECTED_ATTENUATION);
        }
        let color = Color {
            interpolant: Interpolant::Linear,
            attenuated: true,
            integration: Integration::Closed,
        };
        let opacity = Opacity {
            interpolant: Interpolant::Linear,
            integration: Integration::Closed,
        };
        (*self == Preintegrated { color, opacity }).then_some(Theorem::PREINTEGRATION)
    }
}

/// "`nested_bound` (proofs/theory/Nested.v)".
impl fmt::Display for Theorem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({})", self.name, self.file)
    }
}

/// The name alone.
impl Serialize for Theorem {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name)
    }
}
