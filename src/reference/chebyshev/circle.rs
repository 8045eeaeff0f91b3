//! cos(πk/n) for all n that are powers of 2, without a transcendental function, and what cosine transforms divide by.

use rug::Float;
use rug::ops::NegAssign;

/// cos(πk/n), k = 0 … n, for the largest n so far.
#[derive(Debug)]
pub struct Circle {
    bits: u32,
    cosines: Vec<Float>,
    /// cos(π/n).
    first: Float,
    /// 1/(2 cos(πk/n)), 0 ≤ k < n/2.
    half_secants: Vec<Float>,
}

impl Circle {
    /// The table of n = 2.
    #[must_use]
    pub fn new(bits: u32) -> Circle {
        let at = |x: i32| Float::with_val(bits, x);
        Circle {
            bits,
            cosines: vec![at(1), at(0), at(-1)],
            first: at(0),
            half_secants: vec![at(1) / 2_u32],
        }
    }

    /// The precision of the table.
    pub(in crate::reference) fn bits(&self) -> u32 {
        self.bits
    }

    /// Doubles the table until it serves `n`, a power of 2.
    ///
    /// cos(π/2n) = √((1 + cos(π/n))/2), and between two neighbours (cos a + cos b) / (2 cos((b − a)/2)), which
    /// adds an error of a unit or two at each doubling.
    pub fn grow(&mut self, n: usize) {
        while self.degree() < n {
            let half = Float::with_val(self.bits, &self.first + 1) / 2_u32;
            self.first = half.sqrt();
            let factor = Float::with_val(self.bits, &self.first * 2_u32).recip();
            let mut finer = Vec::with_capacity(2 * self.cosines.len());
            for pair in self.cosines.windows(2) {
                let [a, b] = pair else { continue };
                finer.push(a.clone());
                finer.push(Float::with_val(self.bits, a + b) * &factor);
            }
            finer.extend(self.cosines.last().cloned());
            self.cosines = finer;
            let known = std::mem::take(&mut self.half_secants);
            let quarter = self.degree() / 2;
            let mut odd = self.cosines.iter().take(quarter).skip(1).step_by(2);
            for known in known {
                self.half_secants.push(known);
                let new = odd
                    .next()
                    .map(|cosine| Float::with_val(self.bits, cosine << 1_u32).recip());
                self.half_secants.extend(new);
            }
        }
    }

    fn degree(&self) -> usize {
        self.cosines.len() - 1
    }

    /// cos(πk/n) for 0 ≤ k ≤ n, where the table serves n.
    #[must_use]
    pub fn cosine(&self, k: usize, n: usize) -> &Float {
        &self.cosines[k * (self.degree() / n)]
    }

    /// sin(πk/n) for 0 ≤ k ≤ n, where the table serves n.
    #[must_use]
    pub fn sine(&self, k: usize, n: usize) -> &Float {
        let quarter = self.degree() / 2;
        &self.cosines[(k * (self.degree() / n)).abs_diff(quarter)]
    }

    /// 1/(2 cos(πk/n)) for 0 ≤ k < n/2, where the table serves n.
    pub(super) fn half_secant(&self, k: usize, n: usize) -> &Float {
        &self.half_secants[k * (self.degree() / n)]
    }

    /// (1 − cos(πk/n))/2: the points of [0, 1], from the left.
    #[must_use]
    pub fn place(&self, k: usize, n: usize) -> Float {
        let mut place = self.cosine(k, n).clone();
        place.neg_assign();
        (place + 1_u32) / 2_u32
    }
}
