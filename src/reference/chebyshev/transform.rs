//! The fast cosine transform, in real numbers and in place.

use super::Circle;
use rug::{Assign, Float};

/// Sⱼ = v₀/2 + Σ vₖ cos(πjk/n) + (−1)ʲ vₙ/2, k = 1 … n − 1, of n + 1 values, n = 2ᵐ, in O(n log n); the circle serves n.
///
/// Sums of even j are such sums of vₖ + vₙ₋ₖ, half as many, and those of odd j are Σ xₖ cos(π(2i + 1)k/n) of
/// xₖ = vₖ − vₙ₋ₖ, which are halved in the same way: a product for every two numbers and halving. The factors
/// 1/(2 cos θ) are up to n/π: rounding errors add up to some n units of the largest value.
///
/// Source: Lee (1984), "A new algorithm to compute the discrete cosine transform", IEEE Transactions on Acoustics,
/// Speech and Signal Processing 32.
#[must_use]
pub fn cosine_transform(values: &[Float], circle: &Circle) -> Vec<Float> {
    let mut sums = values.to_vec();
    transform_in_place(&mut sums, circle);
    sums
}

/// The same in place of the values.
pub(super) fn transform_in_place(values: &mut [Float], circle: &Circle) {
    let bits = circle.bits();
    // Room for as many numbers, of which none is made again.
    let mut room: Vec<Float> = values.iter().map(|_| Float::new(2)).collect();
    let mut difference = Float::new(bits);
    with_ends(values, &mut room, &mut difference, circle);
}

/// x₀/2 + Σ xₖ cos(πk(2i + 1)/2m) in place of m values, m = 2ᵃ; the circle serves 2m.
pub(super) fn transform_between(values: &mut [Float], circle: &Circle) {
    let mut room: Vec<Float> = values.iter().map(|_| Float::new(2)).collect();
    let mut difference = Float::new(circle.bits());
    of_odd_multiples(values, &mut room, &mut difference, circle);
}

/// (a, b) becomes (a + b, a − b).
fn butterfly(a: &mut Float, b: &mut Float, difference: &mut Float) {
    difference.assign(&*a - &*b);
    *a += &*b;
    std::mem::swap(b, difference);
}

/// The sums of n + 1 values.
fn with_ends(values: &mut [Float], room: &mut [Float], difference: &mut Float, circle: &Circle) {
    let n = values.len().saturating_sub(1);
    let half = n / 2;
    let (front, back) = values.split_at_mut(n.div_ceil(2));
    for (a, b) in front.iter_mut().zip(back.iter_mut().rev()) {
        butterfly(a, b, difference);
    }
    if n < 2 {
        for value in values {
            *value >>= 1_u32;
        }
        return;
    }
    values[half] <<= 1_u32;
    let (even, odd) = values.split_at_mut(half + 1);
    odd.reverse();
    with_ends(even, room, difference, circle);
    of_odd_multiples(odd, room, difference, circle);
    for (j, sum) in room.iter_mut().enumerate().take(n + 1) {
        let parts = if j % 2 == 0 { &mut *even } else { &mut *odd };
        std::mem::swap(sum, &mut parts[j / 2]);
    }
    values.swap_with_slice(&mut room[..=n]);
}

/// Xᵢ = x₀/2 + Σ xₖ cos θᵢk, k = 1 … m − 1, θᵢ = π(2i + 1)/2m, of m values.
///
/// Those of even k are such sums of half as many, the same at θ and π − θ; those of odd k change their sign, and times
/// 2 cos θ they are such sums of xₖ + xₖ₋₂.
fn of_odd_multiples(
    values: &mut [Float],
    room: &mut [Float],
    difference: &mut Float,
    circle: &Circle,
) {
    let m = values.len();
    if m < 2 {
        for value in values {
            *value >>= 1_u32;
        }
        return;
    }
    let half = m / 2;
    for (k, value) in values.iter_mut().enumerate() {
        let place = if k % 2 == 0 { k / 2 } else { half + k / 2 };
        std::mem::swap(value, &mut room[place]);
    }
    values.swap_with_slice(&mut room[..m]);
    let (even, odd) = values.split_at_mut(half);
    for k in (1..half).rev() {
        let (below, above) = odd.split_at_mut(k);
        above[0] += &below[k - 1];
    }
    odd[0] <<= 1_u32;
    of_odd_multiples(even, room, difference, circle);
    of_odd_multiples(odd, room, difference, circle);
    for (i, (a, b)) in even.iter_mut().zip(odd.iter_mut()).enumerate() {
        *b *= circle.half_secant(2 * i + 1, 2 * m);
        butterfly(a, b, difference);
    }
    odd.reverse();
}
