//! Taylor coefficients as intervals, and their arithmetic.

use super::Range;

/// Coefficients 0, 1, 2 … of a function over a panel, those left out at the end being 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Taylor(pub(super) Vec<Range>);

impl Taylor {
    /// The function that is c everywhere.
    #[must_use]
    pub fn constant(c: Range) -> Taylor {
        Taylor(vec![c])
    }

    /// m + r u: over a panel around m that reaches r to both sides.
    #[must_use]
    pub fn variable(panel: Range, reach: f64) -> Taylor {
        Taylor(vec![panel, Range::point(reach)])
    }

    /// What is known of nothing: every coefficient up to `order` may be any number.
    #[must_use]
    pub fn unknown(order: usize) -> Taylor {
        Taylor(vec![Range::ENTIRE; order + 1])
    }

    /// Coefficient k.
    #[must_use]
    pub fn coefficient(&self, k: usize) -> Range {
        self.0.get(k).copied().unwrap_or(Range::ZERO)
    }

    /// How many coefficients there are before all are 0.
    #[must_use]
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there is none: the function is 0.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds term by term.
    pub(super) fn zip(&self, other: &Taylor, combine: impl Fn(Range, Range) -> Range) -> Taylor {
        let length = self.len().max(other.len());
        Taylor(
            (0..length)
                .map(|k| combine(self.coefficient(k), other.coefficient(k)))
                .collect(),
        )
    }

    /// f + g.
    pub(super) fn plus(&self, other: &Taylor) -> Taylor {
        self.zip(other, Range::plus)
    }

    /// f − g.
    pub(super) fn minus(&self, other: &Taylor) -> Taylor {
        self.zip(other, |a, b| a.plus(b.negated()))
    }

    /// −f.
    pub(super) fn negated(&self) -> Taylor {
        Taylor(self.0.iter().map(|c| c.negated()).collect())
    }

    /// f·g.
    pub(super) fn times(&self, other: &Taylor, order: usize) -> Taylor {
        if self.is_empty() || other.is_empty() {
            return Taylor(Vec::new());
        }
        let length = (self.len() + other.len() - 1).min(order + 1);
        Taylor(
            (0..length)
                .map(|k| {
                    let first = k.saturating_sub(other.len() - 1);
                    let terms = first..=k.min(self.len() - 1);
                    sum(terms.map(|j| self.0[j].times_to_nearest(other.0[k - j])))
                })
                .collect(),
        )
    }
}

impl Taylor {
    /// f², which is nowhere below 0, though the product of two numbers of f's range may be.
    pub(super) fn squared(&self, order: usize) -> Taylor {
        let mut square = self.times(self, order);
        if let Some(first) = square.0.first_mut() {
            *first = first.intersection(Range::new(0.0, f64::INFINITY));
        }
        square
    }
}

/// The sum of products that are rounded to nearest, and of their roundings.
pub(super) fn sum(terms: impl Iterator<Item = Range>) -> Range {
    let (mut low, mut high, mut magnitude, mut count) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
    for term in terms {
        low += term.low;
        high += term.high;
        magnitude += term.magnitude();
        count += 1.0;
    }
    if count == 0.0 {
        return Range::ZERO;
    }
    // Each product and each sum rounds once, every partial sum being at most the magnitude; products below
    // the normal range round by a subnormal number.
    let error = (count + 2.0) * (f64::EPSILON * magnitude + f64::MIN_POSITIVE);
    Range::new(low, high).widened(error)
}
