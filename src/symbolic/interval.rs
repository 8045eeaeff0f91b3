//! Closed intervals of real numbers, their bounds in MPFR and rounded outwards.
//!
//! Every operation gives an interval that contains each value it takes on the arguments, whatever the
//! number of bits. Operations of two intervals work at the greater of the two numbers of bits. What
//! depends on one argument only is as tight as its bounds can be written, up to a rounding or two; what
//! depends on two treats them as unrelated: `x - x` is not 0.

mod arithmetic;
mod elementary;
mod power;
mod trigonometric;

use rug::float::{Constant, Round, Special, prec_max, prec_min};
use rug::ops::AssignRound;
use rug::{Float, Rational};
use std::cmp::Ordering;
use std::fmt;

/// All real numbers from a lower to an upper bound, which may be −∞ and +∞ and are never NaN.
#[derive(Clone, Debug, PartialEq)]
pub struct Interval {
    lower: Float,
    upper: Float,
}

/// Why an operation has no value on an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undefined {
    /// Some of the numbers in the interval may be outside the domain.
    Possibly,
    /// Every number in the interval is outside the domain.
    Certainly,
}

/// A bound: `value` correctly rounded to `bits`.
fn rounded<T>(bits: u32, value: T, round: Round) -> Float
where
    Float: AssignRound<T, Round = Round, Ordering = Ordering>,
{
    Float::with_val_round(bits.clamp(prec_min(), prec_max()), value, round).0
}

impl Interval {
    /// The interval between two bounds; a NaN is no bound.
    fn new(lower: Float, upper: Float) -> Interval {
        let or = |bound: Float, unbounded: Special| {
            if bound.is_nan() {
                Float::with_val(bound.prec(), unbounded)
            } else {
                bound
            }
        };
        Interval {
            lower: or(lower, Special::NegInfinity),
            upper: or(upper, Special::Infinity),
        }
    }

    /// Both bounds from the same value, rounded downwards and upwards.
    fn outward<T>(bits: u32, value: impl Fn() -> T) -> Interval
    where
        Float: AssignRound<T, Round = Round, Ordering = Ordering>,
    {
        Interval::new(
            rounded(bits, value(), Round::Down),
            rounded(bits, value(), Round::Up),
        )
    }

    /// The tightest interval of `bits` around q.
    #[must_use]
    pub fn point(bits: u32, q: &Rational) -> Interval {
        Interval::outward(bits, || q)
    }

    /// The tightest interval of `bits` around both numbers and all between.
    #[must_use]
    pub fn hull(bits: u32, from: &Rational, to: &Rational) -> Interval {
        Interval::new(
            rounded(bits, from.min(to), Round::Down),
            rounded(bits, from.max(to), Round::Up),
        )
    }

    /// The tightest interval of `bits` around π.
    #[must_use]
    pub fn pi(bits: u32) -> Interval {
        Interval::outward(bits, || Constant::Pi)
    }

    /// All real numbers.
    #[must_use]
    pub fn entire(bits: u32) -> Interval {
        Interval::new(
            rounded(bits, Special::NegInfinity, Round::Down),
            rounded(bits, Special::Infinity, Round::Up),
        )
    }

    /// The integer n.
    fn integer(bits: u32, n: i32) -> Interval {
        Interval::outward(bits, || n)
    }

    /// The greatest number known to be no greater than any in the interval.
    #[must_use]
    pub fn lower(&self) -> &Float {
        &self.lower
    }

    /// The least number known to be no less than any in the interval.
    #[must_use]
    pub fn upper(&self) -> &Float {
        &self.upper
    }

    /// The number of bits of the bounds.
    #[must_use]
    pub fn bits(&self) -> u32 {
        self.lower.prec().max(self.upper.prec())
    }

    /// Upper less lower bound, rounded upwards.
    #[must_use]
    pub fn width(&self) -> Float {
        rounded(self.bits(), &self.upper - &self.lower, Round::Up)
    }

    /// A number in the interval, halfway between its bounds where both are finite.
    #[must_use]
    pub fn midpoint(&self) -> Float {
        let bits = self.bits();
        if !self.is_finite() {
            return match (self.lower.is_finite(), self.upper.is_finite()) {
                (true, _) => self.lower.clone(),
                (_, true) => self.upper.clone(),
                _ => Float::with_val(bits, 0),
            };
        }
        let half: Float = rounded(bits, &self.upper - &self.lower, Round::Down) >> 1_u32;
        rounded(bits, &self.lower + &half, Round::Down)
    }

    /// The interval of one number, without rounding.
    #[must_use]
    pub fn exactly(x: &Float) -> Interval {
        Interval::new(x.clone(), x.clone())
    }

    /// Whether 0 is in it.
    #[must_use]
    pub fn contains_zero(&self) -> bool {
        self.lower <= 0 && self.upper >= 0
    }

    /// Whether x is in it.
    #[must_use]
    pub fn contains(&self, x: &Float) -> bool {
        self.lower <= *x && *x <= self.upper
    }

    /// Whether 0 is all there is in it.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        self.lower == 0 && self.upper == 0
    }

    /// Whether all of it is > 0.
    #[must_use]
    pub fn is_positive(&self) -> bool {
        self.lower > 0
    }

    /// Whether all of it is ≥ 0.
    #[must_use]
    pub fn is_nonnegative(&self) -> bool {
        self.lower >= 0
    }

    /// Whether all of it is < 0.
    #[must_use]
    pub fn is_negative(&self) -> bool {
        self.upper < 0
    }

    /// Whether all of it is ≤ 0.
    #[must_use]
    pub fn is_nonpositive(&self) -> bool {
        self.upper <= 0
    }

    /// Whether both bounds are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        self.lower.is_finite() && self.upper.is_finite()
    }

    /// Everything in either of the two, and between them.
    #[must_use]
    pub fn union(&self, other: &Interval) -> Interval {
        Interval {
            lower: least(&self.lower, &other.lower),
            upper: greatest(&self.upper, &other.upper),
        }
    }

    /// What is in both.
    #[must_use]
    pub fn intersection(&self, other: &Interval) -> Option<Interval> {
        let lower = greatest(&self.lower, &other.lower);
        let upper = least(&self.upper, &other.upper);
        (lower <= upper).then_some(Interval { lower, upper })
    }
}

fn least(a: &Float, b: &Float) -> Float {
    if b < a { b.clone() } else { a.clone() }
}

fn greatest(a: &Float, b: &Float) -> Float {
    if b > a { b.clone() } else { a.clone() }
}

impl fmt::Display for Interval {
    /// Both bounds in decimal, rounded outwards to 6 digits or to as many as asked for; one number where
    /// both are the same.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let digits = f.precision().unwrap_or(6).max(1);
        let decimal = |bound: &Float, round| bound.to_string_radix_round(10, Some(digits), round);
        let (lower, upper) = (
            decimal(&self.lower, Round::Down),
            decimal(&self.upper, Round::Up),
        );
        if lower == upper {
            f.write_str(&lower)
        } else {
            write!(f, "[{lower}, {upper}]")
        }
    }
}
