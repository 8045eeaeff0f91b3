//! Orders over all levels, with bootstrap intervals.

use super::input::MIN_LEVELS;
use super::{LevelMoments, OrderInterval, Replicas};
use crate::convergence::bootstrap::{Resampler, quantile};
use crate::convergence::line::{Line, least_squares};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// Bootstrap resamples: the outer 0.05 % on each side are then ten resamples.
const RESAMPLES: usize = 20_000;
/// Confidence of the intervals.
const CONFIDENCE: f64 = 0.999;

/// Mean and standard deviation of the replicas chosen. Equal errors have deviation 0 exactly.
pub(super) fn mean_and_deviation(errors: &[f64], chosen: &[usize]) -> (f64, f64) {
    let count = chosen.len() as f64;
    let first = chosen.first().map_or(0.0, |r| errors[*r]);
    let shift = chosen.iter().map(|r| errors[*r] - first).sum::<f64>() / count;
    let squares: f64 = chosen
        .iter()
        .map(|r| (errors[*r] - first - shift).powi(2))
        .sum();
    (first + shift, (squares / (count - 1.0)).sqrt())
}

pub(super) type Intervals = (Option<OrderInterval>, Option<OrderInterval>);

/// Both orders with their bootstrap intervals.
pub(super) fn intervals(
    levels: &[Replicas],
    moments: &[LevelMoments],
    replicas: usize,
    seed: u64,
) -> Intervals {
    let scatter: Vec<usize> = (0..levels.len())
        .filter(|i| moments[*i].above_floor)
        .collect();
    let biased: Vec<usize> = (0..levels.len())
        .filter(|i| moments[*i].above_floor && moments[*i].biased)
        .collect();
    let line = |which: &[usize], value: &dyn Fn(usize) -> (f64, f64)| {
        if which.len() < MIN_LEVELS {
            return None;
        }
        let points: Vec<(f64, f64, f64)> = which
            .iter()
            .map(|i| {
                let (magnitude, weight) = value(*i);
                (levels[*i].step.log2(), magnitude.abs().log2(), weight)
            })
            .collect();
        least_squares(&points)
    };
    let weight = |i: usize| (moments[i].mean / moments[i].standard_error).powi(2);
    let deviation = line(&scatter, &|i| (moments[i].deviation, 1.0));
    let bias = line(&biased, &|i| (moments[i].mean, weight(i)));

    let mut resampler = Resampler::new(seed);
    let mut chosen = vec![0; replicas];
    let mut resampled = vec![(0.0, 0.0); levels.len()];
    let (mut deviations, mut biases) = (Vec::new(), Vec::new());
    for _ in 0..RESAMPLES {
        resampler.draw(&mut chosen);
        for (target, level) in resampled.iter_mut().zip(levels) {
            *target = mean_and_deviation(&level.errors, &chosen);
        }
        deviations.extend(line(&scatter, &|i| (resampled[i].1, 1.0)).map(|l| l.slope));
        biases.extend(line(&biased, &|i| (resampled[i].0, weight(i))).map(|l| l.slope));
    }
    let interval = |line: Option<Line>, slopes: Vec<f64>, levels: usize| {
        let line = line?;
        let (low, high) = ends(line.slope, slopes, replicas)?;
        Some(OrderInterval {
            order: line.slope,
            low,
            high,
            log2_constant: line.intercept,
            levels,
        })
    };
    (
        interval(deviation, deviations, scatter.len()),
        interval(bias, biases, biased.len()),
    )
}

/// Ends of the interval: percentiles of the bootstrap slopes, spread about the order itself as a
/// t-distribution of R − 1 degrees of freedom is wider than a normal one, times √(R/(R − 1)).
fn ends(order: f64, mut slopes: Vec<f64>, replicas: usize) -> Option<(f64, f64)> {
    slopes.retain(|s| s.is_finite());
    slopes.sort_by(f64::total_cmp);
    let tail = (1.0 - CONFIDENCE) / 2.0;
    let (low, high) = (quantile(&slopes, tail)?, quantile(&slopes, 1.0 - tail)?);
    let replicas = replicas as f64;
    let t = StudentsT::new(0.0, 1.0, replicas - 1.0).ok()?;
    let normal = Normal::new(0.0, 1.0).ok()?;
    let wider = t.inverse_cdf(1.0 - tail) / normal.inverse_cdf(1.0 - tail);
    let wider = wider * (replicas / (replicas - 1.0)).sqrt();
    Some((
        order - wider * (order - low).max(0.0),
        order + wider * (high - order).max(0.0),
    ))
}
