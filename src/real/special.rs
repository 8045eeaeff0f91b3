//! Functions that no library has for every format, made of those that all have.

use super::{Format, Real, row};

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

/// x ∫₀¹ Bᵢ(u) e^(−xu) du, i = 0 … n, of the Bernstein polynomials Bᵢ of degree n: what the points of a Bézier curve in
/// optical depth weigh in the light of a segment of optical depth x.
///
/// Below x = 4 by Kummer's series, x e^(−x)/(n + 1) Σₖ (n + 1 − i)ₖ/(n + 2)ₖ xᵏ/k!, whose terms have one sign where
/// x > 0 does, so that nothing cancels; above by parts, from degree to degree, where a difference is multiplied by n/x and
/// the loss is a few roundings for n < 4.
///
/// Source: Abramowitz and Stegun (1964), 13.1.2, 13.1.27 and 13.2.1.
#[must_use]
pub fn bernstein_in_depth<R: Real>(degree: usize, x: &R) -> Vec<R> {
    let format = x.format();
    let passes = (-x.clone()).exp();
    let n = i64::try_from(degree).unwrap_or(i64::MAX - 2);
    if x.clone().abs() < format.int(4) {
        let scale = passes * x / &format.int(n + 1);
        return row((0..=n).map(|i| kummer(n + 1 - i, n + 2, x) * &scale));
    }
    let mut weights = vec![-(-x.clone()).exp_m1()];
    for k in 1..=n {
        let ratio = format.int(k) / x;
        // Bᵢ′ = k (Bᵢ₋₁ − Bᵢ) with those of the degree before; at the ends Bᵢ is 1 of the first and of the last.
        let last = weights.len();
        weights = row((0..=last).map(|i| match i {
            0 => format.int(1) - &(weights[0].clone() * &ratio),
            i if i == last => weights[i - 1].clone() * &ratio - &passes,
            i => (weights[i - 1].clone() - &weights[i]) * &ratio,
        }));
    }
    weights
}

/// Σₖ (a)ₖ/(b)ₖ xᵏ/k! for 0 < a < b, where x is moderate.
fn kummer<R: Real>(a: i64, b: i64, x: &R) -> R {
    let format = x.format();
    let (mut sum, mut term) = (format.int(1), format.int(1));
    // Far more than terms below e·4/k take to be of no account.
    for k in 0..2 * i64::from(format.bits()) + 32 {
        term = term * x * &format.int(a + k) / &format.int(b + k) / &format.int(k + 1);
        let next = sum.clone() + &term;
        if next == sum {
            break;
        }
        sum = next;
    }
    sum
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
