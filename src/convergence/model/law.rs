//! A rounding error as a power of the number of segments.

use crate::convergence::line::least_squares;
use crate::convergence::sample::log2_abs;
use rug::Float;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Fewest levels a law is fitted to.
const MIN_LEVELS: usize = 4;

/// |e| ≈ c·u·n^q as a root mean square, u = 2^−bits.
///
/// A random walk of n roundings has q = ½, a bias q = 1, the rounding of inputs −½ (as independent errors of
/// n samples do in their mean) to 0 (a bias of all samples).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RoundoffLaw {
    /// q.
    pub exponent: f64,
    /// Half-width of the 95 % interval of q, from the scatter around the law.
    pub half_width: f64,
    /// log₂ c.
    pub log2_constant: f64,
    /// Levels it was fitted to.
    pub levels: usize,
}

impl RoundoffLaw {
    /// Fits the law to signed errors at numbers of segments, in a format of `bits` bits; errors up to
    /// `resolution` of their level are no data. `None` with fewer than four errors.
    ///
    /// The exponent is that of a regression of logarithms; the constant is the root mean square of what is
    /// left, since the logarithm of a random error lies below that of its root mean square.
    #[must_use]
    pub fn fit(errors: &[(u64, Float, Float)], bits: u32) -> Option<RoundoffLaw> {
        let points: Vec<(f64, f64, f64)> = errors
            .iter()
            .filter(|(n, error, resolution)| {
                *n > 0
                    && error.is_finite()
                    && error
                        .cmp_abs(resolution)
                        .is_some_and(std::cmp::Ordering::is_gt)
            })
            .map(|(n, error, _)| ((*n as f64).log2(), log2_abs(error), 1.0))
            .collect();
        if points.len() < MIN_LEVELS {
            return None;
        }
        let line = least_squares(&points)?;
        let quantile = StudentsT::new(0.0, 1.0, (points.len() - 2) as f64)
            .ok()?
            .inverse_cdf(0.975);
        // log₂ of the root mean square of 2^r, the largest taken out so that nothing overflows.
        let left: Vec<f64> = points.iter().map(|p| p.1 - line.slope * p.0).collect();
        let largest = left.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let squares = left.iter().map(|r| (2.0 * (r - largest)).exp2());
        let mean = squares.sum::<f64>() / left.len() as f64;
        Some(RoundoffLaw {
            exponent: line.slope,
            half_width: quantile * line.slope_error,
            log2_constant: largest + 0.5 * mean.log2() + f64::from(bits),
            levels: points.len(),
        })
    }

    /// log₂ of the root mean square at n = 2^`log2_n` with `bits` bits.
    #[must_use]
    pub fn log2_at(&self, log2_n: f64, bits: f64) -> f64 {
        self.log2_constant - bits + self.exponent * log2_n
    }
}
