//! Parts of an emission: polynomials of the depth that are never negative.

use super::Draw;
use rug::Rational;
use std::fmt;

/// A part of an emission C = P(t), t ≥ 0; its factor is positive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Emit {
    /// c tⁿ.
    Power {
        /// c.
        factor: Rational,
        /// n.
        exponent: u32,
    },
    /// c (t − r)².
    Square {
        /// c.
        factor: Rational,
        /// r.
        root: Rational,
    },
}

impl Emit {
    pub(super) fn draw(draw: &mut Draw) -> Emit {
        let factor = draw.factor();
        match draw.below(6) {
            0 => Emit::Square {
                factor,
                root: draw.factor(),
            },
            1 | 2 => Emit::Power {
                factor,
                exponent: 0,
            },
            _ => Emit::Power {
                factor,
                exponent: 1 + draw.below(3),
            },
        }
    }
}

impl fmt::Display for Emit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Emit::Power {
                factor,
                exponent: 0,
            } => write!(f, "{factor}"),
            Emit::Power { factor, exponent } => write!(f, "{factor}*t^{exponent}"),
            Emit::Square { factor, root } => write!(f, "{factor}*(t - {root})^2"),
        }
    }
}
