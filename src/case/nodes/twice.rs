//! Places of a ray in twice the digits of binary64: what stands for an irrational number is no fraction of machine
//! integers, and a rational number a place takes longer than all else.

use crate::real::Format;
use rug::Rational;

/// The places D·(j + offset)/n as sums of two numbers of binary64.
#[derive(Clone, Copy, Debug)]
pub(super) struct Twice {
    offset: [f64; 2],
    /// The numerator of D.
    scale: f64,
    /// n times its denominator.
    divisor: f64,
    /// D/n, where that is a power of two: places are then exact multiples of it.
    step: Option<f64>,
}

impl Twice {
    /// `None` where numbers are not exact in binary64 that have to be.
    pub(super) fn new(length: &Rational, n: u64, offset: &Rational) -> Option<Self> {
        let exact = |x: u64| (x < 1 << f64::MANTISSA_DIGITS).then_some(x as f64);
        let numerator = length.numer().to_u64()?;
        let denominator = length.denom().to_u64()?.checked_mul(n)?;
        let (scale, divisor) = (exact(numerator)?, exact(denominator)?);
        exact(n)?;
        let high = offset.to_f64();
        let low = (offset - Rational::from_f64(high)?).to_f64();
        let are_powers = numerator.is_power_of_two() && denominator.is_power_of_two();
        Some(Twice {
            offset: [high, low],
            scale,
            divisor,
            step: are_powers.then(|| scale / divisor),
        })
    }

    /// Place j ≤ n, rounded once to nearest; `None` where that is not decided.
    #[inline]
    pub(super) fn place<F: Format>(&self, format: F, j: u64) -> Option<F::Real> {
        let [high, low] = self.offset;
        let (sum, rest) = two_sum(j as f64, high);
        let (sum, rest) = two_sum(sum, rest + low);
        if let Some(step) = self.step {
            return format.nearest(sum * step, rest * step);
        }
        let (product, error) = two_product(sum, self.scale);
        let (product, error) = two_sum(product, error + rest * self.scale);
        let quotient = product / self.divisor;
        let (whole, part) = two_product(quotient, self.divisor);
        let remainder = ((product - whole) - part) + error;
        let (near, rest) = two_sum(quotient, remainder / self.divisor);
        format.nearest(near, rest)
    }
}

/// a + b, and what rounding takes of it (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// a·b, and what rounding takes of it (Dekker).
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let halves = |x: f64| {
        // 2²⁷ + 1.
        let shifted = x * 134_217_729.0;
        let high = shifted - (shifted - x);
        (high, x - high)
    };
    let product = a * b;
    let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
    let error = ((a1 * b1 - product) + a1 * b2 + a2 * b1) + a2 * b2;
    (product, error)
}
