//! Functions that no library has for every format, made of those that all have.

use super::{Format, Real};

/// (1 − e^(−x))/x, the mean transmittance over a segment of optical depth x; 1 at x = 0.
///
/// Computed as −expm1(−x)/x, which neither cancels nor underflows: where x is small, expm1(−x) is −x up to
/// a relative error of x/2 and the quotient is as good as its two roundings. The error is that of the format's
/// `exp_m1` and half a unit in the last place more, for x ≥ 0 of any size, subnormal numbers and ∞ included, and
/// for x < 0 until e^(−x) overflows.
///
/// ```
/// use volver::real::special::relative_opacity;
///
/// assert_eq!(relative_opacity(&0.0), 1.0);
/// // 1 − e^(−x) is 0 in binary64, and its quotient with x would be.
/// assert_eq!(relative_opacity(&1e-20), 1.0);
/// ```
#[must_use]
pub fn relative_opacity<R: Real>(x: &R) -> R {
    let format = x.format();
    if *x == format.int(0) {
        return format.int(1);
    }
    -(-x.clone()).exp_m1() / x
}
