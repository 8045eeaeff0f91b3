//! The deterministic rules by name, order and degree.

use super::{gauss_legendre, newton_cotes};
use rug::Rational;
use std::fmt;
use std::str::FromStr;
use std::sync::Arc;

/// Most points a Gauss–Legendre rule may have.
pub const MAX_GAUSS_POINTS: u32 = 1000;

/// A deterministic quadrature rule on an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Rule {
    /// h·f(a).
    RiemannLeft,
    /// h·f(b).
    RiemannRight,
    /// h·f((a+b)/2).
    Midpoint,
    /// h·(f(a) + f(b))/2.
    Trapezoid,
    /// h·(f(a) + 4f(m) + f(b))/6.
    Simpson,
    /// h·(7f₀ + 32f₁ + 12f₂ + 32f₃ + 7f₄)/90 on five equidistant points.
    Boole,
    /// Gauss–Legendre with that many points, 1…[`MAX_GAUSS_POINTS`].
    GaussLegendre(u32),
}

/// A rule that cannot be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RuleError {
    /// Not one of the names.
    #[error(
        "unknown rule '{name}' (allowed: riemann-left, riemann-right, midpoint, trapezoid, simpson, boole, gauss-POINTS)"
    )]
    Unknown {
        /// The text given.
        name: String,
    },
    /// A Gauss–Legendre rule of too few or too many points.
    #[error(
        "'{points}' points of a Gauss–Legendre rule are out of range (allowed: gauss-1 … gauss-{MAX_GAUSS_POINTS})"
    )]
    Points {
        /// The number given.
        points: String,
    },
}

/// A rule's nodes and weights on [0, 1]: ∫₀¹ f ≈ Σ wₖ f(xₖ), Σ wₖ = 1.
///
/// Both are rationals, to be rounded once to the format that computes with them: exact for the
/// Newton–Cotes family, within 2^−(bits + 64) of the true values for Gauss–Legendre.
#[derive(Clone, Debug, PartialEq)]
pub struct UnitRule {
    /// Nodes, ascending.
    pub nodes: Vec<Rational>,
    /// Weights.
    pub weights: Vec<Rational>,
}

impl Rule {
    /// The order r of the composite rule: error O(hʳ) for an integrand smooth enough.
    #[must_use]
    pub fn order(self) -> u32 {
        match self {
            Rule::RiemannLeft | Rule::RiemannRight => 1,
            Rule::Midpoint | Rule::Trapezoid => 2,
            Rule::Simpson => 4,
            Rule::Boole => 6,
            Rule::GaussLegendre(points) => points.saturating_mul(2),
        }
    }

    /// The degree up to which polynomials are integrated exactly.
    #[must_use]
    pub fn degree(self) -> u32 {
        self.order().saturating_sub(1)
    }

    /// For a rule whose nodes are equidistant and include an end: into how many equal parts they
    /// divide the interval. `None` for midpoint and Gauss–Legendre, whose nodes are inside.
    #[must_use]
    pub fn intervals(self) -> Option<u32> {
        match self {
            Rule::RiemannLeft | Rule::RiemannRight | Rule::Trapezoid => Some(1),
            Rule::Simpson => Some(2),
            Rule::Boole => Some(4),
            Rule::Midpoint | Rule::GaussLegendre(_) => None,
        }
    }

    /// Nodes and weights for computations with `bits` significant bits.
    ///
    /// # Errors
    /// [`RuleError::Points`] for a Gauss–Legendre rule outside 1…[`MAX_GAUSS_POINTS`] points.
    pub fn table(self, bits: u32) -> Result<Arc<UnitRule>, RuleError> {
        match self {
            Rule::GaussLegendre(points) if (1..=MAX_GAUSS_POINTS).contains(&points) => {
                Ok(gauss_legendre::table(points, bits))
            }
            Rule::GaussLegendre(points) => Err(RuleError::Points {
                points: points.to_string(),
            }),
            _ => Ok(Arc::new(newton_cotes::table(self))),
        }
    }
}

impl FromStr for Rule {
    type Err = RuleError;

    fn from_str(name: &str) -> Result<Self, RuleError> {
        match name {
            "riemann-left" => Ok(Rule::RiemannLeft),
            "riemann-right" => Ok(Rule::RiemannRight),
            "midpoint" => Ok(Rule::Midpoint),
            "trapezoid" => Ok(Rule::Trapezoid),
            "simpson" => Ok(Rule::Simpson),
            "boole" => Ok(Rule::Boole),
            _ => {
                let Some(points) = name.strip_prefix("gauss-") else {
                    return Err(RuleError::Unknown { name: name.into() });
                };
                match points.parse() {
                    // A sign is no part of a number of points, though Rust's integers take one.
                    Ok(p) if (1..=MAX_GAUSS_POINTS).contains(&p) && !points.starts_with('+') => {
                        Ok(Rule::GaussLegendre(p))
                    }
                    _ => Err(RuleError::Points {
                        points: points.into(),
                    }),
                }
            }
        }
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Rule::RiemannLeft => f.pad("riemann-left"),
            Rule::RiemannRight => f.pad("riemann-right"),
            Rule::Midpoint => f.pad("midpoint"),
            Rule::Trapezoid => f.pad("trapezoid"),
            Rule::Simpson => f.pad("simpson"),
            Rule::Boole => f.pad("boole"),
            Rule::GaussLegendre(points) => f.pad(&format!("gauss-{points}")),
        }
    }
}
