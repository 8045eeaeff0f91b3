//! What is visibly wrong with errors, whatever their order is.

use super::line::part_of;
use super::peer::Peer;
use crate::convergence::verdict::NO_CONVERGENCE;
use crate::convergence::{FLOOR_MARGIN, Sample};
use crate::kernel::Quantity;
use rug::Float;

/// Pairwise orders above this fall.
const FALLING: f64 = 0.5;
/// Levels of a plateau.
const PLATEAU: usize = 3;
/// So many times the error of methods, or of coarser levels, is another error.
const OTHER: f64 = 10.0;
/// So many times those of all methods at a coarse level, of more than the radiance.
const BEYOND: f64 = 100.0;
/// At the finest levels an error of this part of the radiance is no small matter.
const LARGE: f64 = 0.01;

/// What is visibly wrong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Remark {
    /// Errors that stay where they are over levels on which those of every method of the order fall.
    Plateau {
        /// Segments of the coarsest level of it.
        first: u64,
        /// Segments of the finest.
        last: u64,
        /// The error there, as a part of the radiance.
        relative: f64,
    },
    /// An error far beyond those of all methods: one of more than the radiance, a rise from one level to the next, what
    /// is left at the finest levels, or at a number of segments that orders are not fitted to.
    Off {
        /// Segments of the level.
        n: u64,
        /// The error, as a part of the radiance.
        relative: f64,
        /// The largest of the methods'.
        of_methods: f64,
    },
}

impl Remark {
    /// In words, of what is measured.
    #[must_use]
    pub fn of(&self, quantity: Quantity) -> String {
        match self {
            Remark::Plateau {
                first,
                last,
                relative,
            } => format!(
                "stays {relative:.1e} of the {quantity} off from n = {first} to {last}, where methods of its order converge"
            ),
            Remark::Off {
                n,
                relative,
                of_methods,
            } => format!(
                "is {relative:.1e} times the {quantity} off at n = {n}, where methods of its order are {of_methods:.1e} off"
            ),
        }
    }
}

/// A level: segments, the kernel's error there with its floor, and the largest error of the methods, as parts of the
/// radiance.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    segments: u64,
    step: f64,
    error: f64,
    floor: f64,
    of_methods: f64,
}

impl Seen {
    /// Of a kernel's sample, beside the methods' at that place of their levels.
    pub(super) fn new(
        exact: &Float,
        (segments, sample): &(u64, Sample),
        methods: &[Peer],
        place: usize,
    ) -> Seen {
        let of_methods = methods.iter().filter_map(|peer| peer.samples.get(place));
        let of_methods = of_methods.map(|sample| part_of(exact, &sample.error));
        Seen {
            segments: *segments,
            step: sample.step,
            error: part_of(exact, &sample.error),
            floor: part_of(exact, &sample.floor),
            of_methods: of_methods.fold(0.0, f64::max),
        }
    }

    /// Whether it is no worse than the worst of the methods, but for rounding.
    pub(super) fn is_as_good(&self) -> bool {
        !self.is_above(1.0)
    }

    fn is_above(&self, times: f64) -> bool {
        self.error > times * self.of_methods && self.error > f64::from(FLOOR_MARGIN) * self.floor
    }

    /// Whether it is far above both of these too.
    fn rises(&self, coarser: &[Seen]) -> bool {
        let largest = coarser.iter().map(|level| level.error).fold(0.0, f64::max);
        coarser.len() == 2 && self.is_above(OTHER) && self.error > OTHER * largest
    }
}

/// What shows at the levels, and at single numbers of segments beside them.
pub(super) fn remarks(levels: &[Seen], spots: &[Seen]) -> Vec<Remark> {
    let off = |seen: &Seen| Remark::Off {
        n: seen.segments,
        relative: seen.error,
        of_methods: seen.of_methods,
    };
    let is_off = |(place, seen): &(usize, &Seen)| {
        let coarser = levels.get(place.saturating_sub(2)..*place);
        let is_fine = place + 2 >= levels.len();
        (seen.error > 1.0 && seen.is_above(BEYOND))
            || (is_fine && seen.error > LARGE && seen.is_above(OTHER))
            || seen.rises(coarser.unwrap_or_default())
    };
    let mut all = levels.iter().enumerate();
    let at_level = all.find(is_off).map(|(_, seen)| off(seen));
    let beside = |spot: &&Seen| {
        let finer = levels.partition_point(|level| level.segments < spot.segments);
        let coarser = levels.get(finer.saturating_sub(2)..finer);
        spot.rises(coarser.unwrap_or_default())
    };
    let at_spot = spots.iter().find(beside).map(off);
    // The first says it.
    let is_off = at_level.or(at_spot);
    let plateau = levels.windows(PLATEAU).find(|levels| is_plateau(levels));
    let plateau = plateau.and_then(|levels| match levels {
        [first, .., last] => Some(Remark::Plateau {
            first: first.segments,
            last: last.segments,
            relative: last.error,
        }),
        _ => None,
    });
    is_off.into_iter().chain(plateau).collect()
}

fn is_plateau(levels: &[Seen]) -> bool {
    let order = |pair: &[Seen], of: &dyn Fn(&Seen) -> f64| match pair {
        [coarse, fine] => (of(coarse) / of(fine)).ln() / (coarse.step / fine.step).ln(),
        _ => f64::NAN,
    };
    let stays = |pair: &[Seen]| {
        order(pair, &|seen| seen.error).abs() < NO_CONVERGENCE
            && order(pair, &|seen| seen.of_methods) > FALLING
    };
    levels.iter().all(|level| level.is_above(1.0)) && levels.windows(2).all(stays)
}
