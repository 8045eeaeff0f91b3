//! Numbers of fixed-point formats.

use super::{Fixed, nearest, nearest_shifted};
use crate::real::Real;
use rug::float::Round;
use rug::ops::AssignRound;
use rug::{Float, Rational};
use std::cmp::Ordering;
use std::fmt::{self, Display};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number of a [`Fixed`] format.
#[derive(Clone, Copy, Debug)]
pub struct FixedReal {
    format: Fixed,
    /// `None` is NaN.
    quanta: Option<i64>,
}

impl FixedReal {
    /// `quanta` must lie within the format's ends.
    pub(super) fn new(format: Fixed, quanta: Option<i64>) -> Self {
        FixedReal { format, quanta }
    }

    /// The number as a multiple of the quantum 2^−fraction; `None` for NaN.
    #[must_use]
    pub fn quanta(self) -> Option<i64> {
        self.quanta
    }

    /// Both numbers in the finer of their quanta; `None` where one is NaN.
    fn with(&self, other: &Self) -> Option<(i128, i128)> {
        let finest = self.format.fraction.max(other.format.fraction);
        let in_finest = |x: &Self| Some(i128::from(x.quanta?) << (finest - x.format.fraction));
        Some((in_finest(self)?, in_finest(other)?))
    }

    /// That many of the finer quanta of this number and the other, rounded once to this format.
    fn sum(&self, other: &Self, quanta: i128) -> Self {
        let finer = other.format.fraction.saturating_sub(self.format.fraction);
        self.format.saturate(nearest_shifted(quanta, finer))
    }

    fn nan(&self) -> Self {
        FixedReal::new(self.format, None)
    }

    /// Exact.
    fn exact(self) -> Option<Float> {
        Some(Float::with_val(64, self.quanta?) >> self.format.fraction)
    }

    /// What MPFR computes from this number, rounded once.
    fn by_mpfr(self, function: impl FnOnce(&Float, u32) -> (Float, Ordering)) -> Self {
        match self.exact() {
            Some(x) => self.format.fit(function(&x, self.format.working_bits())),
            None => self,
        }
    }
}

impl PartialEq for FixedReal {
    fn eq(&self, other: &Self) -> bool {
        self.partial_cmp(other) == Some(Ordering::Equal)
    }
}

impl PartialOrd for FixedReal {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.with(other).map(|(a, b)| a.cmp(&b))
    }
}

impl Display for FixedReal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // At most 46 significant bits: binary64 has the value.
        let value = self.exact().map_or(f64::NAN, |x| x.to_f64());
        Display::fmt(&value, f)
    }
}

impl Neg for FixedReal {
    type Output = Self;
    fn neg(self) -> Self {
        FixedReal::new(self.format, self.quanta.map(|quanta| -quanta))
    }
}

impl<'a> Add<&'a FixedReal> for FixedReal {
    type Output = FixedReal;
    fn add(self, other: &'a FixedReal) -> FixedReal {
        let sum = self.with(other).map(|(a, b)| self.sum(other, a + b));
        sum.unwrap_or(self.nan())
    }
}

impl<'a> Sub<&'a FixedReal> for FixedReal {
    type Output = FixedReal;
    fn sub(self, other: &'a FixedReal) -> FixedReal {
        let difference = self.with(other).map(|(a, b)| self.sum(other, a - b));
        difference.unwrap_or(self.nan())
    }
}

impl<'a> Mul<&'a FixedReal> for FixedReal {
    type Output = FixedReal;
    fn mul(self, other: &'a FixedReal) -> FixedReal {
        let (Some(a), Some(b)) = (self.quanta, other.quanta) else {
            return self.nan();
        };
        let product = i128::from(a) * i128::from(b);
        self.format
            .saturate(nearest_shifted(product, other.format.fraction))
    }
}

impl<'a> Div<&'a FixedReal> for FixedReal {
    type Output = FixedReal;
    fn div(self, other: &'a FixedReal) -> FixedReal {
        let (Some(a), Some(b)) = (self.quanta, other.quanta) else {
            return self.nan();
        };
        let numerator = i128::from(a) << other.format.fraction;
        match (a, b.signum()) {
            (0, 0) => self.nan(),
            (_, 0) => self.format.saturate(i128::MAX * i128::from(a.signum())),
            (_, sign) => {
                let (numerator, denominator) = (numerator * i128::from(sign), b.unsigned_abs());
                self.format.saturate(nearest(numerator, denominator.into()))
            }
        }
    }
}

macro_rules! assign {
    ($trait:ident, $method:ident, $operator:ident) => {
        impl<'a> $trait<&'a FixedReal> for FixedReal {
            fn $method(&mut self, other: &'a FixedReal) {
                *self = self.$operator(other);
            }
        }
    };
}
assign!(AddAssign, add_assign, add);
assign!(SubAssign, sub_assign, sub);
assign!(MulAssign, mul_assign, mul);
assign!(DivAssign, div_assign, div);

macro_rules! rounded_by_mpfr {
    ($($function:ident by $incomplete:ident,)*) => {$(
        fn $function(self) -> Self {
            self.by_mpfr(|x, bits| Float::with_val_round(bits, x.$incomplete(), Round::Nearest))
        }
    )*};
}

impl Real for FixedReal {
    type Format = Fixed;

    fn format(&self) -> Fixed {
        self.format
    }
    fn set(&mut self, from: &Self) {
        *self = FixedReal::new(self.format, Some(0)) + from;
    }
    fn abs(self) -> Self {
        FixedReal::new(self.format, self.quanta.map(i64::abs))
    }
    rounded_by_mpfr! {
        sqrt by sqrt_ref,
        exp by exp_ref,
        exp_m1 by exp_m1_ref,
        ln by ln_ref,
        ln_1p by ln_1p_ref,
        tan by tan_ref,
        sinh by sinh_ref,
        cosh by cosh_ref,
        tanh by tanh_ref,
        atan by atan_ref,
        erf by erf_ref,
    }
    fn sin_cos(self) -> (Self, Self) {
        let Some(x) = self.exact() else {
            return (self, self);
        };
        let bits = self.format.working_bits();
        let mut both = (Float::new(bits), Float::new(bits));
        let (of_sin, of_cos) = both.assign_round(x.sin_cos_ref(), Round::Nearest);
        let (sin, cos) = both;
        (
            self.format.fit((sin, of_sin)),
            self.format.fit((cos, of_cos)),
        )
    }
    fn is_finite(&self) -> bool {
        self.quanta.is_some()
    }
    fn to_rational(&self) -> Option<Rational> {
        Some(Rational::from(self.quanta?) >> self.format.fraction)
    }
    fn log2_abs(&self) -> f64 {
        let quanta = self.quanta.map_or(f64::NAN, |quanta| quanta.abs() as f64);
        quanta.log2() - f64::from(self.format.fraction)
    }
}
