//! Native formats: one blanket implementation over [`num_traits::Float`].

use super::{Format, Real, binary64_by_ratio};
use num_traits::{Float as NumFloat, FloatConst, FromPrimitive};
use rug::float::Round;
use rug::ops::AssignRound;
use rug::{Float, Rational};
use std::cmp::Ordering;
use std::fmt::{self, Debug, Display};
use std::marker::PhantomData;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Sub, SubAssign};

/// What a type must offer to be a scalar at once: `f32`, `f64`, `half::f16`, `half::bf16` and any
/// other float of at most 53 significant bits whose values are values of binary64.
pub trait NativeFloat:
    NumFloat
    + FloatConst
    + FromPrimitive
    + Debug
    + Display
    + Send
    + Sync
    + 'static
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> AddAssign<&'a Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> SubAssign<&'a Self>
    + for<'a> Mul<&'a Self, Output = Self>
    + for<'a> MulAssign<&'a Self>
    + for<'a> Div<&'a Self, Output = Self>
    + for<'a> DivAssign<&'a Self>
{
}

impl<T> NativeFloat for T where
    T: NumFloat
        + FloatConst
        + FromPrimitive
        + Debug
        + Display
        + Send
        + Sync
        + 'static
        + for<'a> Add<&'a T, Output = T>
        + for<'a> AddAssign<&'a T>
        + for<'a> Sub<&'a T, Output = T>
        + for<'a> SubAssign<&'a T>
        + for<'a> Mul<&'a T, Output = T>
        + for<'a> MulAssign<&'a T>
        + for<'a> Div<&'a T, Output = T>
        + for<'a> DivAssign<&'a T>
{
}

/// The format of a native type `T`; a value of no size.
pub struct Native<T>(PhantomData<fn() -> T>);

impl<T> Native<T> {
    /// The format.
    #[must_use]
    pub const fn new() -> Self {
        Native(PhantomData)
    }
}

impl<T> Default for Native<T> {
    fn default() -> Self {
        Self::new()
    }
}

impl<T> Clone for Native<T> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<T> Copy for Native<T> {}

impl<T> PartialEq for Native<T> {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl<T> Debug for Native<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(self, f)
    }
}

impl<T> Display for Native<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let path = std::any::type_name::<T>();
        f.write_str(path.rsplit("::").next().unwrap_or(path))
    }
}

/// How near a number may be to where rounding turns, in units in binary64's last place, before it is not decided.
const UNDECIDED: f64 = 1e-6;

/// The bits of binary64's fraction.
const FRACTION: u64 = (1 << (f64::MANTISSA_DIGITS - 1)) - 1;

/// The largest power of two that is not above x > 0.
fn power_of_two_below(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & !FRACTION)
}

/// The bits of a normal number from the first to the last that is set.
fn significant_bits(x: f64) -> u32 {
    let fraction = x.to_bits() & FRACTION;
    f64::MANTISSA_DIGITS - (fraction | (FRACTION + 1)).trailing_zeros()
}

impl<T: NativeFloat> Format for Native<T> {
    type Real = T;

    #[inline]
    fn bits(self) -> u32 {
        // ε = 2^(1 − bits), an exact power of two.
        let (mantissa, exponent, _) = T::epsilon().integer_decode();
        let log2_epsilon = i32::from(exponent) + mantissa.trailing_zeros().cast_signed();
        (1 - log2_epsilon).unsigned_abs()
    }

    #[inline]
    fn int(self, n: i64) -> T {
        if n.unsigned_abs() <= 1 << self.bits() {
            T::from_i64(n).unwrap_or_else(T::nan)
        } else {
            self.ratio(&Rational::from(n))
        }
    }

    fn ratio(self, q: &Rational) -> T {
        let exact = 1 << self.bits();
        if let (Some(numerator), Some(denominator)) = (q.numer().to_i64(), q.denom().to_u64())
            && numerator.unsigned_abs() <= exact
            && denominator <= exact
            && let (Some(a), Some(b)) = (T::from_i64(numerator), T::from_u64(denominator))
        {
            // Both are exact in T, and division rounds once.
            return a / b;
        }
        // Truncate with one guard bit and append a sticky bit: the one rounding to nearest that
        // follows, into T's range with its subnormals, then knows on which side of a tie q lies.
        let mut truncated = Float::new(self.bits() + 1);
        let exact = truncated.assign_round(q, Round::Zero) == Ordering::Equal;
        let mut wide = Float::with_val(self.bits() + 2, &truncated);
        if !exact && *q > 0 {
            wide.next_up();
        } else if !exact {
            wide.next_down();
        }
        T::from_f64(wide.to_f64()).unwrap_or_else(T::nan)
    }

    #[inline]
    fn nearest(self, high: f64, low: f64) -> Option<T> {
        let is_decided = if self.bits() == f64::MANTISSA_DIGITS {
            // It is that number already, unless it is half a unit off; below a power of two a unit is half as large.
            let unit = f64::EPSILON * power_of_two_below(high);
            let from = |part: f64| (low.abs() - part * unit).abs();
            from(0.5).min(from(0.25)) > UNDECIDED * unit
        } else {
            // Of so few bits it may be half way between two numbers.
            significant_bits(high) > self.bits() + 1
        };
        (high > 0.0 && is_decided).then(|| self.binary64(high))
    }

    #[inline]
    fn fraction(self, numerator: u64, denominator: u64) -> T {
        let exact = 1 << self.bits();
        if numerator <= exact && denominator <= exact {
            // Both are exact in T, and division rounds once.
            match (T::from_u64(numerator), T::from_u64(denominator)) {
                (Some(a), Some(b)) => a / b,
                _ => T::nan(),
            }
        } else {
            wide_fraction(self, numerator, denominator)
        }
    }

    #[inline]
    fn binary64(self, x: f64) -> T {
        // Narrower types may be rounded to by way of binary32, and so twice.
        if self.bits() < f32::MANTISSA_DIGITS || !x.is_finite() {
            return binary64_by_ratio(self, x);
        }
        // Adding 0 takes the sign of −0.
        T::from_f64(x + 0.0).unwrap_or_else(T::nan)
    }

    fn pi(self) -> T {
        T::PI()
    }
}

/// Out of line, so that the loop over ordinary nodes stays small enough to be pipelined.
#[cold]
fn wide_fraction<T: NativeFloat>(format: Native<T>, numerator: u64, denominator: u64) -> T {
    format.ratio(&Rational::from((numerator, denominator)))
}

impl<T: NativeFloat> Real for T {
    type Format = Native<T>;

    #[inline]
    fn format(&self) -> Native<T> {
        Native::new()
    }
    #[inline]
    fn set(&mut self, from: &Self) {
        *self = *from;
    }
    #[inline]
    fn abs(self) -> T {
        NumFloat::abs(self)
    }
    #[inline]
    fn sqrt(self) -> T {
        NumFloat::sqrt(self)
    }
    #[inline]
    fn exp(self) -> T {
        NumFloat::exp(self)
    }
    #[inline]
    fn exp_m1(self) -> T {
        NumFloat::exp_m1(self)
    }
    #[inline]
    fn ln(self) -> T {
        NumFloat::ln(self)
    }
    #[inline]
    fn ln_1p(self) -> T {
        NumFloat::ln_1p(self)
    }
    #[inline]
    fn sin_cos(self) -> (T, T) {
        NumFloat::sin_cos(self)
    }
    #[inline]
    fn tan(self) -> T {
        NumFloat::tan(self)
    }
    #[inline]
    fn sinh(self) -> T {
        NumFloat::sinh(self)
    }
    #[inline]
    fn cosh(self) -> T {
        NumFloat::cosh(self)
    }
    #[inline]
    fn tanh(self) -> T {
        NumFloat::tanh(self)
    }
    #[inline]
    fn atan(self) -> T {
        NumFloat::atan(self)
    }
    #[inline]
    fn erf(self) -> T {
        // num_traits knows no erf; binary64 holds every value of T.
        let wide = self.to_f64().map(libm::erf);
        wide.and_then(T::from_f64).unwrap_or_else(T::nan)
    }
    #[inline]
    fn is_finite(&self) -> bool {
        NumFloat::is_finite(*self)
    }
    fn to_rational(&self) -> Option<Rational> {
        Rational::from_f64(self.to_f64()?)
    }
    fn to_float(&self) -> Float {
        // binary64 holds every value of T.
        Float::with_val(f64::MANTISSA_DIGITS, self.to_f64().unwrap_or(f64::NAN))
    }
    fn to_float_of(&self, bits: u32) -> Float {
        Float::with_val(bits, self.to_f64().unwrap_or(f64::NAN))
    }
    fn log2_abs(&self) -> f64 {
        self.to_f64().map_or(f64::NAN, |x| x.abs().log2())
    }
}
