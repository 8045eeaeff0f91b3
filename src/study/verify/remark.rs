//! What is visibly wrong with errors, whatever their order is.

use super::peers::Peer;
use crate::convergence::Sample;
use rug::Float;
use std::fmt;

/// Pairwise orders below this are none.
const FLAT: f64 = 0.1;
/// Pairwise orders above this fall.
const FALLING: f64 = 0.5;
/// Levels of a plateau.
const PLATEAU: usize = 3;
/// Methods of one order differ by less.
const BEYOND: f64 = 100.0;
/// So many floors are no roundoff.
const FLOORS: f64 = 30.0;

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
    /// An error of more than the radiance, and far more than that of any method of the order.
    Beyond {
        /// Segments of the level.
        n: u64,
        /// The error, as a part of the radiance.
        relative: f64,
        /// The largest of the methods'.
        of_methods: f64,
    },
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Remark::Plateau {
                first,
                last,
                relative,
            } => write!(
                f,
                "stays {relative:.1e} of the radiance off from n = {first} to {last}, where methods of its order converge"
            ),
            Remark::Beyond {
                n,
                relative,
                of_methods,
            } => write!(
                f,
                "is {relative:.1e} times the radiance off at n = {n}, where methods of its order are {of_methods:.1e} off"
            ),
        }
    }
}

/// What shows beside the methods of an order, or the one that is declared; `levels` are numbers of segments with errors.
pub(super) fn remarks(exact: &Float, levels: &[(u64, Sample)], peers: &[Peer]) -> Vec<Remark> {
    if peers.is_empty() || exact.is_zero() {
        return Vec::new();
    }
    let scale = exact.to_f64().abs();
    let size = |sample: &Sample| sample.error.to_f64().abs();
    let of_peers = |level: usize| {
        let errors = peers.iter().filter_map(|peer| peer.samples.get(level));
        errors.map(size).fold(0.0, f64::max)
    };
    let mut remarks = Vec::new();
    let beyond = levels.iter().enumerate().find(|(level, (_, sample))| {
        let error = size(sample);
        error > scale && error > BEYOND * of_peers(*level) && error > BEYOND * sample.floor.to_f64()
    });
    if let Some((level, (n, sample))) = beyond {
        remarks.push(Remark::Beyond {
            n: *n,
            relative: size(sample) / scale,
            of_methods: of_peers(level) / scale,
        });
    }
    let order = |pair: &[&Sample]| match pair {
        [coarse, fine] => (size(coarse) / size(fine)).ln() / (coarse.step / fine.step).ln(),
        _ => f64::NAN,
    };
    let all = |samples: &[&Sample], holds: &dyn Fn(f64) -> bool| {
        samples.windows(2).all(|pair| holds(order(pair)))
    };
    let plateau = levels.windows(PLATEAU).enumerate().find(|(start, window)| {
        let own: Vec<&Sample> = window.iter().map(|(_, sample)| sample).collect();
        let last = start + PLATEAU - 1;
        let above = own.iter().all(|sample| {
            size(sample) > FLOORS * sample.floor.to_f64() && size(sample) > of_peers(last)
        });
        let fall = |peer: &Peer| {
            let theirs = peer.samples.get(*start..=last).unwrap_or_default();
            all(&theirs.iter().collect::<Vec<_>>(), &|order| order > FALLING)
        };
        above && all(&own, &|order| order.abs() < FLAT) && peers.iter().all(fall)
    });
    if let Some((_, window)) = plateau
        && let [(first, _), .., (last, sample)] = window
    {
        remarks.push(Remark::Plateau {
            first: *first,
            last: *last,
            relative: size(sample) / scale,
        });
    }
    remarks
}
