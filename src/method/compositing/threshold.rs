//! A transmittance below which nothing shows any more.

use rug::Rational;
use std::fmt;

/// An exact rational in (0, 1), in lowest terms: a ray ends in front of the first segment with a
/// transmittance T below it (Levoy 1990). It is rounded once to the format that compares.
///
/// A T that is NaN is not below it, and the ray goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Threshold {
    numerator: u32,
    denominator: u32,
}

impl Threshold {
    /// numerator/denominator; `None` where that does not lie between 0 and 1.
    #[must_use]
    pub fn new(numerator: u32, denominator: u32) -> Option<Self> {
        if numerator == 0 || numerator >= denominator {
            return None;
        }
        let lowest = Rational::from((numerator, denominator));
        Some(Threshold {
            numerator: lowest.numer().to_u32()?,
            denominator: lowest.denom().to_u32()?,
        })
    }

    /// The number.
    #[must_use]
    pub fn value(self) -> Rational {
        Rational::from((self.numerator, self.denominator))
    }
}

impl fmt::Display for Threshold {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.numerator, self.denominator)
    }
}
