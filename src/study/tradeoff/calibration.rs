//! What operations cost on this machine, in one format.

mod kinds;
mod runs;
pub(crate) mod solve;

use super::clock::now;
use super::measure::{Timing, nanoseconds, runs_a_measurement};
use crate::real::counted::Kind;
use crate::real::{Counts, Format, FormatName, WithFormat};
use serde::ser::{Serialize, SerializeMap, Serializer};
use std::time::Duration;

/// What is left of the time for a calibration after one pass is for passes to come.
const BUDGET: Duration = Duration::from_millis(80);
/// Each piece of work is measured so often at most, the passes apart: what disturbs one seldom disturbs all.
const PASSES: usize = 5;

/// Nanoseconds an operation of every [`Kind`], and of a run by itself, in one format on this machine.
///
/// They are those with which t = c₀ + Σ cₖ Nₖ comes nearest to measured runs of a few methods on a few media, in
/// the sense of least squares of relative differences, none below 0. What the runs cannot tell apart stays near
/// the kinds' times by themselves.
///
/// ```
/// use volver::real::counted::Kind;
/// use volver::real::{Counts, FormatName};
/// use volver::study::tradeoff::Calibration;
///
/// let calibration = Calibration::of_format(FormatName::F64);
/// let work = Counts::of(Kind::Exponential, 1000);
/// assert!(calibration.nanoseconds(&work) >= calibration.nanoseconds(&Counts::default()));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Calibration {
    /// The format.
    pub format: FormatName,
    costs: Vec<f64>,
    run: f64,
}

/// Some work with known counts.
struct Piece {
    counts: Counts,
    work: Box<dyn FnMut()>,
}

impl Calibration {
    /// Measures, for about a tenth of a second; longer where numbers have thousands of bits.
    #[must_use]
    pub fn of_format(format: FormatName) -> Calibration {
        format.with(Measure { format })
    }

    /// What that work takes, by the model t = c₀ + Σ cₖ Nₖ.
    #[must_use]
    pub fn nanoseconds(&self, counts: &Counts) -> f64 {
        let costs = self.costs.iter().zip(Kind::ALL);
        let sum: f64 = costs.map(|(cost, kind)| cost * counts[kind] as f64).sum();
        self.run + sum
    }

    /// Between this one and another of the same format, made at another time.
    #[must_use]
    pub fn mean(&self, other: &Calibration) -> Calibration {
        let costs = self.costs.iter().zip(&other.costs);
        Calibration {
            format: self.format,
            costs: costs.map(|(a, b)| f64::midpoint(*a, *b)).collect(),
            run: f64::midpoint(self.run, other.run),
        }
    }

    /// Nanoseconds that one more of that kind takes.
    #[must_use]
    pub fn cost(&self, kind: Kind) -> f64 {
        self.costs.get(kind as usize).copied().unwrap_or(0.0)
    }
}

struct Measure {
    format: FormatName,
}

impl WithFormat for Measure {
    type Output = Calibration;

    fn run<F: Format>(self, format: F) -> Calibration {
        let prior = kinds::costs(format);
        calibrated(self.format, &prior, runs::pieces(format))
    }
}

fn calibrated(format: FormatName, prior: &[f64], mut pieces: Vec<Piece>) -> Calibration {
    let times = measured(&mut pieces);
    let rows: Vec<(Vec<f64>, f64)> = pieces
        .iter()
        .zip(times)
        .filter(|(_, time)| *time > 0.0)
        .map(|(piece, time)| (features(&piece.counts), time))
        .collect();
    let mut costs = solve::costs(&rows, prior);
    let run = costs.pop().unwrap_or(0.0);
    Calibration { format, costs, run }
}

/// The counts, and 1 for the run itself at the end.
fn features(counts: &Counts) -> Vec<f64> {
    let kinds = Kind::ALL.iter().map(|kind| counts[*kind] as f64);
    kinds.chain(std::iter::once(1.0)).collect()
}

/// The median time of each piece over several passes.
fn measured(pieces: &mut [Piece]) -> Vec<f64> {
    let start = now();
    let runs: Vec<u32> = pieces
        .iter_mut()
        .map(|piece| runs_a_measurement(&mut piece.work))
        .collect();
    let mut times = vec![Vec::new(); pieces.len()];
    for pass in 0..PASSES {
        if pass > 0 && now().saturating_sub(start) > BUDGET {
            break;
        }
        for ((piece, runs), times) in pieces.iter_mut().zip(&runs).zip(&mut times) {
            times.push(nanoseconds(*runs, &mut piece.work));
        }
    }
    let median = |times| Timing::of(times).map_or(0.0, |timing| timing.median);
    times.into_iter().map(median).collect()
}

/// A map from kinds to nanoseconds, and `run`.
impl Serialize for Calibration {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for kind in Kind::ALL {
            map.serialize_entry(&kind, &self.cost(kind))?;
        }
        map.serialize_entry("run", &self.run)?;
        map.end()
    }
}
