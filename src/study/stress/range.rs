//! Where a format's numbers end, and how well it rounds between the ends.

use crate::real::lanes::{LaneFloat, LaneFormat, LaneReal};
use crate::real::{Fixed, FixedReal, Format, Ieee, Native, NativeFloat, Real};

/// What the error model needs to know of a format: fl(a ∘ b) = (a ∘ b)(1 + δ) + ε with |δ| ≤ u and |ε| ≤ η.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounding {
    /// u, 0 for a fixed-point format.
    pub unit: f64,
    /// log₂ η: half the least positive number.
    pub log2_quantum: f64,
    /// Significant bits, for the length of a power series.
    pub bits: u32,
}

impl Rounding {
    /// Whether errors are absolute: a fixed-point format.
    #[must_use]
    pub fn is_absolute(&self) -> bool {
        self.unit == 0.0
    }
}

/// A format whose numbers end somewhere.
pub(super) trait Range: Format {
    /// u and η.
    fn rounding(self) -> Rounding;
    /// Exactly 0.
    fn is_zero(x: &Self::Real) -> bool;
    /// Below 0.
    fn is_negative(x: &Self::Real) -> bool;
    /// Of a number that is not 0: smaller than the least normal number.
    fn is_subnormal(x: &Self::Real) -> bool;
    /// At the end where the format saturates.
    fn is_end(x: &Self::Real) -> bool;
    /// None of all that: neither 0, nor subnormal, nor at an end, nor infinite, nor NaN.
    fn is_ordinary(x: &Self::Real) -> bool;
    /// |a|/|b| of numbers that are not 0, in binary64.
    fn quotient(a: &Self::Real, b: &Self::Real) -> f64;
}

fn floating(bits: u32, emin: f64) -> Rounding {
    Rounding {
        unit: (-f64::from(bits)).exp2(),
        log2_quantum: emin - f64::from(bits),
        bits,
    }
}

impl<T: NativeFloat> Range for Native<T> {
    fn rounding(self) -> Rounding {
        floating(self.bits(), T::min_positive_value().log2_abs())
    }
    #[inline]
    fn is_zero(x: &T) -> bool {
        *x == T::zero()
    }
    #[inline]
    fn is_negative(x: &T) -> bool {
        *x < T::zero()
    }
    #[inline]
    fn is_subnormal(x: &T) -> bool {
        let least = T::min_positive_value();
        *x < least && *x > -least
    }
    #[inline]
    fn is_end(_: &T) -> bool {
        false
    }
    #[inline]
    fn is_ordinary(x: &T) -> bool {
        x.is_normal()
    }
    #[inline]
    fn quotient(a: &T, b: &T) -> f64 {
        let wide = |x: &T| x.to_f64().unwrap_or(f64::NAN);
        (wide(a) / wide(b)).abs()
    }
}

impl<T: LaneFloat> Range for LaneFormat<T> {
    fn rounding(self) -> Rounding {
        Native::<T>::new().rounding()
    }
    #[inline]
    fn is_zero(x: &LaneReal<T>) -> bool {
        Native::is_zero(&x.0)
    }
    #[inline]
    fn is_negative(x: &LaneReal<T>) -> bool {
        Native::is_negative(&x.0)
    }
    #[inline]
    fn is_subnormal(x: &LaneReal<T>) -> bool {
        Native::is_subnormal(&x.0)
    }
    #[inline]
    fn is_end(_: &LaneReal<T>) -> bool {
        false
    }
    #[inline]
    fn is_ordinary(x: &LaneReal<T>) -> bool {
        Native::is_ordinary(&x.0)
    }
    #[inline]
    fn quotient(a: &LaneReal<T>, b: &LaneReal<T>) -> f64 {
        Native::quotient(&a.0, &b.0)
    }
}

impl Range for Ieee {
    fn rounding(self) -> Rounding {
        floating(self.bits(), f64::from(self.emin()))
    }
    fn is_zero(x: &Self::Real) -> bool {
        x.as_float().is_zero()
    }
    fn is_negative(x: &Self::Real) -> bool {
        x.as_float().is_sign_negative() && !x.as_float().is_zero()
    }
    fn is_subnormal(x: &Self::Real) -> bool {
        // MPFR's exponents are those of numbers in [½, 1).
        let exponent = x.as_float().get_exp();
        exponent.is_some_and(|exponent| exponent <= x.format().emin())
    }
    fn is_end(_: &Self::Real) -> bool {
        false
    }
    fn is_ordinary(x: &Self::Real) -> bool {
        // Other numbers have no exponent.
        let exponent = x.as_float().get_exp();
        exponent.is_some_and(|exponent| exponent > x.format().emin())
    }
    fn quotient(a: &Self::Real, b: &Self::Real) -> f64 {
        let ((a, of_a), (b, of_b)) = (a.as_float().to_f64_exp(), b.as_float().to_f64_exp());
        (a / b).abs() * (f64::from(of_a) - f64::from(of_b)).exp2()
    }
}

impl Range for Fixed {
    fn rounding(self) -> Rounding {
        Rounding {
            unit: 0.0,
            log2_quantum: -f64::from(self.fraction_bits()) - 1.0,
            bits: self.bits(),
        }
    }
    fn is_zero(x: &FixedReal) -> bool {
        x.quanta() == Some(0)
    }
    fn is_negative(x: &FixedReal) -> bool {
        x.quanta().is_some_and(|quanta| quanta < 0)
    }
    fn is_subnormal(_: &FixedReal) -> bool {
        false
    }
    fn is_end(x: &FixedReal) -> bool {
        let quanta = x.quanta().map(i64::abs);
        quanta == Some(x.format().largest())
    }
    fn is_ordinary(x: &FixedReal) -> bool {
        !Self::is_zero(x) && x.is_finite() && !Self::is_end(x)
    }
    fn quotient(a: &FixedReal, b: &FixedReal) -> f64 {
        let quanta = |x: &FixedReal| x.quanta().map_or(f64::NAN, |quanta| quanta as f64);
        (quanta(a) / quanta(b)).abs()
    }
}
