//! Chebyshev series on an interval, from its left end at ξ = 1 to its right end at ξ = −1.

use super::Circle;
use super::transform::{cosine_transform, transform_between, transform_in_place};
use rug::Float;
use std::ops::RangeInclusive;

/// Σ aⱼ Tⱼ(ξ), a₀ first.
#[derive(Clone, Debug)]
pub struct Series(Vec<Float>);

impl Series {
    /// The series of degree n through n + 1 values from left to right; the circle serves n.
    #[must_use]
    pub fn through(values: &[Float], circle: &Circle) -> Series {
        let n = values.len().saturating_sub(1);
        let exponent = n.trailing_zeros();
        let mut coefficients = cosine_transform(values, circle);
        for (j, coefficient) in coefficients.iter_mut().enumerate() {
            *coefficient >>= if j == 0 || j == n {
                exponent
            } else {
                exponent - 1
            };
        }
        Series(coefficients)
    }

    /// The values at the n + 1 points of a degree n no less than its own; the circle serves n.
    #[must_use]
    pub fn values(&self, n: usize, circle: &Circle) -> Vec<Float> {
        let mut padded = self.0.clone();
        padded.resize(n + 1, Float::new(circle.bits()));
        for end in [0, n] {
            padded[end] <<= 1_u32;
        }
        transform_in_place(&mut padded, circle);
        padded
    }

    /// The values at every other one of the points of degree n, those that degree n/2 does not have, n/2 no less than its
    /// own; the circle serves n.
    #[must_use]
    pub fn values_between(&self, n: usize, circle: &Circle) -> Vec<Float> {
        // What is of degree n/2 is 0 there.
        let mut padded: Vec<Float> = self.0.iter().take(n / 2).cloned().collect();
        padded.resize(n / 2, Float::new(circle.bits()));
        padded[0] <<= 1_u32;
        transform_between(&mut padded, circle);
        padded
    }

    /// ∫ f from the left end of an interval of that width, 0 there.
    ///
    /// ∫ Tⱼ dξ = Tⱼ₊₁/(2(j + 1)) − Tⱼ₋₁/(2(j − 1)), and the width is 2 in ξ, from right to left. What would be
    /// of degree n + 1 is left out: it is less than the last coefficient.
    #[must_use]
    pub fn integral(&self, width: &Float) -> Series {
        let n = self.0.len().saturating_sub(1);
        let bits = width.prec();
        let zero = Float::new(bits);
        let mut result = vec![Float::new(bits)];
        let mut at_left = Float::new(bits);
        for k in 1..=n {
            let before = Float::with_val(bits, &self.0[k - 1]);
            let before = if k == 1 { before << 1_u32 } else { before };
            let after = self.0.get(k + 1).unwrap_or(&zero);
            // −(width/2) (aₖ₋₁ − aₖ₊₁)/2k
            let coefficient = (Float::with_val(bits, after - &before) * width) / (4 * k as u64);
            at_left += &coefficient;
            result.push(coefficient);
        }
        result[0] = -at_left;
        Series(result)
    }

    /// The value at the right end, ξ = −1.
    pub fn at_right(&self) -> Float {
        let mut sum = Float::new(self.0.first().map_or(2, Float::prec));
        for (j, coefficient) in self.0.iter().enumerate() {
            if j % 2 == 0 {
                sum += coefficient;
            } else {
                sum -= coefficient;
            }
        }
        sum
    }

    /// log₂ of the largest |aⱼ| of those coefficients; −∞ where all are 0.
    pub fn log2_largest(&self, range: RangeInclusive<usize>) -> f64 {
        let part = self.0.get(range).unwrap_or_default();
        part.iter().map(log2_abs).fold(f64::NEG_INFINITY, f64::max)
    }

    /// The degree that it is held with.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.0.len().saturating_sub(1)
    }
}

/// log₂|x|, −∞ for 0.
pub(in crate::reference) fn log2_abs(x: &Float) -> f64 {
    let (mantissa, exponent) = x.to_f64_exp();
    mantissa.abs().log2() + f64::from(exponent)
}
