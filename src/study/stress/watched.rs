//! A format that watches its own arithmetic: what went wrong on the way travels with each number.
//!
//! Values are those of the watched format bit for bit. Beside its value a number carries what befell anything
//! that it was computed from, so that the radiance of a run knows what befell the run; there is no state
//! anywhere else.

mod events;
mod number;
mod operators;

pub(super) use events::Events;
pub(super) use number::Observed;

use super::range::Range;
use crate::real::{Format, Real};
use rug::Rational;
use std::fmt::{self, Display};

/// A format, watched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Watched<F>(pub(super) F);

impl<F: Display> Display for Watched<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<F: Range> Watched<F> {
    /// A constant that is 0 or not.
    fn constant(value: F::Real, is_zero: bool) -> Observed<F> {
        let mut events = Events::NONE;
        if !value.is_finite() {
            events |= Events::OVERFLOW;
        } else if F::is_end(&value) {
            events |= Events::SATURATED;
        } else if !is_zero && (F::is_zero(&value) || F::is_subnormal(&value)) {
            events |= Events::INPUT_UNDERFLOW;
        }
        Observed {
            value,
            lost: 0.0,
            events,
        }
    }
}

impl<F: Range> Format for Watched<F> {
    type Real = Observed<F>;

    fn bits(self) -> u32 {
        self.0.bits()
    }
    #[inline]
    fn int(self, n: i64) -> Observed<F> {
        Self::constant(self.0.int(n), n == 0)
    }
    fn ratio(self, q: &Rational) -> Observed<F> {
        Self::constant(self.0.ratio(q), *q == 0)
    }
    #[inline]
    fn fraction(self, numerator: u64, denominator: u64) -> Observed<F> {
        Self::constant(self.0.fraction(numerator, denominator), numerator == 0)
    }
    fn pi(self) -> Observed<F> {
        Self::constant(self.0.pi(), false)
    }
}
