//! The order of the largest errors.
//!
//! Off the nodes an error is c(θ)·d^p with a coefficient that depends on the break's place θ in its segment,
//! which a ladder of doublings samples once a level: its pairwise orders scatter although p is well defined.
//! So each level here is a run of neighbouring n, in which θ takes many values; the largest |error| among
//! them, at the step where it occurs, is a point of the envelope max c(θ)·d^p.

use super::Place;
use crate::convergence::line::least_squares;
use crate::convergence::{FLOOR_MARGIN, MAX_HALF_WIDTH, Sample, Verdict, serialize_float};
use crate::method::Expected;
use crate::real::{MpfrReal, Real};
use rug::Float;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Where the levels of the envelope start.
pub const STARTS: [u64; 6] = [64, 128, 256, 512, 1024, 2048];

/// Most numbers of segments a level.
pub const NUMBERS: usize = 16;

/// The numbers of segments of the level that starts at `start`: the first from there on, below twice
/// as much, that suit Boole's rule and the place.
#[must_use]
pub fn numbers(place: Place, start: u64) -> Vec<u64> {
    // D/2 is on a node of Boole's groups of four for multiples of 8, D/3 of no rule but for those of 3.
    let suits = |n: &u64| match place {
        Place::OnNode => n.is_multiple_of(8),
        Place::OffNodes => n.is_multiple_of(4) && !n.is_multiple_of(3),
        Place::Moving => n.is_multiple_of(4),
    };
    (start..2 * start).filter(suits).take(NUMBERS).collect()
}

/// The largest error of a level.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// Where the level starts.
    pub start: u64,
    /// The number of segments that has the largest error.
    pub n: u64,
    /// That error.
    #[serde(serialize_with = "serialize_float")]
    pub error: Float,
    /// The floor there.
    #[serde(serialize_with = "serialize_float")]
    pub floor: Float,
}

/// The order of an envelope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Envelope {
    /// The order; `None` where errors are 0 or not finite.
    pub order: Option<f64>,
    /// Half of its interval.
    pub half_width: Option<f64>,
    /// What that says of theory.
    pub verdict: Verdict,
}

/// The largest error of the level that starts at `start`, among the samples that belong to it. One that
/// is not finite is the largest of all.
pub(super) fn worst(place: Place, start: u64, samples: &[Sample]) -> Option<Worst> {
    let numbers = numbers(place, start);
    samples
        .iter()
        .filter_map(|sample| Some((sample.n.filter(|n| numbers.contains(n))?, sample)))
        .reduce(|a, b| {
            let larger =
                !a.1.error.is_nan() && (b.1.error.is_nan() || log2(&b.1.error) > log2(&a.1.error));
            if larger { b } else { a }
        })
        .map(|(n, sample)| Worst {
            start,
            n,
            error: sample.error.clone(),
            floor: sample.floor.clone(),
        })
}

/// Least squares of log|error| on log d over all levels. Half of the interval is the largest of the 95 %
/// t-interval of the slope, which covers the scatter of the envelope, and twice what the finer half of the
/// levels (one more than half) has another slope, which covers the drift of errors that are not
/// asymptotic yet.
///
/// The verdicts are those of a [`fit`](crate::convergence::fit()), by the same widest half-width.
pub fn judge(worst: &[Worst], expected: Expected) -> Envelope {
    let verdict_alone = |verdict| Envelope {
        order: None,
        half_width: None,
        verdict,
    };
    if worst.iter().any(|w| !w.error.is_finite()) {
        return verdict_alone(Verdict::NotFinite);
    }
    let at_floor =
        |w: &Worst| w.error.clone().abs() <= Float::with_val(64, &w.floor * FLOOR_MARGIN);
    if worst.iter().any(at_floor) {
        let all = worst.iter().all(at_floor) && expected == Expected::Exact;
        return verdict_alone(if all {
            Verdict::Exact
        } else {
            Verdict::FloorLimited
        });
    }
    if worst.len() < 4 {
        return verdict_alone(Verdict::TooFewLevels);
    }
    let points: Vec<(f64, f64, f64)> = worst
        .iter()
        .map(|w| (-(w.n as f64).log2(), log2(&w.error), 1.0))
        .collect();
    let fine = &points[points.len() / 2 - 1..];
    let (Some(all), Some(fine), Ok(student)) = (
        least_squares(&points),
        least_squares(fine),
        StudentsT::new(0.0, 1.0, (points.len() - 2) as f64),
    ) else {
        return verdict_alone(Verdict::TooFewLevels);
    };
    let scatter = student.inverse_cdf(0.975) * all.slope_error;
    let half_width = scatter.max(2.0 * (fine.slope - all.slope).abs());
    Envelope {
        order: Some(all.slope),
        half_width: Some(half_width),
        verdict: compare(all.slope, half_width, expected),
    }
}

fn compare(order: f64, half_width: f64, expected: Expected) -> Verdict {
    match expected {
        _ if half_width > MAX_HALF_WIDTH => Verdict::PreAsymptotic,
        Expected::Unknown => Verdict::Fitted,
        Expected::Blind { .. } => Verdict::Blind,
        Expected::Order(p) if (p - order).abs() <= half_width => Verdict::Confirmed,
        Expected::Order(p) if p < order => Verdict::TooHigh,
        Expected::Order(_) | Expected::Exact => Verdict::TooLow,
    }
}

fn log2(error: &Float) -> f64 {
    MpfrReal::from(error.clone()).log2_abs()
}
