//! The fast cosine transform.

use super::Circle;
use super::fourier::fourier;
use rug::{Assign, Float};

/// Sⱼ = v₀/2 + Σ vₖ cos(πjk/n) + (−1)ʲ vₙ/2, k = 1 … n − 1, of n + 1 values, n = 2ᵐ ≥ 2, in O(n log n).
///
/// With fₖ = (vₖ + vₙ₋ₖ)/2 − sin(πk/n) (vₖ − vₙ₋ₖ) and its transform A over n numbers, S₂ⱼ = Re Aⱼ and
/// S₂ⱼ₊₁ = S₂ⱼ₋₁ + Im Aⱼ: rounding errors add up to some n units of the largest value.
///
/// Source: Cooley, Lewis and Welch (1970), as in Numerical Recipes, section 12.3.
#[must_use]
pub fn cosine_transform(values: &[Float], circle: &Circle) -> Vec<Float> {
    let n = values.len().saturating_sub(1);
    let bits = circle.bits();
    let half = |x: Float| x >> 1_u32;
    let (mut real, mut imaginary) = (Vec::with_capacity(n / 2), Vec::with_capacity(n / 2));
    // S₁ is summed as it is defined.
    let mut odd = half(Float::with_val(bits, &values[0] - &values[n]));
    let mut product = Float::new(bits);
    for k in 0..n {
        let (v, mirrored) = (&values[k], &values[n - k]);
        let mut f = half(Float::with_val(bits, v + mirrored));
        if k > 0 {
            let difference = Float::with_val(bits, v - mirrored);
            product.assign(circle.sine(k, n) * &difference);
            f -= &product;
            if 2 * k < n {
                product.assign(circle.cosine(k, n) * &difference);
                odd += &product;
            }
        }
        if k % 2 == 0 {
            real.push(f);
        } else {
            imaginary.push(f);
        }
    }
    fourier(&mut real, &mut imaginary, circle);
    let mut result = Vec::with_capacity(n + 1);
    for k in 0..=n / 2 {
        let (re, im) = of_real_numbers(&real, &imaginary, k, circle);
        if k > 0 {
            odd += &im;
        }
        result.push(re);
        if 2 * k < n {
            result.push(odd.clone());
        }
    }
    result
}

/// Aₖ of n = 2m real numbers from the transform of f₂ⱼ + i f₂ⱼ₊₁: with E and O the parts of even and of
/// odd numbers, Aₖ = Eₖ + e^(2πik/n) Oₖ.
fn of_real_numbers(
    real: &[Float],
    imaginary: &[Float],
    k: usize,
    circle: &Circle,
) -> (Float, Float) {
    let m = real.len();
    let (a, b) = (k % m, (m - k) % m);
    let bits = circle.bits();
    let even = (
        Float::with_val(bits, &real[a] + &real[b]) >> 1_u32,
        Float::with_val(bits, &imaginary[a] - &imaginary[b]) >> 1_u32,
    );
    let odd = (
        Float::with_val(bits, &imaginary[a] + &imaginary[b]) >> 1_u32,
        Float::with_val(bits, &real[b] - &real[a]) >> 1_u32,
    );
    let (cos, sin) = (circle.cosine(k, m), circle.sine(k, m));
    let re = even.0 + Float::with_val(bits, &odd.0 * cos) - Float::with_val(bits, &odd.1 * sin);
    let im = even.1 + Float::with_val(bits, &odd.0 * sin) + Float::with_val(bits, &odd.1 * cos);
    (re, im)
}
