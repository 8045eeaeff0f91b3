//! The order of errors that scatter.
//!
//! Off the nodes an error is c(θ)·d^p with a coefficient that depends on the break's place θ in its segment,
//! which a ladder of doublings samples once a level: its pairwise orders scatter although p is well defined.
//! So each level here is a run of neighbouring n, in which θ takes many values, and has the root mean
//! square of their errors. It is within a factor of 4 of the largest of 16, so that both have the same
//! order, and depends far less on which θ occur.

use super::Place;
use crate::convergence::line::least_squares;
use crate::convergence::{FLOOR_MARGIN, MAX_HALF_WIDTH, Sample, Verdict, serialize_float};
use crate::method::Expected;
use crate::real::{MpfrReal, Real};
use rug::Float;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Where the levels start.
pub const STARTS: [u64; 6] = [64, 128, 256, 512, 1024, 2048];

/// Most numbers of segments a level: more than the break has places in its segment on a node or off the
/// nodes, and many where it moves.
fn most_numbers(place: Place) -> usize {
    match place {
        Place::OnNode => 2,
        Place::OffNodes => 4,
        Place::Moving => 16,
    }
}

/// Fewest levels that an order is read from.
const MIN_LEVELS: usize = 4;

/// How many times what the finer levels change the slope is left to drift: for a bias that halves from level
/// to level twice would be just enough.
const DRIFT: f64 = 3.0;

/// No interval is narrower: sixteen places leave a mean square uncertain by some 10 %, which over five
/// doublings may be as much of an order, and a t-interval of six levels can be narrow by chance.
const RESOLUTION: f64 = 0.05;

/// The order settles within a few rounds; each takes off all but a small part of what is missing.
const ROUNDS: usize = 30;

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
    (start..2 * start)
        .filter(suits)
        .take(most_numbers(place))
        .collect()
}

/// The errors at neighbouring numbers of segments.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Level {
    /// Where the level starts.
    pub start: u64,
    /// The number of segments that has the largest error.
    pub n: u64,
    /// That error.
    #[serde(serialize_with = "serialize_float")]
    pub error: Float,
    /// The largest floor.
    #[serde(serialize_with = "serialize_float")]
    pub floor: Float,
    /// (log₂ n, log₂|error|) of all of them.
    #[serde(skip)]
    pub points: Vec<(f64, f64)>,
}

/// The order measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The order; `None` where errors are 0 or not finite.
    pub order: Option<f64>,
    /// Half of its interval.
    pub half_width: Option<f64>,
    /// What that says of theory.
    pub verdict: Verdict,
}

/// The level that starts at `start`, of the samples that belong to it; an error that is not finite is the
/// largest of all.
#[must_use]
pub fn level(place: Place, start: u64, samples: &[Sample]) -> Option<Level> {
    let numbers = numbers(place, start);
    let own = || {
        let own = |sample: &Sample| sample.n.is_some_and(|n| numbers.contains(&n));
        samples.iter().filter(move |sample| own(sample))
    };
    let worst = own().reduce(|a, b| {
        let finite = a.error.is_finite();
        let larger = finite && (!b.error.is_finite() || log2(&b.error) > log2(&a.error));
        if larger { b } else { a }
    })?;
    let floor = own()
        .map(|sample| &sample.floor)
        .reduce(|a, b| if b > a { b } else { a })?;
    Some(Level {
        start,
        n: worst.n?,
        error: worst.error.clone(),
        floor: floor.clone(),
        points: own()
            .filter_map(|sample| Some(((sample.n? as f64).log2(), log2(&sample.error))))
            .collect(),
    })
}

/// The order p at which the root mean squares of |error|·nᵖ are level, found by least squares again and again.
/// Half of the interval is the larger of the 95 % t-interval of the slope, which covers the scatter, and thrice
/// what the slope changes over the finer levels (one more than half), which covers the drift of errors
/// that are not asymptotic yet; it is at least 0.05.
///
/// The verdicts are those of a [`fit`](crate::convergence::fit()), by the same widest half-width.
#[must_use]
pub fn judge(levels: &[Level], expected: Expected) -> Measured {
    let alone = |verdict| Measured {
        order: None,
        half_width: None,
        verdict,
    };
    if levels.iter().any(|level| !level.error.is_finite()) {
        return alone(Verdict::NotFinite);
    }
    let at_floor = |level: &Level| {
        let margin = Float::with_val(64, &level.floor * FLOOR_MARGIN);
        level.error.clone().abs() <= margin
    };
    if levels.len() < MIN_LEVELS {
        return alone(Verdict::TooFewLevels);
    }
    if levels.iter().any(at_floor) {
        let exact = expected == Expected::Exact && levels.iter().all(at_floor);
        return alone(if exact {
            Verdict::Exact
        } else {
            Verdict::FloorLimited
        });
    }
    match settle(levels) {
        Some((order, half_width)) => Measured {
            order: Some(order),
            half_width: Some(half_width),
            verdict: compare(order, half_width, expected),
        },
        None => alone(Verdict::PreAsymptotic),
    }
}

/// The order and half of its interval.
fn settle(levels: &[Level]) -> Option<(f64, f64)> {
    let freedom = levels.len().checked_sub(2)? as f64;
    let quantile = StudentsT::new(0.0, 1.0, freedom).ok()?.inverse_cdf(0.975);
    let mut order = 0.0;
    let mut half_width = f64::INFINITY;
    for _ in 0..ROUNDS {
        let points: Vec<_> = levels.iter().map(|level| level.point(order)).collect();
        let all = least_squares(&points)?;
        let fine = least_squares(points.get(points.len() / 2 - 1..)?)?;
        order -= all.slope;
        half_width = (quantile * all.slope_error).max(DRIFT * (fine.slope - all.slope).abs());
    }
    let half_width = half_width.max(RESOLUTION);
    (order.is_finite() && half_width.is_finite()).then_some((order, half_width))
}

impl Level {
    /// Where the level starts and the root mean square of |error|·nᵖ, as logarithms, with weight 1.
    fn point(&self, order: f64) -> (f64, f64, f64) {
        let start = (self.start as f64).log2();
        let scaled = |&(n, error): &(f64, f64)| error + order * n;
        let largest = self
            .points
            .iter()
            .map(scaled)
            .fold(f64::NEG_INFINITY, f64::max);
        let squares: f64 = self
            .points
            .iter()
            .map(|point| (2.0 * (scaled(point) - largest)).exp2())
            .sum();
        let mean_square = squares / self.points.len() as f64;
        (start, largest + mean_square.log2() / 2.0, 1.0)
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
