//! Closed forms, in intervals where they are formulas. Where they are code they are evaluated at two precisions: what
//! differs is what rounding and cancellation do.

use super::enclosure::values;
use super::medium::Medium;
use super::{
    GUARD_BITS, NotEnclosed, Quantity, Reference, ReferenceError, Source, Work, believed_bits,
};
use crate::real::{Format, MAX_BITS, Mpfr};
use crate::symbolic::{Interval, Program};
use rug::{Float, Rational};

/// How often the precision is doubled where digits cancel.
const DOUBLINGS: u32 = 4;
/// By how many bits rounding at one precision may be worse than at another.
const MARGIN: u32 = 8;

/// t(D) or I(D) from its closed form, `None` where the case has none.
pub(super) fn evaluate(
    case: &dyn Medium,
    quantity: Quantity,
    bits: u32,
) -> Option<Result<Reference, ReferenceError>> {
    if let Some(program) = case.closed_form(quantity)
        && let Some(interval) = enclosed(&program, &case.length(), bits)
    {
        let work = Work::default();
        return Some(Ok(Reference::enclosed(
            &interval,
            bits,
            Source::ClosedForm,
            work,
        )));
    }
    let at = |bits: u32| -> Option<Float> {
        let end = Mpfr { bits }.ratio(&case.length());
        let value = match quantity {
            Quantity::Depth => case.optical_depth(&end),
            Quantity::Radiance => case.radiance(&end),
        };
        Some(value?.into())
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
        believed = believed_bits(&fine, &error);
        if error.is_zero() || believed >= bits {
            // What cancels in the finer value is less by as many bits as it has more; then it is rounded.
            let unit = Float::with_val(64, fine.abs_ref()) >> held;
            let error = (error >> (finer - precision)) << MARGIN;
            return Some(Ok(Reference {
                value: Float::with_val(held, &fine),
                error: if error > unit { error } else { unit },
                not_enclosed: Some(NotEnclosed::NoFormulas),
                source: Source::ClosedForm,
                work: Work::default(),
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

/// The value at the far end in so many bits, with more where digits cancel; `None` where that does not help.
fn enclosed(program: &Program, length: &Rational, bits: u32) -> Option<Interval> {
    // More than it is held with, so that the middle of what is enclosed is the nearest number.
    let mut precision = bits + 2 * GUARD_BITS;
    for _ in 0..=DOUBLINGS {
        let end = Interval::point(precision, length);
        let value = values(program, &end).pop()??;
        let off = Float::with_val(64, value.width());
        let middle = value.midpoint();
        if off.is_zero() || value.is_finite() && believed_bits(&middle, &off) > bits + GUARD_BITS {
            return Some(value);
        }
        precision = (2 * precision).min(MAX_BITS);
    }
    None
}
