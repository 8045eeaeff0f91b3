//! The discrete Fourier transform of 2ᵐ complex numbers.

use super::Circle;
use rug::{Assign, Float};

/// Xₖ = Σ xⱼ e^(2πi jk/m) in place, m = 2ᵃ numbers as real and imaginary parts; the circle serves m/2.
pub(super) fn fourier(real: &mut [Float], imaginary: &mut [Float], circle: &Circle) {
    let count = real.len();
    if count < 2 {
        return;
    }
    let digits = count.trailing_zeros();
    for k in 0..count {
        let mirrored = k.reverse_bits() >> (usize::BITS - digits);
        if k < mirrored {
            real.swap(k, mirrored);
            imaginary.swap(k, mirrored);
        }
    }
    let mut scratch = Scratch::new(circle.bits());
    let mut half = 1;
    while half < count {
        for start in (0..count).step_by(2 * half) {
            for k in 0..half {
                let (low, high) = (start + k, start + k + half);
                scratch.turn(&mut real[high], &mut imaginary[high], k, half, circle);
                for part in [&mut *real, &mut *imaginary] {
                    let (below, above) = part.split_at_mut(high);
                    scratch.butterfly(&mut below[low], &mut above[0]);
                }
            }
        }
        half *= 2;
    }
}

struct Scratch {
    first: Float,
    second: Float,
}

impl Scratch {
    fn new(bits: u32) -> Self {
        Scratch {
            first: Float::new(bits),
            second: Float::new(bits),
        }
    }

    /// x e^(iπk/half), without a product where the factor is 1 or i.
    fn turn(&mut self, re: &mut Float, im: &mut Float, k: usize, half: usize, circle: &Circle) {
        if k == 0 {
            return;
        }
        if 2 * k == half {
            std::mem::swap(re, im);
            rug::ops::NegAssign::neg_assign(re);
            return;
        }
        let (cos, sin) = (circle.cosine(k, half), circle.sine(k, half));
        self.first.assign(&*re * sin);
        self.second.assign(&*im * sin);
        *re *= cos;
        *re -= &self.second;
        *im *= cos;
        *im += &self.first;
    }

    /// (a + b, a − b).
    fn butterfly(&mut self, a: &mut Float, b: &mut Float) {
        self.first.assign(&*a - &*b);
        *a += &*b;
        std::mem::swap(b, &mut self.first);
    }
}
