//! Exponentials, logarithms, hyperbolic functions, atan and erf: monotone, so their bounds suffice.

use super::{Interval, Undefined, greatest};
use rug::Float;
use rug::float::Round;
use std::cmp::Ordering;

/// A function of MPFR that rounds as it is told.
pub(super) type Rounded = fn(&mut Float, Round) -> Ordering;

impl Interval {
    /// An increasing function, from the bounds.
    pub(super) fn increasing(&self, function: Rounded) -> Interval {
        let (mut lower, mut upper) = (self.lower.clone(), self.upper.clone());
        function(&mut lower, Round::Down);
        function(&mut upper, Round::Up);
        Interval::new(lower, upper)
    }

    /// eˣ.
    #[must_use]
    pub fn exp(&self) -> Interval {
        self.increasing(Float::exp_round)
    }

    /// eˣ − 1.
    #[must_use]
    pub fn exp_m1(&self) -> Interval {
        self.increasing(Float::exp_m1_round)
    }

    /// ln(1 + x), of numbers greater than −1.
    ///
    /// # Errors
    /// [`Undefined`] where the interval reaches down to −1, certainly so where it has nothing above.
    pub fn ln_1p(&self) -> Result<Interval, Undefined> {
        if self.upper <= -1 {
            return Err(Undefined::Certainly);
        }
        if self.lower <= -1 {
            return Err(Undefined::Possibly);
        }
        Ok(self.increasing(Float::ln_1p_round))
    }

    /// The natural logarithm, of positive numbers.
    ///
    /// # Errors
    /// [`Undefined`] where the interval reaches down to 0, certainly so where it has nothing above.
    pub fn ln(&self) -> Result<Interval, Undefined> {
        if self.is_nonpositive() {
            return Err(Undefined::Certainly);
        }
        if !self.is_positive() {
            return Err(Undefined::Possibly);
        }
        Ok(self.increasing(Float::ln_round))
    }

    /// The hyperbolic sine.
    #[must_use]
    pub fn sinh(&self) -> Interval {
        self.increasing(Float::sinh_round)
    }

    /// The hyperbolic cosine, least at 0.
    #[must_use]
    pub fn cosh(&self) -> Interval {
        self.abs().increasing(Float::cosh_round)
    }

    /// The hyperbolic tangent.
    #[must_use]
    pub fn tanh(&self) -> Interval {
        self.increasing(Float::tanh_round)
    }

    /// The arc tangent.
    #[must_use]
    pub fn atan(&self) -> Interval {
        self.increasing(Float::atan_round)
    }

    /// The error function, 2/√π ∫₀ˣ e^(−u²) du.
    #[must_use]
    pub fn erf(&self) -> Interval {
        self.increasing(Float::erf_round)
    }

    /// √x, of numbers that are not negative.
    ///
    /// # Errors
    /// [`Undefined`] where the interval reaches below 0, certainly so where it has nothing else.
    pub fn sqrt(&self) -> Result<Interval, Undefined> {
        self.check_nonnegative()?;
        Ok(self.increasing(Float::sqrt_round))
    }

    /// Whether the interval is a domain for fractional powers.
    pub(super) fn check_nonnegative(&self) -> Result<(), Undefined> {
        if self.is_negative() {
            Err(Undefined::Certainly)
        } else if self.is_nonnegative() {
            Ok(())
        } else {
            Err(Undefined::Possibly)
        }
    }

    /// The part of it that is ≥ 0, where there is any.
    #[must_use]
    pub fn nonnegative_part(&self) -> Option<Interval> {
        (self.upper >= 0).then(|| {
            let lower = greatest(&self.lower, &Float::new(self.bits()));
            Interval::new(lower, self.upper.clone())
        })
    }
}
