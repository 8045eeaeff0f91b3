//! The paper's protocol: what a study without windows or floors reports.

use crate::convergence::Sample;
use crate::convergence::line::least_squares;
use crate::real::{MpfrReal, Real};

/// The levels n of the paper's protocol.
pub(super) const LADDER: [u64; 8] = [8, 16, 32, 64, 128, 256, 512, 1024];

/// The slope of least squares of log|error| on log d over all levels, roundoff and all; `None` where an
/// error is zero or not finite.
pub(super) fn order(samples: &[Sample]) -> Option<f64> {
    let points = samples
        .iter()
        .map(|sample| {
            let error = MpfrReal::from(sample.error.clone()).log2_abs();
            Some((sample.step.log2(), error)).filter(|_| error.is_finite())
        })
        .collect::<Option<Vec<_>>>()?;
    slope(&points)
}

/// The slope of the least-squares line through (x, y).
pub(super) fn slope(points: &[(f64, f64)]) -> Option<f64> {
    let alike: Vec<_> = points.iter().map(|&(x, y)| (x, y, 1.0)).collect();
    least_squares(&alike).map(|line| line.slope)
}
