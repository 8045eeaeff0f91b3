//! Scalars that count: any format, with the same bits, and a tally of what was done in it.
//!
//! Counts come from the very same generic code that computes, so that nothing is estimated. They do not
//! depend on the machine: they are what snapshots compare, where times would not repeat.

mod kind;
mod number;
mod tally;

pub use kind::Kind;
pub use number::CountedReal;
pub use tally::{Counts, count, uncounted};

pub(crate) use tally::tick;

use super::Format;
use rug::Rational;
use std::fmt::{self, Display};

/// A format whose numbers count what is done with them, on the thread that does it; see [`count`].
///
/// Values are those of the format inside, bit for bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counted<F>(pub F);

impl<F: Display> Display for Counted<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<F: Format> Format for Counted<F> {
    type Real = CountedReal<F::Real>;

    #[inline]
    fn bits(self) -> u32 {
        self.0.bits()
    }
    #[inline]
    fn int(self, n: i64) -> Self::Real {
        tick(Kind::Integer);
        CountedReal(self.0.int(n))
    }
    fn ratio(self, q: &Rational) -> Self::Real {
        tick(Kind::Constant);
        CountedReal(self.0.ratio(q))
    }
    #[inline]
    fn fraction(self, numerator: u64, denominator: u64) -> Self::Real {
        tick(Kind::Fraction);
        CountedReal(self.0.fraction(numerator, denominator))
    }
    fn pi(self) -> Self::Real {
        tick(Kind::Constant);
        CountedReal(self.0.pi())
    }
}
