//! The exponential of the optical depth: exact, or a Taylor polynomial.

use super::{Inner, OpticalDepth};
use crate::real::{Format, Real, row};
use rug::Rational;
use std::fmt;
use std::sync::Arc;

/// How exp(−x) is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Exponential {
    /// The format's exponential.
    Exact,
    /// 1 − x.
    Linear,
    /// 1 − x + x²/2.
    Quadratic,
    /// 1 − x + x²/2 − x³/6.
    Cubic,
}

/// What the exponential is taken of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scope {
    /// Each segment's depth: T = ∏ E(qⱼ), as compositing does.
    PerSegment,
    /// The whole optical depth: T = E(Σ qⱼ). A Taylor polynomial of it does not converge as d → 0.
    Whole,
}

impl Exponential {
    /// E(−x) for this approximation E.
    pub fn of_negative<R: Real>(self, x: &R) -> R {
        let degree = match self {
            Exponential::Exact => return (-x.clone()).exp(),
            Exponential::Linear => 1,
            Exponential::Quadratic => 2,
            Exponential::Cubic => 3,
        };
        // 1 − x (1 − x/2 (1 − x/3))
        let format = x.format();
        let mut sum = format.int(1);
        for k in (1..=degree).rev() {
            sum *= x;
            if k > 1 {
                sum /= &format.int(k);
            }
            sum = -sum;
            sum += &format.int(1);
        }
        sum
    }

    /// Makes `into` E(−x): in MPFR without a number's memory for it.
    pub(crate) fn set_of_negative<R: Real>(self, into: &mut R, x: &R) {
        match self {
            Exponential::Exact => into.set_exp_of_negative(x),
            _ => *into = self.of_negative(x),
        }
    }

    /// E(−x) of each.
    pub(crate) fn of_negatives<R: Real>(self, depths: &[R]) -> Vec<R> {
        if R::Format::IN_LANES && self == Exponential::Exact {
            let negatives = row(depths.iter().map(|depth| -depth.clone()));
            let mut exponentials = negatives.clone();
            R::exp_row(&negatives, &mut exponentials);
            return exponentials;
        }
        row(depths.iter().map(|depth| self.of_negative(depth)))
    }

    /// The order that this contributes to a method: a degree k polynomial per segment leaves
    /// O(d^(k+1)) in each of n = D/d segments, hence k; of the whole depth it leaves a constant, 0.
    /// `None` where it contributes no error.
    #[must_use]
    pub fn order(self, scope: Scope) -> Option<f64> {
        match (self, scope) {
            (Exponential::Exact, _) => None,
            (_, Scope::Whole) => Some(0.0),
            (Exponential::Linear, Scope::PerSegment) => Some(1.0),
            (Exponential::Quadratic, Scope::PerSegment) => Some(2.0),
            (Exponential::Cubic, Scope::PerSegment) => Some(3.0),
        }
    }
}

/// Which depths of a level a row holds.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Row {
    /// The rule that they are by.
    pub(crate) inner: Inner,
    /// From the front of the ray, or of each segment.
    pub(crate) scope: Scope,
    /// Up to that part of each segment; up to boundaries where there is none.
    pub(crate) offset: Option<Rational>,
}

/// Depths in a row, shared by those who keep them.
#[derive(Debug)]
pub(crate) enum Depths<R> {
    /// From the front of the ray to each boundary.
    Boundaries(Arc<OpticalDepth<R>>),
    /// Of each segment.
    Segments(Arc<OpticalDepth<R>>),
    /// Into each segment.
    Inside(Vec<R>),
}

impl<R> Depths<R> {
    /// One after the other.
    pub(crate) fn values(&self) -> &[R] {
        match self {
            Depths::Boundaries(depth) => &depth.boundaries,
            Depths::Segments(depth) => &depth.segments,
            Depths::Inside(depths) => depths,
        }
    }
}

/// Who takes the exponentials of a level, row by row.
pub(crate) trait Exponentials<R: Real> {
    /// E(−x) for each x of `depths`, which are those of `row`.
    fn of_negatives(&self, exponential: Exponential, row: Row, depths: Depths<R>) -> Arc<Vec<R>>;
}

/// Each by itself, as [`Exponential::of_negative`] has it.
pub(crate) struct Alone;

impl<R: Real> Exponentials<R> for Alone {
    fn of_negatives(&self, exponential: Exponential, _: Row, depths: Depths<R>) -> Arc<Vec<R>> {
        Arc::new(exponential.of_negatives(depths.values()))
    }
}

impl fmt::Display for Exponential {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Exponential::Exact => "exact",
            Exponential::Linear => "linear",
            Exponential::Quadratic => "quadratic",
            Exponential::Cubic => "cubic",
        })
    }
}
