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

/// 1 − e and e − e^(−x) with e = (1 − e^(−x))/x: what the near and the far end of a segment of optical depth x weigh
/// where the source is linear in optical depth; without cancellation where x is small.
#[must_use]
pub fn linear_in_depth<R: Real>(x: &R) -> [R; 2] {
    let format = x.format();
    // Below, the series is as good: its terms fall by x/k.
    if x.clone().abs() < format.fraction(1, 16) {
        // 1 − e = Σ_{k≥1} −(−x)^k/(k + 1)!, e − e^(−x) = Σ_{k≥1} −(−x)^k k/(k + 1)!.
        let (mut near, mut far) = (format.int(0), format.int(0));
        let mut term = format.int(-1);
        for k in 1..=i64::from(format.bits()) {
            term = -(term * x) / &format.int(k + 1);
            let next = near.clone() + &term;
            far += &(term.clone() * &format.int(k));
            if next == near {
                break;
            }
            near = next;
        }
        return [near, far];
    }
    let passes = (-x.clone()).exp();
    let mean = -(-x.clone()).exp_m1() / x;
    [format.int(1) - &mean, mean - &passes]
}

/// (b − a)/ln(b/a), between the geometric and the arithmetic mean; a where both are the same, 0 where one of them is,
/// no number where their signs differ.
#[must_use]
pub fn logarithmic_mean<R: Real>(a: &R, b: &R) -> R {
    let zero = a.format().int(0);
    if *a == zero || *b == zero {
        return zero;
    }
    // ln(b/a) = ln(1 + u), which keeps its digits where a and b are close.
    let u = (b.clone() - a) / a;
    if u == zero {
        return a.clone();
    }
    let logarithm = u.clone().ln_1p();
    u * a / &logarithm
}
