//! Numbers of emulated formats.

use super::Ieee;
use crate::real::Real;
use rug::float::Round;
use rug::ops::{
    AddAssignRound, AssignRound, DivAssignRound, MulAssignRound, NegAssign, SubAssignRound,
};
use rug::{Float, Rational};
use std::cmp::Ordering;
use std::fmt::{self, Display};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number of an [`Ieee`] format. As IEEE 754 has it: −0 equals 0, NaN equals nothing, infinities are
/// numbers.
#[derive(Clone, Debug)]
pub struct IeeeReal {
    format: Ieee,
    value: Float,
}

impl IeeeReal {
    /// `value` must be a number of `format`.
    pub(super) fn new(format: Ieee, value: Float) -> Self {
        IeeeReal { format, value }
    }

    /// The number itself.
    #[must_use]
    pub fn as_float(&self) -> &Float {
        &self.value
    }

    /// What `operation` leaves at this format's bits, with its ternary value, brought into the range.
    fn update(&mut self, operation: impl FnOnce(&mut Float) -> Ordering) {
        let ternary = operation(&mut self.value);
        self.format.fit_mut(&mut self.value, ternary);
    }
}

impl PartialEq for IeeeReal {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl PartialOrd for IeeeReal {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl Display for IeeeReal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        Display::fmt(&self.value, f)
    }
}

impl Neg for IeeeReal {
    type Output = Self;
    fn neg(mut self) -> Self {
        self.value.neg_assign();
        self
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign_method:ident, $rounded:ident) => {
        impl<'a> $trait<&'a IeeeReal> for IeeeReal {
            type Output = IeeeReal;
            fn $method(mut self, other: &'a IeeeReal) -> IeeeReal {
                $assign_trait::$assign_method(&mut self, other);
                self
            }
        }
        impl<'a> $assign_trait<&'a IeeeReal> for IeeeReal {
            fn $assign_method(&mut self, other: &'a IeeeReal) {
                self.update(|value| value.$rounded(&other.value, Round::Nearest));
            }
        }
    };
}
operator!(Add, add, AddAssign, add_assign, add_assign_round);
operator!(Sub, sub, SubAssign, sub_assign, sub_assign_round);
operator!(Mul, mul, MulAssign, mul_assign, mul_assign_round);
operator!(Div, div, DivAssign, div_assign, div_assign_round);

macro_rules! rounded_by_mpfr {
    ($($function:ident by $rounded:ident,)*) => {$(
        fn $function(mut self) -> Self {
            self.update(|value| value.$rounded(Round::Nearest));
            self
        }
    )*};
}

impl Real for IeeeReal {
    type Format = Ieee;

    fn format(&self) -> Ieee {
        self.format
    }
    fn set(&mut self, from: &Self) {
        self.update(|value| value.assign_round(&from.value, Round::Nearest));
    }
    fn abs(mut self) -> Self {
        self.value.abs_mut();
        self
    }
    rounded_by_mpfr! {
        sqrt by sqrt_round,
        exp by exp_round,
        exp_m1 by exp_m1_round,
        ln by ln_round,
        ln_1p by ln_1p_round,
        tan by tan_round,
        sinh by sinh_round,
        cosh by cosh_round,
        tanh by tanh_round,
        atan by atan_round,
        erf by erf_round,
    }
    fn sin_cos(mut self) -> (Self, Self) {
        let mut cos = Float::new(self.format.bits);
        let (of_sin, of_cos) = self.value.sin_cos_round(&mut cos, Round::Nearest);
        self.format.fit_mut(&mut self.value, of_sin);
        let cos = self.format.fit((cos, of_cos));
        (self, cos)
    }
    fn is_finite(&self) -> bool {
        self.value.is_finite()
    }
    fn to_rational(&self) -> Option<Rational> {
        self.value.to_rational()
    }
    fn log2_abs(&self) -> f64 {
        let (mantissa, exponent) = self.value.to_f64_exp();
        mantissa.abs().log2() + f64::from(exponent)
    }
}
