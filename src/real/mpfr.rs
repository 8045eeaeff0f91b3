//! MPFR of any precision, given at run time.

#[cfg(feature = "flint")]
mod flint;
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

/// A function in place, by FLINT where it is there and settles the last bit.
macro_rules! function {
    ($name:ident, $in_place:ident) => {
        fn $name(mut self) -> Self {
            #[cfg(feature = "flint")]
            if flint::$name(&mut self.0) {
                return self;
            }
            self.0.$in_place();
            self
        }
    };
}

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
    fn set_exp_of_negative(&mut self, x: &Self) {
        rug::Assign::assign(&mut self.0, -&x.0);
        #[cfg(feature = "flint")]
        if flint::exp(&mut self.0) {
            return;
        }
        self.0.exp_mut();
    }
    function!(exp, exp_mut);
    function!(exp_m1, exp_m1_mut);
    function!(ln, ln_mut);
    function!(ln_1p, ln_1p_mut);
    function!(tan, tan_mut);
    function!(sinh, sinh_mut);
    function!(cosh, cosh_mut);
    function!(tanh, tanh_mut);
    function!(atan, atan_mut);
    fn sin_cos(mut self) -> (Self, Self) {
        #[cfg(feature = "flint")]
        if let Some(cos) = flint::sin_cos(&mut self.0) {
            return (self, MpfrReal(cos));
        }
        let mut cos = Float::new(self.0.prec());
        self.0.sin_cos_mut(&mut cos);
        (self, MpfrReal(cos))
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
