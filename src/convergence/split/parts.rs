//! The parts of an error at two precisions of the oracle, and whether they agree.

use super::ran::Exact;
use super::{Cell, Split};
use crate::method::MethodError;
use rug::Float;
use std::sync::{Arc, OnceLock};

/// A part has settled where doubling the oracle's bits changes it by at most 2^−this of itself.
const SETTLED_BITS: u32 = 20;

/// The run whose error is split.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    pub(super) radiance: Float,
    pub(super) stopped: Option<u64>,
    /// T wherever the method's sum looks, in rows; none where the method has no transmittances of its own.
    pub(super) transmittances: Vec<Vec<Float>>,
}

/// The same method on the inputs of that run, in MPFR.
#[derive(Clone, Debug)]
pub(super) struct Followed {
    pub(super) radiance: Float,
    /// The radiance under the run's own transmittances.
    pub(super) under: Option<Float>,
}

/// All there is at one precision of the oracle.
pub(super) struct Inputs<'a> {
    pub(super) bits: u32,
    pub(super) n: u64,
    /// I.
    pub(super) radiance: Float,
    /// Every method without rounding, by its place among all methods.
    pub(super) rows: Arc<OnceLock<Vec<Result<Exact, MethodError>>>>,
    /// The methods of this run on its inputs.
    pub(super) followed: &'a [Result<Followed, MethodError>],
}

/// The parts at one precision, in the order discretization, truncation, input, arithmetic, of depth.
struct Parts {
    parts: [Float; 5],
    /// The magnitude of what the oracle subtracts.
    scale: Float,
}

/// The cell of the method that is `method` among all and `place` in this run.
pub(super) fn cell(
    measured: &Measured,
    method: usize,
    place: usize,
    low: &Inputs<'_>,
    high: &Inputs<'_>,
) -> Result<Cell, MethodError> {
    let total = difference(&measured.radiance, &high.radiance, high.bits);
    let coarse = parts(measured, method, place, low)?;
    let fine = parts(measured, method, place, high)?;
    let (Some(coarse), Some(fine)) = (coarse, fine) else {
        return Ok(Cell::BranchDiverged { total });
    };
    if !total.is_finite() || fine.parts.iter().any(|part| !part.is_finite()) {
        return Ok(Cell::NotFinite { total });
    }
    let resolution = resolution(&coarse, &fine, low, high);
    let settled = |(low, high): (&Float, &Float)| {
        let change = difference(low, high, high.prec()).abs();
        change <= Float::with_val(64, high.abs_ref()) >> SETTLED_BITS
            || *high.as_abs() <= resolution
    };
    if !coarse.parts.iter().zip(&fine.parts).all(settled) {
        return Ok(Cell::Unsettled {
            total,
            bits: high.bits,
        });
    }
    let has_depth = !measured.transmittances.is_empty();
    let [discretization, truncation, input, arithmetic, of_depth] = fine.parts;
    Ok(Cell::Split(Split {
        total,
        discretization,
        truncation,
        input,
        arithmetic,
        of_depth: has_depth.then_some(of_depth),
        resolution,
        bits: high.bits,
    }))
}

/// The parts at one precision; `None` where the method stops elsewhere without rounding.
fn parts(
    measured: &Measured,
    method: usize,
    place: usize,
    inputs: &Inputs<'_>,
) -> Result<Option<Parts>, MethodError> {
    let row = inputs.rows.get().and_then(|rows| rows.get(method));
    let (Some(row), Some(followed)) = (row, inputs.followed.get(place)) else {
        return Ok(None);
    };
    let exact = row.as_ref().map_err(Clone::clone)?;
    let followed = followed.as_ref().map_err(Clone::clone)?;
    if exact.stopped != measured.stopped {
        return Ok(None);
    }
    let less = |a: &Float, b: &Float| difference(a, b, inputs.bits);
    let of_depth = match &followed.under {
        Some(under) => less(under, &followed.radiance),
        None => Float::new(inputs.bits),
    };
    let values = [&inputs.radiance, &exact.whole, &followed.radiance];
    let scale = values
        .into_iter()
        .map(|x| x.clone().abs())
        .fold(Float::new(inputs.bits), |a, b| if b > a { b } else { a });
    Ok(Some(Parts {
        parts: [
            less(&exact.whole, &inputs.radiance),
            less(&exact.declared, &exact.whole),
            less(&followed.radiance, &exact.declared),
            less(&measured.radiance, &followed.radiance),
            of_depth,
        ],
        scale,
    }))
}

/// What the oracle's own rounding may leave in a part at the higher precision b: a few roundings for each of n
/// terms of the size of the radiance, and never less than what is seen at the lower one, b bits coarser.
fn resolution(coarse: &Parts, fine: &Parts, low: &Inputs<'_>, high: &Inputs<'_>) -> Float {
    let a_priori = (Float::with_val(64, &fine.scale) * 16_u32 * high.n) >> high.bits;
    let changes = coarse.parts.iter().zip(&fine.parts);
    changes
        .map(|(a, b)| difference(a, b, high.bits).abs() >> (high.bits - low.bits))
        .fold(
            a_priori,
            |a, b| if b > a { Float::with_val(64, b) } else { a },
        )
}

/// a − b, of more bits than either has.
pub(super) fn difference(a: &Float, b: &Float, bits: u32) -> Float {
    Float::with_val(bits + 64, a - b)
}
