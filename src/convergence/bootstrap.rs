//! Resampling of replicas, and quantiles of what comes out.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Draws replicas with replacement; the draws of a seed are the same on every platform.
pub struct Resampler {
    random: Pcg64,
}

impl Resampler {
    /// The draws of that seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Resampler {
            random: Pcg64::seed_from_u64(seed),
        }
    }

    /// Fills `indices` with numbers below `indices.len()`, each drawn with replacement.
    pub fn draw(&mut self, indices: &mut [usize]) {
        let count = indices.len() as u64;
        for index in indices {
            // The upper half of a 64 × 64-bit product: off from uniform by less than 2⁻⁵⁰ for any
            // count that fits a memory.
            let product = u128::from(self.random.next_u64()) * u128::from(count);
            *index = usize::try_from(product >> 64).unwrap_or(0);
        }
    }
}

/// The quantile of sorted numbers at `level` ∈ [0, 1], interpolated; `None` where there are none.
#[must_use]
pub fn quantile(sorted: &[f64], level: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let position = level * last as f64;
    let below = position.floor();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let index = (below as usize).min(last);
    let (a, b) = (sorted[index], sorted[(index + 1).min(last)]);
    Some(a + (b - a) * (position - below))
}
