//! What of a total error may be rounding, foreseen.

use crate::case::{Case, Transfer};
use crate::method::{Method, OpacityFormula};
use crate::real::FormatName;
use rug::Float;

/// Segments of the ray that is looked at.
const SEGMENTS: u32 = 256;
/// A place or a field value is moved by this part of itself: by its own square root, binary64's rounding is as small.
const MOVED: f64 = 1.0 / (1_u64 << 26) as f64;
/// A sum of n terms that has so many bits below its terms rounds them up and down as by chance.
const SPARE_BITS: u32 = 6;
/// A depth whose rounding is so much, or more, is not known.
const LOST: f64 = 0.125;
const BITS: u32 = 64;

/// How large the numbers are that a radiance is summed of, and how they answer to rounded inputs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sizes {
    /// ∫ |C τ| T (1 + t + δt) + |δ(C τ)| T dλ, where δ is the change by a relative error of 1 in λ and in s, to first order.
    pub(super) terms: f64,
    /// The largest |C|.
    pub(super) emission: f64,
    /// The largest |t|.
    pub(super) depth: f64,
    /// D.
    pub(super) length: f64,
}

impl Sizes {
    /// Of a ray, at the middles of 256 segments in binary64. What is not finite there is left out: |I| is a size too.
    pub(super) fn of<C: Case>(case: &C) -> Sizes {
        let length = case.length().to_f64();
        let step = length / f64::from(SEGMENTS);
        let at = |s: f64| {
            let Transfer {
                emission,
                extinction,
            } = case.transfer(&s);
            (emission, extinction, emission * extinction)
        };
        let field = |lambda: f64| case.field(&lambda);
        let (mut depth, mut moved_depth) = (0.0, 0.0);
        let mut sizes = Sizes {
            terms: 0.0,
            emission: 0.0,
            depth: 0.0,
            length,
        };
        for j in 0..SEGMENTS {
            let lambda = (f64::from(j) + 0.5) * step;
            let s = field(lambda);
            let (emission, extinction, source) = at(s);
            let moved = [at(field(lambda * (1.0 + MOVED))), at(s * (1.0 + MOVED))];
            let change = |of: fn((f64, f64, f64)) -> f64, here: f64| -> f64 {
                let changes = moved
                    .iter()
                    .map(|there| ((of(*there) - here) / MOVED).abs());
                changes.filter(|change| change.is_finite()).sum()
            };
            // To the middle of the segment, and on to its end.
            depth += extinction * step / 2.0;
            let transmittance = (-depth).exp();
            let answer = source.abs() * (1.0 + depth.abs() + moved_depth)
                + change(|(_, _, source)| source, source);
            depth += extinction * step / 2.0;
            sizes.depth = sizes.depth.max(depth.abs());
            moved_depth += change(|(_, extinction, _)| extinction, extinction) * step;
            let term = answer * transmittance * step;
            if term.is_finite() {
                sizes.terms += term;
                sizes.emission = sizes.emission.max(emission.abs());
            }
        }
        sizes
    }

    /// What of the total error of `method` on n segments may be rounding, or the light behind the place where a ray ends
    /// early: fits take errors of up to 30 times as much for that.
    ///
    /// With u = 2^−bits, n roundings of relative size u in each of terms and depths, up and down by chance, leave u·√n of
    /// what is summed. That they are by chance needs terms that are no multiples of the sum's last place: where a term, one of n,
    /// has not [`SPARE_BITS`] bits below the sum they may all go one way, u·n. In fixed point, where an error is no part
    /// of its number, the unit is at least 1, and τ d loses as much in every segment: u·n as well.
    ///
    /// What is no small relative error comes besides: a depth of which rounding leaves no digit, with which any light may
    /// come through; 1 − e^(−x) by subtraction, which is off by u whatever x; and what is less than a format's smallest
    /// number, in each term or in all of τ.
    pub(super) fn floor(
        &self,
        radiance: &Float,
        method: &Method,
        format: FormatName,
        bits: u32,
        n: u64,
    ) -> Float {
        let is_fixed = matches!(format, FormatName::Fixed(_));
        let mut size = Float::with_val(BITS, self.terms);
        size = size.max(&Float::with_val(BITS, radiance.abs_ref()));
        if is_fixed {
            size = size.max(&Float::with_val(BITS, 1));
        }
        let by_chance = !is_fixed && n.max(1).ilog2() + SPARE_BITS <= bits;
        let roundings = if by_chance {
            (n as f64).sqrt()
        } else {
            n as f64
        };
        let mut floor = (size * roundings) >> bits;
        let lost = Float::with_val(BITS, self.depth * roundings) >> bits;
        if lost > LOST {
            floor += self.emission;
        }
        if let Some(exponent) = smallest(format) {
            let numbers = n as f64 + self.length * (1.0 + self.emission);
            floor += Float::with_val(BITS, numbers) << exponent;
        }
        if let Method::Composited(compositing) = method {
            if compositing.opacity == OpacityFormula::Subtraction {
                floor += Float::with_val(BITS, n as f64 * self.emission) >> bits;
            }
            if let Some(threshold) = compositing.threshold() {
                floor += Float::with_val(BITS, threshold.value()) * self.emission;
            }
        }
        floor
    }
}

/// The binary logarithm of the smallest number that a format has above 0; none where exponents have no end that matters.
fn smallest(format: FormatName) -> Option<i32> {
    // Of fixed point it is the unit itself, which is a size already.
    let emin = format.emin()?;
    let bits = i32::try_from(format.bits()).unwrap_or(i32::MAX);
    Some(emin.saturating_sub(bits).saturating_add(1))
}
