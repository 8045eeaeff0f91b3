//! Standard errors that a method reports of its own answers, beside their scatter.

use super::interval::widening;
use super::moments::mean_and_deviation;
use super::{MIN_REPLICAS, Replicas};
use crate::convergence::bootstrap::Resampler;
use serde::Serialize;

/// A standard error within this factor of the scatter is one: estimates from few samples are off by some ten per cent.
const TOLERATED: f64 = 1.5;
/// Bootstrap resamples of a standard deviation.
const RESAMPLES: usize = 2_000;
/// Standard deviations of an interval that misses one in 10 000 channels.
const FAR: f64 = 3.89;
/// So many of the finest levels: at coarse ones, estimates may be as pre-asymptotic as errors.
const FINEST: usize = 4;

/// Reported standard errors as a multiple of the scatter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
pub struct ReportedError {
    /// √(mean of reported²)/s, the geometric mean over the finest levels; NaN where one reported is negative or no number.
    #[cfg_attr(feature = "studies", schemars(with = "Option<f64>"))]
    pub ratio: f64,
    /// Lower end of its 99.99 % interval.
    #[cfg_attr(feature = "studies", schemars(with = "Option<f64>"))]
    pub low: f64,
    /// Upper end.
    #[cfg_attr(feature = "studies", schemars(with = "Option<f64>"))]
    pub high: f64,
}

impl ReportedError {
    /// The whole interval lies beyond a factor of 1½: what is reported is not the scatter.
    #[must_use]
    pub fn is_wrong(&self) -> bool {
        !self.ratio.is_finite() || self.high < 1.0 / TOLERATED || self.low > TOLERATED
    }
}

/// Compares standard errors, of every level one a replica, with the scatter of the finest four levels above the floor, by
/// resampling both together; `None` where fewer than four scatter, or replicas are too few or not all reported.
#[must_use]
pub fn reported_error(
    levels: &[Replicas],
    reported: &[Vec<f64>],
    seed: u64,
) -> Option<ReportedError> {
    let mut floor = 0.0_f64;
    let usable = levels.iter().zip(reported).take_while(|(level, _)| {
        floor = floor.max(level.floor);
        let (_, deviation) = mean_and_deviation(level.errors.iter().copied());
        deviation > f64::from(crate::convergence::FLOOR_MARGIN) * floor
    });
    let usable: Vec<(&Replicas, &Vec<f64>)> = usable.collect();
    let finest = usable.get(usable.len().checked_sub(FINEST)?..)?;
    let replicas = finest.first()?.0.errors.len();
    let complete = |(level, reported): &(&Replicas, &Vec<f64>)| {
        level.errors.len() == replicas && reported.len() == replicas
    };
    if replicas < MIN_REPLICAS || !finest.iter().all(complete) {
        return None;
    }
    let numbers = |(_, reported): &(&Replicas, &Vec<f64>)| {
        reported
            .iter()
            .all(|error| error.is_finite() && *error >= 0.0)
    };
    if !finest.iter().all(numbers) {
        let nan = f64::NAN;
        return Some(ReportedError {
            ratio: nan,
            low: nan,
            high: nan,
        });
    }
    let logarithm = |chosen: &[usize]| {
        let one = |(level, reported): &(&Replicas, &Vec<f64>)| {
            let (_, deviation) = mean_and_deviation(chosen.iter().map(|r| level.errors[*r]));
            let squares: f64 = chosen.iter().map(|r| reported[*r].powi(2)).sum();
            (squares / replicas as f64).sqrt().ln() - deviation.ln()
        };
        finest.iter().map(one).sum::<f64>() / finest.len() as f64
    };
    let all: Vec<usize> = (0..replicas).collect();
    let center = logarithm(&all);
    let mut resampler = Resampler::new(seed);
    let mut chosen = all;
    let values = (0..RESAMPLES).map(|_| {
        resampler.draw(&mut chosen);
        logarithm(&chosen)
    });
    let values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    // Nothing but zeros: there is no spread to tell.
    let spread = if values.is_empty() {
        0.0
    } else {
        mean_and_deviation(values.iter().copied()).1
    };
    let away = FAR * widening(replicas) * spread;
    Some(ReportedError {
        ratio: center.exp(),
        low: (center - away).exp(),
        high: (center + away).exp(),
    })
}
