//! How exact a kernel says that it is.

use std::fmt;

/// What answers are multiples of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Quantum {
    /// Of this, in the units of the radiance; of an opacity, of 1.
    Absolute(f64),
    /// Of this part of the largest |C| of the ray; of an opacity, of 1.
    Relative(f64),
}

impl Quantum {
    /// In the units of the answer, where the largest |C| is that.
    #[must_use]
    pub fn of(self, brightest: f64) -> f64 {
        match self {
            Quantum::Absolute(quantum) => quantum,
            Quantum::Relative(part) => part * brightest,
        }
    }
}

/// A function of x is off by at most a + b |x| units in the last place of its result.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "studies", derive(serde::Serialize, schemars::JsonSchema))]
pub struct UlpBound {
    a: f64,
    b: f64,
}

/// A bound that is none.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("{a} + {b} |x| units in the last place (allowed: both finite, 0 or above)")]
pub struct UlpBoundError {
    /// The constant part.
    pub a: f64,
    /// The part that grows with |x|.
    pub b: f64,
}

impl UlpBound {
    /// a + b |x|.
    ///
    /// # Errors
    /// [`UlpBoundError`] where either is negative or not finite.
    pub fn new(a: f64, b: f64) -> Result<UlpBound, UlpBoundError> {
        let is_allowed = |part: f64| part.is_finite() && part >= 0.0;
        if is_allowed(a) && is_allowed(b) {
            Ok(UlpBound { a, b })
        } else {
            Err(UlpBoundError { a, b })
        }
    }

    /// At x, in units in the last place.
    #[must_use]
    pub fn at(self, x: f64) -> f64 {
        self.a + self.b * x.abs()
    }
}

impl fmt::Display for UlpBound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.b == 0.0 {
            return write!(f, "{}", self.a);
        }
        write!(f, "{} + {} |x|", self.a, self.b)
    }
}
