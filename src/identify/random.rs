//! Numbers that look random, the same in every run.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// A stream of numbers.
#[derive(Clone, Debug)]
pub(crate) struct Random(Pcg64);

impl Random {
    pub(crate) fn new(seed: u64) -> Self {
        Random(Pcg64::seed_from_u64(seed))
    }

    /// From 0 to 1, without either.
    pub(super) fn part(&mut self) -> f64 {
        ((self.0.next_u64() >> 12) as f64 + 0.5) / 52_f64.exp2()
    }

    /// From `low` to `high`.
    pub(super) fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.part()
    }

    /// The same by their logarithms.
    pub(super) fn geometric(&mut self, low: f64, high: f64) -> f64 {
        (low.ln() + (high / low).ln() * self.part()).exp()
    }

    /// An integer from `low` to `high`, both included.
    pub(super) fn integer(&mut self, low: usize, high: usize) -> usize {
        // Below the difference of two counts.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let further = (self.part() * (high - low + 1) as f64) as usize;
        low + further.min(high - low)
    }

    pub(crate) fn many(&mut self, count: usize, low: f64, high: f64) -> Vec<f64> {
        (0..count).map(|_| self.within(low, high)).collect()
    }

    /// Gamma-distributed with shape 1/2 and mean 1: many small numbers and a few large ones.
    pub(super) fn uneven(&mut self) -> f64 {
        // Half of a squared normal number has shape 1/2 and mean 1/2.
        let radius = (-2.0 * self.part().ln()).sqrt();
        let normal = radius * (std::f64::consts::TAU * self.part()).cos();
        normal * normal
    }
}
