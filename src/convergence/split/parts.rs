//! The parts of an error at one precision of the oracle, and whether it shows them.

use super::ran::Exact;
use super::{Cell, Split};
use crate::reference::Reference;
use rug::Float;
use std::cmp::Ordering;

/// A part is shown where what may be wrong with it is at most 2^−this of itself.
const SETTLED_BITS: u32 = 20;
/// Roundings of each of n terms of the size of the radiance, and of what it takes to get there.
const ROUNDINGS: u32 = 16;
/// Errors that were measured are taken 2^this times: one of them may have come out small by chance.
const LUCK_BITS: u32 = 10;

/// The run whose error is split.
#[derive(Clone, Debug)]
pub(super) struct Measured {
    pub(super) radiance: Float,
    pub(super) stopped: Option<u64>,
    /// Which of a trace's transmittances are those of the method's sum; `None` where it has none of its own.
    pub(super) transmittances: Option<usize>,
}

/// The same method on the inputs of that run, in MPFR.
#[derive(Clone, Debug)]
pub(super) struct Followed {
    pub(super) radiance: Float,
    /// The radiance under the run's own transmittances.
    pub(super) under: Option<Float>,
}

/// The oracle, but for the methods.
pub(super) struct With {
    pub(super) bits: u32,
    /// Those of the run.
    pub(super) format_bits: u32,
    pub(super) n: u64,
    /// I.
    pub(super) reference: Reference,
    /// Whether what such bits do not show may stay hidden.
    pub(super) is_enough: bool,
}

/// What the bits of an oracle were good for.
pub(super) enum Judged {
    /// They show every part, or are enough to call what they do not show hidden.
    Settled(Cell),
    /// They do not.
    MoreBits {
        /// What to say where there are no more.
        unsettled: Cell,
        /// Whether of some part nothing is seen at all.
        is_hidden: bool,
    },
}

/// The cell of a method as these bits show it; `probed` is what rounding does to its radiance on another level.
pub(super) fn judge(
    measured: &Measured,
    exact: &Exact,
    followed: &Followed,
    with: &With,
    probed: &Float,
) -> Judged {
    let radiance = &with.reference.value;
    let less = |a: &Float, b: &Float| difference(a, b, with.bits);
    let total = less(&measured.radiance, radiance);
    // Without rounding it stops elsewhere.
    if exact.stopped != measured.stopped {
        return Judged::Settled(Cell::BranchDiverged { total });
    }
    let discretization = less(&exact.whole, radiance);
    let truncation = less(&exact.declared, &exact.whole);
    let input = less(&followed.radiance, &exact.declared);
    let arithmetic = less(&measured.radiance, &followed.radiance);
    let under = followed.under.as_ref();
    let of_depth = under.map(|under| less(under, &followed.radiance));
    let mut open_parts = vec![&truncation, &input, &arithmetic];
    open_parts.extend(&of_depth);
    let mut finite = open_parts.iter().map(|part| part.is_finite());
    if !total.is_finite() || !discretization.is_finite() || !finite.all(|finite| finite) {
        return Judged::Settled(Cell::NotFinite { total });
    }
    let rounding = [&input, &arithmetic].into_iter().chain(&of_depth);
    let of_run = sum_of_magnitudes(rounding) >> (with.bits - with.format_bits);
    let values = [radiance, &exact.whole, &followed.radiance];
    let resolution = resolution(largest(values), &of_run, probed, with);
    let shown = Float::with_val(64, &resolution) << SETTLED_BITS;
    let is_shown = |part: &&Float| part.cmp_abs(&shown).is_some_and(Ordering::is_ge);
    let is_hidden = |part: &&Float| part.cmp_abs(&resolution).is_some_and(Ordering::is_le);
    // The same numbers by the same way differ by nothing at all; of I that says nothing.
    open_parts.retain(|part| !part.is_zero());
    open_parts.push(&discretization);
    open_parts.retain(|part| !is_shown(part));
    let open = open_parts.len();
    open_parts.retain(is_hidden);
    let hidden = open_parts.len();
    if hidden < open || (hidden > 0 && !with.is_enough) {
        return Judged::MoreBits {
            unsettled: Cell::Unsettled {
                total,
                bits: with.bits,
            },
            is_hidden: hidden > 0,
        };
    }
    Judged::Settled(Cell::Split(Split {
        total,
        discretization,
        truncation,
        input,
        arithmetic,
        of_depth,
        resolution,
        bits: with.bits,
    }))
}

/// A bound of what the oracle's own rounding leaves in a part: the largest of
///
/// - a few roundings for each of n terms of the size of the radiance;
/// - what rounding did to the run, which is the same code on the same nodes with fewer bits, times 2^−(bits between them);
/// - what it does to the method on a level that was run with more bits, for each segment as much;
/// - what is not known of I.
///
/// The second knows how the medium and the sum of this very ray treat errors, the third also where the run has so few bits that
/// errors do not grow with them any more. Both are measured, and so taken for 2^[`LUCK_BITS`] times as much.
fn resolution(scale: &Float, of_run: &Float, probed: &Float, with: &With) -> Float {
    let a_priori = (Float::with_val(64, scale) * ROUNDINGS * with.n) >> with.bits;
    let measured = [of_run, probed].map(|error| Float::with_val(64, error) << LUCK_BITS);
    let all = measured
        .into_iter()
        .chain([Float::with_val(64, &with.reference.error)]);
    all.fold(a_priori.abs(), |a, b| if b > a { b } else { a })
}

fn sum_of_magnitudes<'a>(values: impl Iterator<Item = &'a Float>) -> Float {
    values.fold(Float::new(64), |sum, x| {
        sum + Float::with_val(64, x.abs_ref())
    })
}

fn largest(values: [&Float; 3]) -> &Float {
    let [mut largest, others @ ..] = values;
    for x in others {
        if x.cmp_abs(largest).is_some_and(Ordering::is_gt) {
            largest = x;
        }
    }
    largest
}

/// a − b, of more bits than either has.
pub(super) fn difference(a: &Float, b: &Float, bits: u32) -> Float {
    Float::with_val(bits + 64, a - b)
}
