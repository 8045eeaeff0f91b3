//! A law that is known, to make rays of it.

use crate::identify::opacity::Measurements;
use crate::identify::opacity::measure::Measurer;
use crate::identify::rule::Law;

/// What later stages ask with.
#[derive(Clone, Debug)]
pub(in crate::identify) struct Lone<'a> {
    pub(in crate::identify) measurer: &'a Measurer<'a>,
    pub(in crate::identify) law: &'a Law,
    pub(in crate::identify) measured: &'a Measurements,
}

impl Lone<'_> {
    /// (w, p).
    pub(super) fn of(&self, extinction: f64, length: f64, ray: f64) -> (f64, f64) {
        self.law.of(&extinction, &length, &ray)
    }

    /// The extinction of references of that length.
    pub(super) fn reference(&self, length: f64) -> f64 {
        let found = self.measured.reference(length);
        found.map_or(1.0 / 32.0 / length, |r| r.extinction)
    }

    /// The least extinction whose weight is that or more; `None` where none is.
    pub(in crate::identify) fn with_weight(
        &self,
        weight: f64,
        length: f64,
        ray: f64,
    ) -> Option<f64> {
        let (mut low, mut high) = (0.0, 4096.0 * self.reference(length));
        if self.of(high, length, ray).0 < weight {
            return None;
        }
        for _ in 0..90 {
            let middle = f64::midpoint(low, high);
            if self.of(middle, length, ray).0 < weight {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(high)
    }

    /// The least extinction that lets no more than `passes` through.
    pub(super) fn invert(&self, passes: f64, length: f64, ray: f64) -> f64 {
        let (mut low, mut high) = (0.0, 4096.0 * self.reference(length));
        for _ in 0..90 {
            let middle = f64::midpoint(low, high);
            if self.of(middle, length, ray).1 > passes {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }
}
