//! Resampling of replicas, and quantiles of what comes out.

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;

/// Draws replicas with replacement; the draws of a seed are the same on every platform.
pub(super) struct Resampler {
    random: Pcg64,
}

impl Resampler {
    pub(super) fn new(seed: u64) -> Self {
        Resampler {
            random: Pcg64::seed_from_u64(seed),
        }
    }

    /// Fills `indices` with numbers below `indices.len()`, each drawn with replacement.
    pub(super) fn draw(&mut self, indices: &mut [usize]) {
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
pub(super) fn quantile(sorted: &[f64], level: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let position = level * last as f64;
    let below = position.floor();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let index = (below as usize).min(last);
    let (a, b) = (sorted[index], sorted[(index + 1).min(last)]);
    Some(a + (b - a) * (position - below))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_interpolate_and_stay_inside() {
        let sorted = [1.0, 2.0, 4.0];
        assert_eq!(quantile(&sorted, 0.0), Some(1.0));
        assert_eq!(quantile(&sorted, 0.25), Some(1.5));
        assert_eq!(quantile(&sorted, 0.5), Some(2.0));
        assert_eq!(quantile(&sorted, 1.0), Some(4.0));
        assert_eq!(quantile(&[], 0.5), None);
    }

    #[test]
    fn draws_are_uniform_and_the_same_for_the_same_seed() {
        let mut counts = [0_u32; 8];
        let (mut first, mut second) = (Resampler::new(7), Resampler::new(7));
        let (mut a, mut b) = ([0; 8], [0; 8]);
        for _ in 0..4000 {
            first.draw(&mut a);
            second.draw(&mut b);
            assert_eq!(a, b);
            for index in a {
                counts[index] += 1;
            }
        }
        // 4000 expected each, standard deviation 59.
        assert!(counts.iter().all(|c| c.abs_diff(4000) < 300), "{counts:?}");
        let mut other = [0; 8];
        Resampler::new(8).draw(&mut other);
        Resampler::new(7).draw(&mut a);
        assert_ne!(a, other);
    }
}
