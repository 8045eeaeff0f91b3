//! The integral by Chebyshev series, panel by panel, to any number of digits.
//!
//! On a panel τ and C·τ are sampled on nested points until their series are resolved; the series of τ
//! integrated is that of t, and C τ e^(−t), a series again, is integrated in its turn. A panel that is not
//! resolved is halved, so that panels close in on what is not analytic. The ray is cut at the breaks of the
//! case before, those that its formulas have or, of a case without, those that its structure tells of; roots at the ends
//! of what is left are made analytic by a power of the variable. A value at a break, which may belong to the other
//! side, is never used.

mod grid;
mod light;
mod march;
mod panel;
mod stretch;
mod verdict;

use super::medium::Medium;
use super::{GUARD_BITS, NotEnclosed, Quantity, Reference, ReferenceError, Source, believed_bits};
use crate::real::MAX_BITS;
use march::March;
use rug::Float;

/// Bits beyond those asked for that series are resolved to.
const TARGET_BITS: u32 = 16;
/// Bits beyond those that it is computed with.
const ROUNDING_BITS: u32 = 64;
/// How often it is computed again with more bits, where they were lost.
const ATTEMPTS: u32 = 4;

/// What was done for a value.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Panels that were integrated.
    pub panels: u64,
    /// Points of these panels.
    pub points: u64,
    /// How often the medium was evaluated, for panels that were halved too.
    pub evaluations: u64,
    /// Transcendental functions taken, those of the medium with them; a sine and cosine of the same number
    /// are one.
    pub transcendental_calls: u64,
}

/// The precisions of an attempt.
#[derive(Clone, Copy, Debug)]
struct Settings {
    /// What is wanted.
    quantity: Quantity,
    /// Significant bits that were asked for.
    wanted: u32,
    /// Series are resolved to 2^(−target) of the result.
    target: u32,
    /// Significant bits of all numbers.
    precision: u32,
    /// The highest degree of the medium's series.
    limit: usize,
}

impl Settings {
    fn new(quantity: Quantity, wanted: u32, target: u32) -> Settings {
        Settings {
            quantity,
            wanted,
            target,
            precision: target + ROUNDING_BITS,
            // Steep functions decay by a bit in four coefficients; others are quicker in halves.
            limit: (4 * target as usize).next_power_of_two().max(256),
        }
    }
}

/// t(D) or I(D) to `bits` significant bits by an estimate, where there is no enclosure for that reason.
pub(super) fn integrate(
    case: &dyn Medium,
    quantity: Quantity,
    bits: u32,
    not_enclosed: NotEnclosed,
) -> Result<Reference, ReferenceError> {
    let mut work = Work::default();
    let mut target = bits + TARGET_BITS;
    let mut believed = 0;
    for _ in 0..ATTEMPTS {
        let settings = Settings::new(quantity, bits, target);
        if settings.precision > MAX_BITS {
            break;
        }
        let march = March::new(case, settings, &mut work);
        let (value, error) = march.run()?;
        let held = bits + GUARD_BITS;
        let unit = Float::with_val(64, value.abs_ref()) >> held;
        let error = error + unit;
        believed = believed_bits(&value, &error);
        if believed >= bits || error.is_zero() {
            return Ok(Reference {
                value: Float::with_val(held, value),
                error,
                not_enclosed: Some(not_enclosed),
                source: Source::Spectral,
                work,
            });
        }
        if believed == 0 && value.is_zero() {
            break;
        }
        target += bits - believed + TARGET_BITS;
    }
    Err(ReferenceError::NotResolved {
        wanted: bits,
        believed,
        lambda: None,
        evaluations: work.evaluations,
    })
}
