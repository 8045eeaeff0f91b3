//! What programs are run on here: real intervals and complex rectangles.

use super::narrow;
use super::rectangle::Rectangle;
use crate::symbolic::{Function, Interval};
use rug::float::Special;
use rug::{Float, Rational};

/// Sets of numbers that every operation encloses; `None` where it may not be defined on all of them.
pub(super) trait Number: Clone {
    fn constant(bits: u32, q: &Rational) -> Self;
    fn pi(bits: u32) -> Self;
    /// The bits that it is held with.
    fn bits(&self) -> u32;
    fn plus(&self, other: &Self) -> Self;
    fn minus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    fn squared(&self) -> Self;
    fn over(&self, divisor: &Self) -> Option<Self>;
    fn negated(&self) -> Self;
    fn sqrt(&self) -> Option<Self>;
    fn exp_m1(&self) -> Option<Self>;
    fn ln_1p(&self) -> Option<Self>;
    fn sin_cos(&self) -> (Self, Self);
    /// Any function but |x|, which is a matter of branches.
    fn call(&self, function: Function) -> Option<Self>;
}

/// Numbers of the line or of the plane.
pub(super) trait Plane: Number {
    /// A part of the real line.
    fn real(x: &Interval) -> Self;
    /// Whether no number in it is left of the imaginary axis.
    fn is_right(&self) -> bool;
    /// All that is in either of two, and between them.
    fn union(&self, other: &Self) -> Self;
}

impl Plane for Interval {
    fn real(x: &Interval) -> Self {
        x.clone()
    }
    fn is_right(&self) -> bool {
        self.is_nonnegative()
    }
    fn union(&self, other: &Self) -> Self {
        Interval::union(self, other)
    }
}

impl Plane for Rectangle {
    fn real(x: &Interval) -> Self {
        Rectangle::real(x.clone())
    }
    fn is_right(&self) -> bool {
        self.re.is_nonnegative()
    }
    fn union(&self, other: &Self) -> Self {
        Rectangle {
            re: self.re.union(&other.re),
            im: self.im.union(&other.im),
        }
    }
}

impl Number for Interval {
    fn constant(bits: u32, q: &Rational) -> Self {
        Interval::point(bits, q)
    }
    fn pi(bits: u32) -> Self {
        Interval::pi(bits)
    }
    fn bits(&self) -> u32 {
        Interval::bits(self)
    }
    fn plus(&self, other: &Self) -> Self {
        self + other
    }
    fn minus(&self, other: &Self) -> Self {
        self - other
    }
    fn times(&self, other: &Self) -> Self {
        self * other
    }
    fn squared(&self) -> Self {
        let magnitude = self.abs();
        &magnitude * &magnitude
    }
    fn over(&self, divisor: &Self) -> Option<Self> {
        self.divide(divisor).ok()
    }
    fn negated(&self) -> Self {
        -self
    }
    fn sqrt(&self) -> Option<Self> {
        Interval::sqrt(self).ok()
    }
    fn exp_m1(&self) -> Option<Self> {
        Some(Interval::exp_m1(self))
    }
    fn ln_1p(&self) -> Option<Self> {
        Interval::ln_1p(self).ok()
    }
    fn sin_cos(&self) -> (Self, Self) {
        narrow::sin_cos(self).unwrap_or_else(|| (self.sin(), self.cos()))
    }
    fn call(&self, function: Function) -> Option<Self> {
        match function {
            Function::Exp => Some(exp(self)),
            Function::Ln if *self.lower() == 0 => {
                // At 0 itself there is no value; an integral does not see it.
                let unbounded = Float::with_val(self.bits(), Special::NegInfinity);
                let above = Interval::exactly(self.upper()).ln().ok()?;
                Some(above.union(&Interval::exactly(&unbounded)))
            }
            Function::Ln => self.ln().ok(),
            Function::Sin => Some(self.sin()),
            Function::Cos => Some(self.cos()),
            Function::Tan => self.tan().ok(),
            Function::Sinh => Some(self.sinh()),
            Function::Cosh => Some(self.cosh()),
            Function::Tanh => Some(self.tanh()),
            Function::Atan => Some(self.atan()),
            Function::Erf => Some(self.erf()),
            Function::Abs => None,
        }
    }
}

/// e^x, by one exponential where that does.
pub(super) fn exp(x: &Interval) -> Interval {
    narrow::exp(x).unwrap_or_else(|| x.exp())
}

impl Number for Rectangle {
    fn constant(bits: u32, q: &Rational) -> Self {
        Rectangle::constant(bits, q)
    }
    fn pi(bits: u32) -> Self {
        Rectangle::real(Interval::pi(bits))
    }
    fn bits(&self) -> u32 {
        Rectangle::bits(self)
    }
    fn plus(&self, other: &Self) -> Self {
        Rectangle::plus(self, other)
    }
    fn minus(&self, other: &Self) -> Self {
        Rectangle::minus(self, other)
    }
    fn times(&self, other: &Self) -> Self {
        Rectangle::times(self, other)
    }
    fn squared(&self) -> Self {
        Rectangle::squared(self)
    }
    fn over(&self, divisor: &Self) -> Option<Self> {
        Rectangle::over(self, divisor)
    }
    fn negated(&self) -> Self {
        Rectangle::negated(self)
    }
    fn sqrt(&self) -> Option<Self> {
        Rectangle::sqrt(self)
    }
    fn exp_m1(&self) -> Option<Self> {
        Rectangle::exp_m1(self)
    }
    fn ln_1p(&self) -> Option<Self> {
        Rectangle::ln_1p(self)
    }
    fn sin_cos(&self) -> (Self, Self) {
        Rectangle::sin_cos(self)
    }
    fn call(&self, function: Function) -> Option<Self> {
        match function {
            Function::Exp => Some(self.exp()),
            Function::Ln => self.ln(),
            Function::Sin => Some(self.sin_cos().0),
            Function::Cos => Some(self.sin_cos().1),
            Function::Tan => self.tan(),
            Function::Sinh => Some(self.sinh()),
            Function::Cosh => Some(self.cosh()),
            Function::Tanh => self.tanh(),
            Function::Atan => self.atan(),
            Function::Erf => self.erf(),
            Function::Abs => None,
        }
    }
}
