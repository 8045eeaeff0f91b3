//! A scalar without rounding: rational numbers behind the same traits as all others.

use rug::Rational;
use std::fmt;
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};
use volver::real::{Format, Real};

/// The format without rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Exact;

#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub(crate) struct Number(pub(crate) Rational);

impl fmt::Display for Exact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("exact")
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl Neg for Number {
    type Output = Number;
    fn neg(self) -> Number {
        Number(-self.0)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign_method:ident) => {
        impl<'a> $trait<&'a Number> for Number {
            type Output = Number;
            fn $method(self, other: &'a Number) -> Number {
                Number($trait::$method(self.0, &other.0))
            }
        }
        impl<'a> $assign_trait<&'a Number> for Number {
            fn $assign_method(&mut self, other: &'a Number) {
                $assign_trait::$assign_method(&mut self.0, &other.0);
            }
        }
    };
}
operator!(Add, add, AddAssign, add_assign);
operator!(Sub, sub, SubAssign, sub_assign);
operator!(Mul, mul, MulAssign, mul_assign);
operator!(Div, div, DivAssign, div_assign);

impl Format for Exact {
    type Real = Number;
    /// Decides only how precise the rational tables of Gauss–Legendre rules are.
    fn bits(self) -> u32 {
        24
    }
    fn int(self, n: i64) -> Number {
        Number(n.into())
    }
    fn ratio(self, q: &Rational) -> Number {
        Number(q.clone())
    }
    fn pi(self) -> Number {
        unimplemented!("not rational")
    }
}

impl Real for Number {
    type Format = Exact;
    fn format(&self) -> Exact {
        Exact
    }
    fn set(&mut self, from: &Self) {
        self.0.clone_from(&from.0);
    }
    fn abs(self) -> Self {
        Number(self.0.abs())
    }
    fn sqrt(self) -> Self {
        unimplemented!("not rational")
    }
    fn exp(self) -> Self {
        unimplemented!("not rational")
    }
    fn exp_m1(self) -> Self {
        unimplemented!("not rational")
    }
    fn ln(self) -> Self {
        unimplemented!("not rational")
    }
    fn ln_1p(self) -> Self {
        unimplemented!("not rational")
    }
    fn sin_cos(self) -> (Self, Self) {
        unimplemented!("not rational")
    }
    fn tan(self) -> Self {
        unimplemented!("not rational")
    }
    fn sinh(self) -> Self {
        unimplemented!("not rational")
    }
    fn cosh(self) -> Self {
        unimplemented!("not rational")
    }
    fn tanh(self) -> Self {
        unimplemented!("not rational")
    }
    fn atan(self) -> Self {
        unimplemented!("not rational")
    }
    fn erf(self) -> Self {
        unimplemented!("not rational")
    }
    fn is_finite(&self) -> bool {
        true
    }
    fn to_rational(&self) -> Option<Rational> {
        Some(self.0.clone())
    }
    fn log2_abs(&self) -> f64 {
        self.0.to_f64().abs().log2()
    }
}
