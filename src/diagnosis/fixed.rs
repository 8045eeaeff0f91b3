//! Values that are all multiples of one quantum, or all binary32 numbers: what they were kept in.

use super::{Accumulator, FixedRounding, FixedScale, Watched};
use std::ops::RangeInclusive;

/// Bits of a fraction looked for.
const FIXED_BITS: RangeInclusive<u32> = 6..=24;
/// Fractions of so few bits no rounded binary32 numbers have all alike.
const SURE_BITS: u32 = 16;
/// How far from an integer a multiple of the quantum may lie: values come in binary64.
const NEARLY_INTEGER: f64 = 1e-6;
/// So many different values are no accident.
const FEWEST_VALUES: usize = 6;

/// What the values of all levels were kept in, where that is coarser than binary64.
pub(super) fn detect(watched: &[Watched]) -> Option<Accumulator> {
    let levels = watched.iter().flat_map(|one| &one.levels);
    let mut values: Vec<f64> = levels.map(|level| level.value.abs()).collect();
    values.retain(|value| value.is_finite() && *value > 0.0);
    values.sort_by(f64::total_cmp);
    values.dedup();
    if values.len() < FEWEST_VALUES {
        return None;
    }
    let scales = [FixedScale::PowerOfTwo, FixedScale::Largest];
    let kinds = FIXED_BITS.flat_map(|bits| scales.map(|scale| (bits, scale)));
    for (bits, scale) in kinds {
        let quanta = scale.quanta(bits);
        let is_multiple = |value: &f64| {
            let multiple = value * quanta;
            (multiple - multiple.round()).abs() <= NEARLY_INTEGER
        };
        // Of binary32 numbers all large ones are multiples of 2⁻²⁴; none of those near the quantum is.
        let is_grid = bits <= SURE_BITS || values.iter().any(|value| value * quanta < 4096.0);
        if is_grid && values.iter().all(is_multiple) {
            let rounding = FixedRounding::Nearest;
            return Some(Accumulator::Fixed {
                bits,
                scale,
                rounding,
            });
        }
    }
    // Widening and narrowing again changes nothing of what was binary32.
    #[allow(clippy::cast_possible_truncation)]
    let is_binary32 = |value: &f64| (f64::from(*value as f32)).to_bits() == value.to_bits();
    values
        .iter()
        .all(is_binary32)
        .then_some(Accumulator::Binary32)
}

/// `x` as a fixed-point accumulator keeps it.
pub(super) fn keep(x: f64, bits: u32, scale: FixedScale, rounding: FixedRounding) -> f64 {
    let quanta = scale.quanta(bits);
    let multiple = x * quanta;
    let kept = match rounding {
        FixedRounding::Nearest => multiple.round(),
        FixedRounding::Down => multiple.floor(),
    };
    kept / quanta
}
