//! Means, standard deviations, and whether a mean is 0 by chance.

use super::{LevelMoments, Replicas};
use crate::convergence::FLOOR_MARGIN;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// How often one of a channel's means passes for significant where there is no bias and errors are normal: so rarely that it is
/// no more than 10⁻⁴ with uniform errors too, the t of which has heavier tails.
const FALSE_ALARMS: f64 = 3e-5;

/// Mean and standard deviation. Equal errors have deviation 0 exactly.
pub(super) fn mean_and_deviation(errors: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = errors.clone().count() as f64;
    let first = errors.clone().next().unwrap_or(0.0);
    let shift = errors.clone().map(|e| e - first).sum::<f64>() / count;
    let squares: f64 = errors.map(|e| (e - first - shift).powi(2)).sum();
    (first + shift, (squares / (count - 1.0)).sqrt())
}

/// The moments of every level.
#[must_use]
pub fn of(levels: &[Replicas], replicas: usize) -> Vec<LevelMoments> {
    let count = replicas as f64;
    let raw: Vec<(f64, f64)> = levels
        .iter()
        .map(|level| mean_and_deviation(level.errors.iter().copied()))
        .collect();
    let skewness = skewness(levels, &raw);
    let critical = critical(levels.len(), count);
    let mut floor = 0.0_f64;
    let mut above = true;
    let moments = levels.iter().zip(raw).map(|(level, (mean, deviation))| {
        floor = floor.max(level.floor);
        let margin = f64::from(FLOOR_MARGIN) * floor;
        above = above && deviation > margin;
        LevelMoments {
            n: level.n,
            step: level.step,
            mean,
            deviation,
            standard_error: deviation / count.sqrt(),
            above_floor: above,
            biased: mean.abs() > margin,
        }
    });
    let mut moments: Vec<LevelMoments> = moments.collect();
    let errors = believable_errors(&moments, levels);
    for (level, error) in moments.iter_mut().zip(errors) {
        let t = level.mean / error;
        // Without any scatter no mean is one by chance.
        let significant =
            error == 0.0 || t.abs() > critical && unskewed(t, skewness, count).abs() > critical;
        level.biased = level.biased && significant;
    }
    moments
}

/// The standard errors of means. Replicas that agree down to the floor where those of other levels do not have missed
/// what scatters, all of them by chance: their mean is known no better than that of the level before.
pub(super) fn believable_errors(moments: &[LevelMoments], levels: &[Replicas]) -> Vec<f64> {
    let mut floor = 0.0_f64;
    let own = moments.iter().zip(levels).map(|(moments, level)| {
        floor = floor.max(level.floor);
        let scatters = moments.deviation > f64::from(FLOOR_MARGIN) * floor;
        scatters.then_some(moments.standard_error)
    });
    let own: Vec<Option<f64>> = own.collect();
    let first = own.iter().flatten().next().copied();
    let mut last = first;
    let believable = own.iter().zip(moments).map(|(own, moments)| {
        last = own.or(last);
        last.unwrap_or(moments.standard_error)
    });
    believable.collect()
}

/// The t that any of so many levels exceeds without a bias by chance.
fn critical(levels: usize, replicas: f64) -> f64 {
    let tail = FALSE_ALARMS / levels as f64 / 2.0;
    let t = StudentsT::new(0.0, 1.0, replicas - 1.0).map(|t| t.inverse_cdf(1.0 - tail));
    t.unwrap_or(f64::INFINITY)
}

/// Mean of ((e − m)/s)³ over all levels that scatter: of one level alone it is hardly known.
fn skewness(levels: &[Replicas], moments: &[(f64, f64)]) -> f64 {
    let scattering = levels.iter().zip(moments).filter(|(_, (_, s))| *s > 0.0);
    let cubes = scattering.flat_map(|(level, (mean, deviation))| {
        level
            .errors
            .iter()
            .map(move |e| ((e - mean) / deviation).powi(3))
    });
    let (sum, count) = cubes.fold((0.0, 0.0), |(sum, count), cube| (sum + cube, count + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

/// t without the skewness that it has from skewed errors: t + γt²/(3√R) + γ²t³/(27R) + γ/(6√R) (Hall 1992, On the removal
/// of skewness by transformation, J. R. Statist. Soc. B 54).
fn unskewed(t: f64, skewness: f64, replicas: f64) -> f64 {
    let a = skewness / replicas.sqrt();
    t + a * t * t / 3.0 + a * a * t.powi(3) / 27.0 + a / 6.0
}
