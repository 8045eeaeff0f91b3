//! x modulo π/2 for large x, exactly enough for the nearest that any number of binary64 comes to a multiple of π/2
//! (Payne and Hanek 1983).

// Words are cut from longer ones.
#![allow(clippy::cast_possible_truncation)]

use std::ops::Neg;

/// An angle: `quarters` π/2 + `high` + `low`, where |`high`| ≤ π/4 and `low` is what `high` has been rounded by.
pub(super) struct Angle {
    /// Modulo 4.
    pub(super) quarters: u32,
    pub(super) high: f64,
    pub(super) low: f64,
}

/// 2/π in words of 64 bits behind one of zeros, which stands before the binary point.
const TWO_OVER_PI: [u64; 21] = [
    0,
    0xa2f9_836e_4e44_1529,
    0xfc27_57d1_f534_ddc0,
    0xdb62_9599_3c43_9041,
    0xfe51_63ab_debb_c561,
    0xb724_6e3a_424d_d2e0,
    0x0649_2eea_09d1_921c,
    0xfe1d_eb1c_b129_a73e,
    0xe882_35f5_2ebb_4484,
    0xe99c_7026_b45f_7e41,
    0x3991_d639_8353_39f4,
    0x9c84_5f8b_bdf9_283b,
    0x1ff8_97ff_de05_980f,
    0xef2f_118b_5a0a_6d1f,
    0x6d36_7ecf_27cb_09b7,
    0x4f46_3f66_9e5f_ea2d,
    0x7527_bac7_ebe5_f17b,
    0x3d07_39f7_8a52_92ea,
    0x6bfb_5fb1_1f8d_5d08,
    0x5603_3046_fc7b_6bab,
    0xf0cf_bc20_9af4_361d,
];
/// π/2 · 2¹²⁷.
const HALF_PI: u128 = 0xc90f_daa2_2168_c234_c4c6_628b_80dc_1cd1;
const FRACTION_BITS: u32 = f64::MANTISSA_DIGITS - 1;

/// The word of 64 bits of 2/π that begins with the one of weight 2^−`first`, `first` > −64.
fn word(first: i32) -> u64 {
    let from = (first + 63).cast_unsigned();
    let (index, shift) = ((from / 64) as usize, from % 64);
    let at = |index: usize| TWO_OVER_PI.get(index).copied().unwrap_or(0);
    match shift {
        0 => at(index),
        _ => (at(index) << shift) | (at(index + 1) >> (64 - shift)),
    }
}

/// The angle of a finite x of at least 2¹² in size; NaN for what is not finite.
pub(super) fn reduced(x: f64) -> Angle {
    if !x.is_finite() {
        return Angle {
            quarters: 0,
            high: f64::NAN,
            low: f64::NAN,
        };
    }
    let bits = x.abs().to_bits();
    let significand = (bits & ((1 << FRACTION_BITS) - 1)) | (1 << FRACTION_BITS);
    // |x| = significand · 2^exponent.
    let exponent = ((bits >> FRACTION_BITS) as u32).cast_signed() - 1075;
    // Bits of 2/π in front of these give multiples of 4: what is left of |x| 2/π is product · 2⁻¹⁹⁰.
    let words = [0, 64, 128].map(|behind| word(exponent - 1 + behind));
    let mut product = [0; 3];
    let mut carry = 0;
    for (digit, word) in product.iter_mut().zip(words).rev() {
        let sum = u128::from(word) * u128::from(significand) + carry;
        *digit = sum as u64;
        carry = sum >> 64;
    }
    let whole = (product[0] >> 62) as u32;
    // The fraction, 128 bits and `last`.
    let shifted = [0, 1].map(|i| (product[i] << 2) | (product[i + 1] >> 62));
    let mut last = product[2] << 2;
    let is_more = shifted[0] >> 63 == 1;
    let mut fraction = (u128::from(shifted[0]) << 64) | u128::from(shifted[1]);
    if is_more {
        last = last.wrapping_neg();
        fraction = (!fraction).wrapping_add(u128::from(last == 0));
    }
    let quarters = whole + u32::from(is_more);
    let zeros = fraction.leading_zeros();
    // A multiple of π/2 no number of binary64 is.
    let normal = match zeros {
        0 => fraction,
        _ => (fraction << zeros) | (u128::from(last) << 64 >> (128 - zeros)),
    };
    let angle = high_product(normal, HALF_PI);
    // Of weight 2^(1 − zeros) · 2⁻¹²⁸.
    let scale = 2f64.powi(1 - 128 - zeros.cast_signed());
    let kept = angle.leading_zeros() + f64::MANTISSA_DIGITS;
    let top = angle >> (128 - kept) << (128 - kept);
    let (high, low) = (top as f64 * scale, (angle - top) as f64 * scale);
    // Of the part beyond ½ and of a negative x the angle has the other sign; of both it has none.
    let (high, low) = if is_more == (x < 0.0) {
        (high, low)
    } else {
        (-high, -low)
    };
    let quarters = if x < 0.0 {
        quarters.wrapping_neg()
    } else {
        quarters
    };
    Angle {
        quarters: quarters & 3,
        high,
        low,
    }
}

/// The first 128 bits of a product of 256.
fn high_product(a: u128, b: u128) -> u128 {
    let low = |x: u128| x & u128::from(u64::MAX);
    let (a1, a0, b1, b0) = (a >> 64, low(a), b >> 64, low(b));
    let middle = ((a0 * b0) >> 64) + low(a1 * b0) + low(a0 * b1);
    a1 * b1 + ((a1 * b0) >> 64) + ((a0 * b1) >> 64) + (middle >> 64)
}

/// (sin, cos) of an angle, of those of what is left of it.
pub(super) fn turned<T: Neg<Output = T>>(quarters: u32, sin: T, cos: T) -> (T, T) {
    match quarters {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// The number of binary32 nearest to x.
pub(super) fn narrow(x: f64) -> f32 {
    x as f32
}
