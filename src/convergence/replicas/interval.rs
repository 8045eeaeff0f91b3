//! What resampling whole replicas says of logarithms of standard deviations.

use super::contrast::Contrast;
use super::moments::mean_and_deviation;
use super::{BELIEVED, Replicas};
use crate::convergence::bootstrap::{Resampler, quantile};
use statrs::distribution::{ContinuousCDF, Normal, StudentsT};
use std::f64::consts::LN_2;

/// Bootstrap resamples: the outer 0.05 % on each side are then ten resamples.
const RESAMPLES: usize = 20_000;
/// Confidence of the intervals.
pub(super) const CONFIDENCE: f64 = 0.999;

/// log₂ s of every level: as measured, and in every resample.
pub(super) struct Resampled {
    pub(super) measured: Vec<f64>,
    resamples: Vec<Vec<f64>>,
    replicas: usize,
}

impl Resampled {
    pub(super) fn new(levels: &[Replicas], seed: u64) -> Self {
        let replicas = levels.first().map_or(0, |level| level.errors.len());
        let mut resampler = Resampler::new(seed);
        let mut chosen = vec![0; replicas];
        let resamples = (0..RESAMPLES).map(|_| {
            resampler.draw(&mut chosen);
            let of = |level: &Replicas| {
                let errors = chosen.iter().map(|r| level.errors[*r]);
                mean_and_deviation(errors).1.log2()
            };
            levels.iter().map(of).collect()
        });
        let measured = levels.iter().map(|level| {
            let (_, deviation) = mean_and_deviation(level.errors.iter().copied());
            deviation.log2()
        });
        Resampled {
            measured: measured.collect(),
            resamples: if levels.is_empty() {
                Vec::new()
            } else {
                resamples.collect()
            },
            replicas,
        }
    }

    /// How many standard errors a contrast is away from 0.
    pub(super) fn significance(&self, contrast: &Contrast) -> f64 {
        let values = self.values(contrast);
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let squares: f64 = values.iter().map(|v| (v - mean).powi(2)).sum();
        let deviation = widening(self.replicas) * (squares / count).sqrt();
        let believed = BELIEVED / LN_2 * contrast.norm();
        contrast.value(&self.measured).abs() / deviation.hypot(believed)
    }

    /// A contrast with the ends of its interval: percentiles of the resamples, spread about it as a t-distribution of R − 1 degrees
    /// of freedom is wider than a normal one, times √(R/(R − 1)).
    pub(super) fn interval(&self, contrast: &Contrast) -> Option<(f64, f64, f64)> {
        let mut values = self.values(contrast);
        values.sort_by(f64::total_cmp);
        let tail = (1.0 - CONFIDENCE) / 2.0;
        let (low, high) = (quantile(&values, tail)?, quantile(&values, 1.0 - tail)?);
        let center = contrast.value(&self.measured);
        let wider = widening(self.replicas);
        let normal = Normal::new(0.0, 1.0).ok()?.inverse_cdf(1.0 - tail);
        let believed = normal * BELIEVED / LN_2 * contrast.norm();
        let away = |end: f64| (wider * end.max(0.0)).hypot(believed);
        Some((
            center,
            center - away(center - low),
            center + away(high - center),
        ))
    }

    fn values(&self, contrast: &Contrast) -> Vec<f64> {
        let values = self.resamples.iter().map(|one| contrast.value(one));
        values.filter(|value| value.is_finite()).collect()
    }
}

/// By how much intervals of R replicas are wider than those of many.
pub(super) fn widening(replicas: usize) -> f64 {
    let replicas = replicas as f64;
    let tail = (1.0 - CONFIDENCE) / 2.0;
    let t = StudentsT::new(0.0, 1.0, replicas - 1.0).map(|t| t.inverse_cdf(1.0 - tail));
    let normal = Normal::new(0.0, 1.0).map(|normal| normal.inverse_cdf(1.0 - tail));
    match (t, normal) {
        (Ok(t), Ok(normal)) => t / normal * (replicas / (replicas - 1.0)).sqrt(),
        _ => f64::INFINITY,
    }
}
