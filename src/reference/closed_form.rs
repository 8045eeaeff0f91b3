//! Closed forms, evaluated at two precisions: what differs is what rounding and cancellation do.

use super::{GUARD_BITS, Reference, ReferenceError, Source};
use crate::case::Case;
use crate::real::{Format, MAX_BITS, Mpfr, Real};
use rug::Float;

/// How often the precision is doubled where digits cancel.
const DOUBLINGS: u32 = 4;
/// By how many bits rounding at one precision may be worse than at another.
const MARGIN: u32 = 8;

/// I(D) from the closed form, `None` where the case has none.
pub(super) fn radiance<C: Case>(case: &C, bits: u32) -> Option<Result<Reference, ReferenceError>> {
    let at = |bits: u32| -> Option<Float> {
        let format = Mpfr { bits };
        Some(case.radiance(&format.ratio(&case.length()))?.into())
    };
    let held = bits + GUARD_BITS;
    let mut precision = held;
    let mut coarse = at(precision)?;
    let mut believed = 0;
    for _ in 0..=DOUBLINGS {
        let finer = (2 * precision).min(MAX_BITS);
        if finer == precision {
            break;
        }
        let fine = at(finer)?;
        if !fine.is_finite() || !coarse.is_finite() {
            let value = if fine.is_finite() { coarse } else { fine };
            return Some(Err(ReferenceError::ClosedFormNotFinite {
                value: value.to_string_radix(10, Some(6)),
            }));
        }
        let error = Float::with_val(64, &coarse - &fine).abs();
        believed = common_bits(&fine, &error);
        if error.is_zero() || believed >= bits {
            // What cancels in the finer value is less by as many bits as it has more; then it is rounded.
            let unit = Float::with_val(64, fine.abs_ref()) >> held;
            let error = (error >> (finer - precision)) << MARGIN;
            return Some(Ok(Reference {
                value: Float::with_val(held, &fine),
                error: if error > unit { error } else { unit },
                source: Source::ClosedForm,
                evaluations: 0,
            }));
        }
        (precision, coarse) = (finer, fine);
    }
    Some(Err(ReferenceError::Cancelled {
        believed,
        precision,
        bits,
    }))
}

/// −log₂ of the relative error, at least 0.
fn common_bits(value: &Float, error: &Float) -> u32 {
    let log2 = |x: &Float| crate::real::MpfrReal::from(x.clone()).log2_abs();
    let bits = (log2(value) - log2(error)).floor();
    if bits >= f64::from(u32::MAX) {
        u32::MAX
    } else if bits > 0.0 {
        // Between 0 and u32::MAX.
        bits as u32
    } else {
        0
    }
}
