//! Whether a series has all its digits.

use super::super::chebyshev::Series;

/// Series of fewer coefficients are believed by nobody: an analytic function may hide between their points.
const FEWEST: usize = 32;
/// From this degree on it is judged whether a series will ever get there.
const JUDGED_FROM: usize = 64;

/// What a series of degree n says of its function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Verdict {
    /// Nothing is missing beyond log₂ `tail`.
    Resolved {
        /// log₂ of the largest of the last coefficients.
        tail: f64,
    },
    /// Twice as many points may do.
    Open,
    /// Even `limit` coefficients will not do.
    Hopeless,
}

/// Judges a series by how its coefficients decay, those after 3n/4 against `allowance`, as log₂.
///
/// Coefficients of analytic functions decay geometrically, so that what is beyond n is far below the last
/// quarter. Aliased ones do not: the series of n/2, one doubling before, must have had half of the digits.
pub(super) fn verdict(series: &Series, allowance: f64, limit: usize) -> Verdict {
    let n = series.degree();
    let largest = series.log2_largest(0..=n);
    let tail = series.log2_largest(3 * n / 4 + 1..=n);
    if n >= FEWEST && tail <= allowance {
        let doubled = series.log2_largest(n / 2 + 1..=n);
        if doubled <= allowance || doubled <= f64::midpoint(largest, allowance) {
            return Verdict::Resolved { tail };
        }
    }
    if 2 * n > limit {
        return Verdict::Hopeless;
    }
    if n >= JUDGED_FROM && tail > allowance {
        // From the second quarter to the last.
        let early = series.log2_largest(n / 4 + 1..=n / 2);
        let rate = (early - tail) / (n as f64 / 2.0);
        let missing = (tail - allowance) / rate;
        if rate <= 0.0 || n as f64 + missing > limit as f64 {
            return Verdict::Hopeless;
        }
    }
    Verdict::Open
}
