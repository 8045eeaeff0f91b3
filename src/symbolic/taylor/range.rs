//! Intervals of binary64, rounded outwards: for bounds that have to be cheap rather than tight.

use rug::Rational;
use rug::float::Round;

/// Units in the last place by which the functions of the standard library and of `libm` may err, and more: what
/// is documented of glibc, musl and macOS is at most 3.
const LIBRARY_ERROR: f64 = 8.0 * f64::EPSILON;

/// All real numbers from `low` to `high`, which may be −∞ and ∞.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// No number is less.
    pub low: f64,
    /// No number is greater.
    pub high: f64,
}

impl Range {
    /// 0 alone.
    pub const ZERO: Range = Range {
        low: 0.0,
        high: 0.0,
    };
    /// All numbers.
    pub const ENTIRE: Range = Range {
        low: f64::NEG_INFINITY,
        high: f64::INFINITY,
    };

    /// Between two numbers; NaN is no bound.
    #[must_use]
    pub fn new(low: f64, high: f64) -> Range {
        if low.is_nan() || high.is_nan() {
            return Range::ENTIRE;
        }
        Range { low, high }
    }

    /// One number.
    #[must_use]
    pub fn point(x: f64) -> Range {
        Range::new(x, x)
    }

    /// The nearest binary64 numbers around q.
    #[must_use]
    pub fn around(q: &Rational) -> Range {
        let bound = |round| {
            rug::Float::with_val_round(53, q, round)
                .0
                .to_f64_round(round)
        };
        Range::new(bound(Round::Down), bound(Round::Up))
    }

    /// The bounds moved outwards by `error`, and by the rounding of doing so.
    #[must_use]
    pub(super) fn widened(self, error: f64) -> Range {
        Range::new(
            (self.low - error).next_down(),
            (self.high + error).next_up(),
        )
    }

    /// Whether 0 is in it.
    #[must_use]
    pub fn contains_zero(self) -> bool {
        self.low <= 0.0 && self.high >= 0.0
    }

    /// Whether 0 is all there is in it.
    #[must_use]
    pub fn is_zero(self) -> bool {
        self.low == 0.0 && self.high == 0.0
    }

    /// max |x|.
    #[must_use]
    pub fn magnitude(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// What is in both; `self` where they have nothing in common, which rounding outwards rules out.
    #[must_use]
    pub(super) fn intersection(self, other: Range) -> Range {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        if low <= high {
            Range { low, high }
        } else {
            self
        }
    }

    /// An increasing function whose values err by [`LIBRARY_ERROR`].
    #[must_use]
    pub(super) fn increasing(self, function: impl Fn(f64) -> f64) -> Range {
        // What is beyond the range of binary64 is beyond its largest number.
        let low = function(self.low).min(f64::MAX);
        let high = function(self.high).max(f64::MIN);
        let slack = |x: f64| x.abs() * LIBRARY_ERROR;
        Range::new(
            (low - slack(low)).next_down(),
            (high + slack(high)).next_up(),
        )
    }

    /// sin or cos, from the middle: neither moves faster than its argument.
    #[must_use]
    pub(super) fn wave(self, function: impl Fn(f64) -> f64) -> Range {
        let unit = Range::new(-1.0, 1.0);
        let middle = 0.5 * self.low + 0.5 * self.high;
        let reach = (self.high - middle).max(middle - self.low);
        if !middle.is_finite() || reach >= 2.0 {
            return unit;
        }
        let around = Range::point(function(middle)).widened(reach.next_up() + LIBRARY_ERROR);
        around.intersection(unit)
    }

    /// −x.
    #[must_use]
    pub fn negated(self) -> Range {
        Range {
            low: -self.high,
            high: -self.low,
        }
    }

    /// x + y.
    #[must_use]
    pub fn plus(self, other: Range) -> Range {
        Range::new(
            (self.low + other.low).next_down(),
            (self.high + other.high).next_up(),
        )
    }

    /// x·y, before it is rounded outwards.
    #[must_use]
    pub(super) fn times_to_nearest(self, other: Range) -> Range {
        let products = [
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ];
        // Infinite bounds, and 0·∞, which no minimum may pass over.
        if !products.iter().all(|p| p.is_finite()) {
            return if self.is_zero() || other.is_zero() {
                Range::ZERO
            } else {
                Range::ENTIRE
            };
        }
        let [a, b, c, d] = products;
        Range {
            low: a.min(b).min(c.min(d)),
            high: a.max(b).max(c.max(d)),
        }
    }

    /// x·y.
    #[must_use]
    pub fn times(self, other: Range) -> Range {
        let product = self.times_to_nearest(other);
        if product.is_zero() && (self.is_zero() || other.is_zero()) {
            return product;
        }
        Range::new(product.low.next_down(), product.high.next_up())
    }

    /// 1/x; all numbers where x may be 0.
    #[must_use]
    pub fn reciprocal(self) -> Range {
        if self.contains_zero() {
            return Range::ENTIRE;
        }
        Range::new((1.0 / self.high).next_down(), (1.0 / self.low).next_up())
    }
}
