//! MPFR of any precision, given at run time.

#[cfg(feature = "studies")]
mod near;

#[cfg(feature = "studies")]
pub(crate) use near::Near;

use super::{Format, Real};
use rug::float::{Constant, MiniFloat};
use rug::{Float, Rational};
use std::fmt::{self, Display};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// MPFR with `bits` significant bits; every operation and elementary function correctly rounded.
///
/// `bits` must lie in [`MIN_BITS`](super::MIN_BITS)…[`MAX_BITS`](super::MAX_BITS);
/// [`FormatName`](super::FormatName) checks it for text from outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Mpfr {
    /// Significant bits.
    pub bits: u32,
}

impl Display for Mpfr {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "mpfr:{}", self.bits)
    }
}

/// A number of an [`Mpfr`] format: rug's `Float` behind the operators that [`Real`] asks for.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub struct MpfrReal(Float);

impl MpfrReal {
    /// The number itself.
    #[must_use]
    pub fn as_float(&self) -> &Float {
        &self.0
    }
}

impl From<Float> for MpfrReal {
    fn from(x: Float) -> Self {
        MpfrReal(x)
    }
}

impl From<MpfrReal> for Float {
    fn from(x: MpfrReal) -> Self {
        x.0
    }
}

impl Display for MpfrReal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(&self.0, f)
    }
}

impl Neg for MpfrReal {
    type Output = Self;
    fn neg(self) -> Self {
        MpfrReal(-self.0)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign_method:ident) => {
        impl<'a> $trait<&'a MpfrReal> for MpfrReal {
            type Output = MpfrReal;
            fn $method(self, other: &'a MpfrReal) -> MpfrReal {
                MpfrReal($trait::$method(self.0, &other.0))
            }
        }
        impl<'a> $assign_trait<&'a MpfrReal> for MpfrReal {
            fn $assign_method(&mut self, other: &'a MpfrReal) {
                $assign_trait::$assign_method(&mut self.0, &other.0);
            }
        }
    };
}
operator!(Add, add, AddAssign, add_assign);
operator!(Sub, sub, SubAssign, sub_assign);
operator!(Mul, mul, MulAssign, mul_assign);
operator!(Div, div, DivAssign, div_assign);

impl Format for Mpfr {
    type Real = MpfrReal;

    const ROUNDS_FUNCTIONS: bool = true;

    fn bits(self) -> u32 {
        self.bits
    }
    fn int(self, n: i64) -> MpfrReal {
        MpfrReal(Float::with_val(self.bits, n))
    }
    fn ratio(self, q: &Rational) -> MpfrReal {
        MpfrReal(Float::with_val(self.bits, q))
    }
    fn fraction(self, numerator: u64, denominator: u64) -> MpfrReal {
        // The numerator is exact in 64 bits, and the division rounds once.
        let numerator = MiniFloat::from(numerator);
        let numerator = numerator.borrow();
        MpfrReal(Float::with_val(self.bits, &*numerator / denominator))
    }
    fn binary64(self, x: f64) -> MpfrReal {
        let finite = if x.is_finite() { x + 0.0 } else { f64::NAN };
        MpfrReal(Float::with_val(self.bits, finite))
    }
    fn pi(self) -> MpfrReal {
        MpfrReal(Float::with_val(self.bits, Constant::Pi))
    }
}

impl Real for MpfrReal {
    type Format = Mpfr;

    fn format(&self) -> Mpfr {
        Mpfr {
            bits: self.0.prec(),
        }
    }
    fn set(&mut self, from: &Self) {
        rug::Assign::assign(&mut self.0, &from.0);
    }
    fn abs(self) -> Self {
        MpfrReal(self.0.abs())
    }
    fn sqrt(self) -> Self {
        MpfrReal(self.0.sqrt())
    }
    fn exp(self) -> Self {
        MpfrReal(self.0.exp())
    }
    fn set_exp_of_negative(&mut self, x: &Self) {
        rug::Assign::assign(&mut self.0, -&x.0);
        self.0.exp_mut();
    }
    fn exp_m1(self) -> Self {
        MpfrReal(self.0.exp_m1())
    }
    fn ln(self) -> Self {
        MpfrReal(self.0.ln())
    }
    fn ln_1p(self) -> Self {
        MpfrReal(self.0.ln_1p())
    }
    fn sin_cos(self) -> (Self, Self) {
        let cos = Float::new(self.0.prec());
        let (sin, cos) = self.0.sin_cos(cos);
        (MpfrReal(sin), MpfrReal(cos))
    }
    fn tan(self) -> Self {
        MpfrReal(self.0.tan())
    }
    fn sinh(self) -> Self {
        MpfrReal(self.0.sinh())
    }
    fn cosh(self) -> Self {
        MpfrReal(self.0.cosh())
    }
    fn tanh(self) -> Self {
        MpfrReal(self.0.tanh())
    }
    fn atan(self) -> Self {
        MpfrReal(self.0.atan())
    }
    fn erf(self) -> Self {
        MpfrReal(self.0.erf())
    }
    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }
    fn to_rational(&self) -> Option<Rational> {
        self.0.to_rational()
    }
    fn to_float(&self) -> Float {
        self.0.clone()
    }
    fn to_float_of(&self, bits: u32) -> Float {
        Float::with_val(bits, &self.0)
    }
    fn rounded(&self, near: &MpfrReal, error_bits: u32) -> Option<Self> {
        let (bits, near) = (self.0.prec(), &near.0);
        // 2^exponent is more than |near|.
        let exponent = near.get_exp()?;
        let shift = i32::try_from(near.prec().checked_sub(error_bits)?).ok()?;
        let error = Float::with_val(1, 1) << exponent.checked_sub(shift)?;
        let below = Float::with_val(bits, near - &error);
        let above = Float::with_val(bits, near + &error);
        (below == above).then_some(MpfrReal(below))
    }
    fn log2_abs(&self) -> f64 {
        // Mantissa and exponent apart: neither a rounded logarithm nor binary64's range is in the way.
        let (mantissa, exponent) = self.0.to_f64_exp();
        mantissa.abs().log2() + f64::from(exponent)
    }
}
