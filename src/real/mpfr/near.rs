//! Exponentials from others nearby, by a short series.

use super::MpfrReal;
use rug::float::Round;
use rug::ops::AssignRound;
use rug::{Assign, Float};

/// Bits beyond those that the last place of a product needs: what is lost on the way is a small part of it.
const GUARD_BITS: u32 = 16;
/// A series is quicker than an exponential up to that many terms, and one more for so many bits.
const TERMS: u32 = 4;
const BITS_A_TERM: u32 = 32;
/// Nobody is near who is farther than this power of two.
const FARTHEST: i32 = -4;

/// e^(−x) of many x, each near one whose exponential is known: e^(−x) = e^(−y) e^δ with δ = y − x, and
/// e^δ = 1 + δ (1 + δ/2 (1 + δ/3 (…))) in as many bits and terms as the last place of the product asks for.
///
/// Where e^(−y) is off by r of itself, what comes out is by at most r + 1.25·2^−bits: ½ unit of the last rounding, 2^−(bits + 3)
/// that the series leaves, 2^−(bits + 4) of δ.
#[derive(Debug)]
pub(crate) struct Near {
    bits: u32,
    difference: Float,
    series: Float,
}

impl Near {
    /// For numbers of so many bits.
    pub(crate) fn new(bits: u32) -> Self {
        Near {
            bits,
            difference: Float::new(bits),
            series: Float::new(bits),
        }
    }

    /// e^(−x) from `known` = e^(−y); `None` where y is too far for a series to pay, or is no number.
    pub(crate) fn exp_of_negative(
        &mut self,
        x: &MpfrReal,
        y: &MpfrReal,
        known: &MpfrReal,
    ) -> Option<MpfrReal> {
        let (x, y, known) = (&x.0, &y.0, &known.0);
        // One bit more than either may have: the difference of neighbours is exact, or good to the last place.
        self.difference.set_prec(self.bits);
        self.difference.assign_round(y - x, Round::Nearest);
        if self.difference.is_zero() {
            return Some(MpfrReal(known.clone()));
        }
        // |δ| < 2^exponent; of NaN and ∞ there is none.
        let exponent = self.difference.get_exp().filter(|e| *e <= FARTHEST)?;
        let below = exponent.unsigned_abs();
        let terms = terms(below, self.bits)?;
        // The sum behind the 1 is smaller than it by 2^−below, and so are its last places.
        let width = self.bits.saturating_sub(below) + GUARD_BITS;
        if width < self.bits {
            self.difference.set_prec_round(width, Round::Nearest);
        }
        self.series.set_prec(self.difference.prec());
        self.series.assign(1);
        for k in (2..=terms).rev() {
            self.series *= &self.difference;
            self.series /= k;
            self.series += 1_u32;
        }
        self.series *= &self.difference;
        self.series *= known;
        Some(MpfrReal(Float::with_val(self.bits, known + &self.series)))
    }
}

/// How many terms behind the 1 leave less than 2^−(bits + 3) where |δ| < 2^−`below`; `None` where an exponential is quicker.
fn terms(below: u32, bits: u32) -> Option<u32> {
    let wanted = u64::from(bits) + 3;
    let mut reached = u64::from(below);
    let most = TERMS + bits / BITS_A_TERM;
    (1..=most).find(|&k| {
        // Term k + 1 is δ^(k + 1)/(k + 1)!, and those behind it are less together.
        reached += u64::from(below) + u64::from((k + 1).ilog2());
        reached > wanted
    })
}
