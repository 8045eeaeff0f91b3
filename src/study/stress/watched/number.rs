//! Numbers of a watched format, and their functions.

use super::super::range::Range;
use super::{Events, Watched};
use crate::real::{Format, Real};
use rug::{Float, Rational};
use std::cmp::Ordering;
use std::fmt::{self, Display};

/// A number and what befell it.
#[derive(Clone, Debug)]
pub(in crate::study::stress) struct Observed<F: Format> {
    /// The number itself.
    pub(in crate::study::stress) value: F::Real,
    /// What was added on the way and changed nothing, relative to the number, at most: terms absorbed.
    pub(in crate::study::stress) lost: f32,
    /// What befell it.
    pub(in crate::study::stress) events: Events,
}

/// |a|/|b| of numbers that are not 0: never 0 itself, however small.
#[inline]
pub(super) fn quotient<F: Range>(a: &F::Real, b: &F::Real) -> f32 {
    #[allow(clippy::cast_possible_truncation)] // An estimate, and saturating.
    let quotient = F::quotient(a, b) as f32;
    quotient.max(f32::MIN_POSITIVE)
}

impl<F: Range> Observed<F> {
    /// A function of this number. `spoils`: its value may underflow, as no other's can.
    #[inline]
    fn map(self, spoils: bool, function: impl FnOnce(F::Real) -> F::Real) -> Self {
        let was = (self.value.is_finite(), F::is_zero(&self.value));
        let value = function(self.value);
        let mut events = self.events;
        events |= after::<F>(&value, was.0, was.1 || !spoils);
        Observed {
            value,
            lost: self.lost,
            events,
        }
    }
}

/// What befell a result of finite operands; `exact_zero`: it may be 0, or small, without loss.
#[inline]
pub(super) fn after<F: Range>(result: &F::Real, finite: bool, exact_zero: bool) -> Events {
    if F::is_ordinary(result) {
        return Events::NONE;
    }
    if !result.is_finite() {
        return if finite {
            Events::OVERFLOW
        } else {
            Events::NONE
        };
    }
    if F::is_end(result) {
        return Events::SATURATED;
    }
    if !exact_zero && finite && (F::is_zero(result) || F::is_subnormal(result)) {
        return Events::UNDERFLOW;
    }
    Events::NONE
}

impl<F: Range> PartialEq for Observed<F> {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value
    }
}

impl<F: Range> PartialOrd for Observed<F> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }
}

impl<F: Range> Display for Observed<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.value.fmt(f)
    }
}

impl<F: Range> Real for Observed<F> {
    type Format = Watched<F>;

    #[inline]
    fn format(&self) -> Watched<F> {
        Watched(self.value.format())
    }
    fn set(&mut self, from: &Self) {
        self.value.set(&from.value);
        self.lost = from.lost;
        self.events = from.events;
    }
    #[inline]
    fn abs(self) -> Self {
        Observed {
            value: self.value.abs(),
            ..self
        }
    }
    fn sqrt(self) -> Self {
        self.map(false, Real::sqrt)
    }
    #[inline]
    fn exp(self) -> Self {
        let zero = F::is_zero(&self.value);
        let argument = self.value.clone();
        // An infinite depth lets nothing through: e^(−∞) = 0 is exact.
        let mut result = self.map(true, Real::exp);
        if zero {
            return result;
        }
        let one = argument.format().int(1);
        if result.lost > 0.0 {
            result.lost *= quotient::<F>(&argument, &one);
        }
        if result.value == one {
            result.lost += quotient::<F>(&argument, &one);
        }
        result
    }
    #[inline]
    fn exp_m1(self) -> Self {
        self.map(true, Real::exp_m1)
    }
    fn ln(self) -> Self {
        self.map(false, Real::ln)
    }
    fn ln_1p(self) -> Self {
        self.map(true, Real::ln_1p)
    }
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.value.clone().sin_cos();
        (self.clone().map(true, |_| sin), self.map(false, |_| cos))
    }
    fn tan(self) -> Self {
        self.map(true, Real::tan)
    }
    fn sinh(self) -> Self {
        self.map(true, Real::sinh)
    }
    fn cosh(self) -> Self {
        self.map(false, Real::cosh)
    }
    fn tanh(self) -> Self {
        self.map(true, Real::tanh)
    }
    fn atan(self) -> Self {
        self.map(true, Real::atan)
    }
    fn erf(self) -> Self {
        self.map(true, Real::erf)
    }
    #[inline]
    fn is_finite(&self) -> bool {
        self.value.is_finite()
    }
    fn to_rational(&self) -> Option<Rational> {
        self.value.to_rational()
    }
    fn to_float(&self) -> Float {
        self.value.to_float()
    }
    fn log2_abs(&self) -> f64 {
        self.value.log2_abs()
    }
}
