//! Numbers of a counted format.

use super::{Counted, Kind, tick};
use crate::real::Real;
use rug::{Float, Rational};
use std::cmp::Ordering;
use std::fmt::{self, Display};
use std::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign};

/// A number that counts what is done with it.
#[derive(Debug)]
pub struct CountedReal<R>(pub(super) R);

impl<R> CountedReal<R> {
    /// The number itself.
    #[must_use]
    pub fn into_inner(self) -> R {
        self.0
    }
}

impl<R> From<R> for CountedReal<R> {
    fn from(number: R) -> Self {
        CountedReal(number)
    }
}

impl<R: Clone> Clone for CountedReal<R> {
    #[inline]
    fn clone(&self) -> Self {
        tick(Kind::Copy);
        CountedReal(self.0.clone())
    }
}

impl<R: PartialEq> PartialEq for CountedReal<R> {
    #[inline]
    fn eq(&self, other: &Self) -> bool {
        tick(Kind::Comparison);
        self.0 == other.0
    }
}

impl<R: PartialOrd> PartialOrd for CountedReal<R> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        tick(Kind::Comparison);
        self.0.partial_cmp(&other.0)
    }
}

impl<R: Display> Display for CountedReal<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl<R: Neg<Output = R>> Neg for CountedReal<R> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        tick(Kind::Negation);
        CountedReal(-self.0)
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, $assign_trait:ident, $assign_method:ident, $kind:ident) => {
        impl<'a, R: Real> $trait<&'a CountedReal<R>> for CountedReal<R> {
            type Output = CountedReal<R>;
            #[inline]
            fn $method(self, other: &'a CountedReal<R>) -> CountedReal<R> {
                tick(Kind::$kind);
                CountedReal($trait::$method(self.0, &other.0))
            }
        }
        impl<'a, R: Real> $assign_trait<&'a CountedReal<R>> for CountedReal<R> {
            #[inline]
            fn $assign_method(&mut self, other: &'a CountedReal<R>) {
                tick(Kind::$kind);
                $assign_trait::$assign_method(&mut self.0, &other.0);
            }
        }
    };
}
operator!(Add, add, AddAssign, add_assign, Addition);
operator!(Sub, sub, SubAssign, sub_assign, Addition);
operator!(Mul, mul, MulAssign, mul_assign, Multiplication);
operator!(Div, div, DivAssign, div_assign, Division);

macro_rules! functions {
    ($($function:ident: $kind:ident,)*) => {
        $(#[inline]
        fn $function(self) -> Self {
            tick(Kind::$kind);
            CountedReal(Real::$function(self.0))
        })*
    };
}

impl<R: Real> Real for CountedReal<R> {
    type Format = Counted<R::Format>;

    functions! {
        abs: Negation,
        sqrt: SquareRoot,
        exp: Exponential,
        exp_m1: ExponentialMinusOne,
        ln: Logarithm,
        ln_1p: Logarithm,
        tan: Tangent,
        sinh: Hyperbolic,
        cosh: Hyperbolic,
        tanh: Hyperbolic,
        atan: Arctangent,
        erf: ErrorFunction,
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        tick(Kind::SineCosine);
        let (sin, cos) = self.0.sin_cos();
        (CountedReal(sin), CountedReal(cos))
    }
    #[inline]
    fn format(&self) -> Counted<R::Format> {
        Counted(self.0.format())
    }
    #[inline]
    fn set(&mut self, from: &Self) {
        tick(Kind::Copy);
        self.0.set(&from.0);
    }
    #[inline]
    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }
    fn to_rational(&self) -> Option<Rational> {
        self.0.to_rational()
    }
    fn to_float(&self) -> Float {
        self.0.to_float()
    }
    fn log2_abs(&self) -> f64 {
        self.0.log2_abs()
    }
}
