//! Scalars: a [`Format`] is a value that makes numbers, a [`Real`] is a number that knows its format.
//!
//! Precision is a run-time value, there is no global state, and the native formats cost nothing.
//! User code needs one bound, `R: Real`, or `F: Format`.
//!
//! Constants on a generic path are exact rationals ([`Format::ratio`], [`Format::fraction`]), rounded
//! once. A binary64 literal there would silently cap every precision at 53 bits.

mod any;
pub mod counted;
mod fixed;
mod ieee;
pub mod lanes;
mod mpfr;
mod name;
mod native;
mod row;
pub mod special;

pub use any::AnyReal;
pub use counted::{Counted, CountedReal, Counts};
pub use fixed::{Fixed, FixedReal, MAX_FRACTION, MAX_INTEGER};
pub use ieee::{Ieee, IeeeReal, MAX_EXPONENT, MAX_IEEE_BITS, Overflow};
#[cfg(feature = "studies")]
pub(crate) use mpfr::Near;
pub use mpfr::{Mpfr, MpfrReal};
pub use name::{FormatError, FormatName, MAX_BITS, MIN_BITS, WithFormat};
pub use native::{Native, NativeFloat};
pub(crate) use row::{row, try_row};

use rug::float::Special;
use rug::{Float, Rational};
use std::fmt::{Debug, Display};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number format: a value that makes numbers of its own precision.
pub trait Format: Copy + Debug + Display + PartialEq + Send + Sync + 'static {
    /// The numbers of this format.
    type Real: Real<Format = Self>;

    /// Whether [`Real::rounded`] knows what elementary functions give, to the last bit.
    const ROUNDS_FUNCTIONS: bool = false;

    /// Whether functions of rows are quicker than of one number after the other.
    const IN_LANES: bool = false;

    /// Significant bits with the leading one: MPFR's convention (binary32: 24, binary64: 53). In a
    /// fixed-point format those of numbers just below 1, where 2^−bits is its quantum.
    fn bits(self) -> u32;

    /// The integer `n`, rounded once to nearest; where the format's range ends before `n`, what the format
    /// makes of overflow (∞ for `int(65536)` in binary16).
    fn int(self, n: i64) -> Self::Real;

    /// The rational `q`, rounded once to nearest, gradual underflow included.
    fn ratio(self, q: &Rational) -> Self::Real;

    /// `numerator / denominator`, rounded once to nearest. The result depends on the quotient only,
    /// so that 1/2 and 512/1024 are the same number, bit for bit, in every format.
    ///
    /// `denominator` must not be 0.
    fn fraction(self, numerator: u64, denominator: u64) -> Self::Real {
        self.ratio(&Rational::from((numerator, denominator)))
    }

    /// The binary64 number `x`, rounded once to nearest, −0 as 0; NaN where `x` is not finite.
    fn binary64(self, x: f64) -> Self::Real {
        binary64_by_ratio(self, x)
    }

    /// The number nearest to one that is `high` + `low` but for 2⁻⁹⁰ of it, where `high` > 0 is that number in binary64;
    /// `None` where this does not decide it, and of formats that have no shorter way than a rational number.
    fn nearest(self, _high: f64, _low: f64) -> Option<Self::Real> {
        None
    }

    /// π, rounded once to nearest.
    fn pi(self) -> Self::Real;
}

/// [`Format::binary64`] for formats that have no shorter way to it.
fn binary64_by_ratio<F: Format>(format: F, x: f64) -> F::Real {
    match Rational::from_f64(x) {
        Some(exact) => format.ratio(&exact),
        // Not a number is none in any format.
        None => format.int(0) / &format.int(0),
    }
}

/// A number of a [`Format`].
///
/// Operators take an owned left and a borrowed right operand: both the standard floats and MPFR
/// have that shape, and it reuses MPFR's limbs. Elementary functions of MPFR are correctly rounded;
/// those of a native format are what its library gives.
pub trait Real:
    Clone
    + PartialOrd
    + Debug
    + Display
    + Send
    + Sync
    + 'static
    + Neg<Output = Self>
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> AddAssign<&'a Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> SubAssign<&'a Self>
    + for<'a> Mul<&'a Self, Output = Self>
    + for<'a> MulAssign<&'a Self>
    + for<'a> Div<&'a Self, Output = Self>
    + for<'a> DivAssign<&'a Self>
{
    /// The format this number belongs to.
    type Format: Format<Real = Self>;

    /// The format of this very number (its precision, for MPFR).
    fn format(&self) -> Self::Format;

    /// Takes the value of `from`, rounded to the precision this number has.
    fn set(&mut self, from: &Self);

    /// |x|.
    #[must_use]
    fn abs(self) -> Self;
    /// √x.
    #[must_use]
    fn sqrt(self) -> Self;
    /// eˣ.
    #[must_use]
    fn exp(self) -> Self;
    /// Makes this number e^(−x), rounded as [`exp`](Real::exp) rounds.
    fn set_exp_of_negative(&mut self, x: &Self) {
        *self = (-x.clone()).exp();
    }
    /// eˣ − 1, without cancellation at small x.
    #[must_use]
    fn exp_m1(self) -> Self;
    /// ln x.
    #[must_use]
    fn ln(self) -> Self;
    /// ln(1 + x), without cancellation at small x.
    #[must_use]
    fn ln_1p(self) -> Self;
    /// (sin x, cos x), evaluated together.
    fn sin_cos(self) -> (Self, Self);
    /// eˣ of each x of a row, with the bits of [`Real::exp`].
    fn exp_row(row: &[Self], exponentials: &mut [Self]) {
        for (x, exponential) in row.iter().zip(exponentials) {
            *exponential = x.clone().exp();
        }
    }
    /// eˣ − 1 of each x of a row, with the bits of [`Real::exp_m1`].
    fn exp_m1_row(row: &[Self], exponentials: &mut [Self]) {
        for (x, exponential) in row.iter().zip(exponentials) {
            *exponential = x.clone().exp_m1();
        }
    }
    /// sin x and cos x of each x of a row, with the bits of [`Real::sin_cos`].
    fn sin_cos_row(row: &[Self], sines: &mut [Self], cosines: &mut [Self]) {
        for ((x, sin), cos) in row.iter().zip(sines).zip(cosines) {
            (*sin, *cos) = x.clone().sin_cos();
        }
    }
    /// tan x.
    #[must_use]
    fn tan(self) -> Self;
    /// sinh x.
    #[must_use]
    fn sinh(self) -> Self;
    /// cosh x.
    #[must_use]
    fn cosh(self) -> Self;
    /// tanh x.
    #[must_use]
    fn tanh(self) -> Self;
    /// atan x, between −π/2 and π/2.
    #[must_use]
    fn atan(self) -> Self;
    /// erf x = 2/√π ∫₀ˣ e^(−u²) du.
    #[must_use]
    fn erf(self) -> Self;

    /// Neither NaN nor infinite.
    fn is_finite(&self) -> bool;

    /// The value as an exact rational, `None` for NaN and infinities: how errors are measured.
    fn to_rational(&self) -> Option<Rational>;

    /// The very value as an MPFR number of as many bits as it takes; not finite where this number is not.
    fn to_float(&self) -> Float {
        match self.to_rational() {
            Some(value) => {
                // Every format's numbers are binary fractions.
                let bits = value.numer().significant_bits().max(self.format().bits());
                Float::with_val(bits.max(MIN_BITS), value)
            }
            None => Float::with_val(self.format().bits().max(MIN_BITS), Special::Nan),
        }
    }

    /// The value as an MPFR number of so many bits, rounded where they are too few.
    fn to_float_of(&self, bits: u32) -> Float {
        Float::with_val(bits, self.to_float())
    }

    /// The number of this one's format that is nearest to a value of an elementary function, of which `near` is known to be within
    /// 2^(`error_bits` − its bits) of itself; `None` where that does not say which, or the format's functions do not round to
    /// nearest.
    fn rounded(&self, _near: &MpfrReal, _error_bits: u32) -> Option<Self> {
        None
    }

    /// log₂|x| in binary64, −∞ for 0: survives magnitudes far outside binary64's range.
    fn log2_abs(&self) -> f64;
}
