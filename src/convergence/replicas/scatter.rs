//! The order of the scatter: which levels belong to it, and what else they could be read as.

use super::contrast::Contrast;
use super::interval::Resampled;
use super::{OrderInterval, Replicas};
use crate::convergence::window::MIN_WINDOW;

/// A run of levels is bent where its curvature is so many standard errors away from 0.
const BENT: f64 = 2.0;
/// An end of a run does not belong to it where it is so many standard errors off the line of the others.
const OFF: f64 = 2.5;

/// What the standard deviations say of their order.
pub(super) struct Scatter {
    /// The order of the run of levels that keeps to one.
    pub(super) interval: Option<OrderInterval>,
    /// The finest four levels alone.
    pub(super) finest: Option<(f64, f64)>,
    /// All levels with a term of the next order, and as a parabola at its fine end.
    others: Vec<(f64, f64)>,
}

impl Scatter {
    /// Every reading lies below an order.
    pub(super) fn is_below(&self, order: f64) -> bool {
        self.interval.is_some_and(|i| i.high < order) && self.readings().all(|(_, h)| h < order)
    }

    /// Every reading lies above an order.
    pub(super) fn is_above(&self, order: f64) -> bool {
        self.interval.is_some_and(|i| i.low > order) && self.readings().all(|(l, _)| l > order)
    }

    fn readings(&self) -> impl Iterator<Item = (f64, f64)> {
        self.finest.into_iter().chain(self.others.iter().copied())
    }
}

/// Of levels above the floor.
pub(super) fn of(levels: &[Replicas], resampled: &Resampled) -> Scatter {
    let steps: Vec<f64> = levels.iter().map(|level| level.step).collect();
    let logs = |run: &[f64]| run.iter().map(|step| step.log2()).collect::<Vec<f64>>();
    let run = (0..(steps.len() + 1).saturating_sub(MIN_WINDOW))
        .map(|first| &steps[first..])
        .find(|run| keeps_to_a_line(run, resampled));
    let interval = run.and_then(|run| {
        let (order, low, high) = resampled.interval(&slope(run, &[])?)?;
        let mean = |values: &[f64]| values.iter().sum::<f64>() / run.len() as f64;
        let last = steps.len() - run.len();
        let log2_constant = mean(resampled.measured.get(last..)?) - order * mean(&logs(run));
        Some(OrderInterval {
            order,
            low,
            high,
            log2_constant,
            levels: run.len(),
        })
    });
    let reading = |run: &[f64], others: &[Vec<f64>]| {
        let (_, low, high) = resampled.interval(&slope(run, others)?)?;
        Some((low, high))
    };
    let squares = |x: &[f64]| x.iter().map(|x| x * x).collect::<Vec<f64>>();
    let next_order = steps.clone();
    let parabola = squares(&logarithms(&steps));
    Scatter {
        interval,
        finest: steps
            .len()
            .checked_sub(MIN_WINDOW)
            .and_then(|first| reading(&steps[first..], &[])),
        others: [next_order, parabola]
            .into_iter()
            .filter_map(|bend| reading(&steps, &[bend]))
            .collect(),
    }
}

/// log₂ of the steps, 0 at the finest: the slope of a parabola is that at its fine end.
fn logarithms(steps: &[f64]) -> Vec<f64> {
    let finest = steps.last().copied().unwrap_or(1.0);
    steps.iter().map(|step| (step / finest).log2()).collect()
}

fn slope(steps: &[f64], others: &[Vec<f64>]) -> Option<Contrast> {
    Contrast::of(&logarithms(steps), others)
}

/// The test of fit of a run.
fn keeps_to_a_line(run: &[f64], resampled: &Resampled) -> bool {
    let x = logarithms(run);
    let squares: Vec<f64> = x.iter().map(|x| x * x).collect();
    let off = |index: usize| {
        let mut one = vec![0.0; run.len()];
        if let Some(own) = one.get_mut(index) {
            *own = 1.0;
        }
        one
    };
    let within = |own: &[f64], most: f64| {
        let contrast = Contrast::of(own, std::slice::from_ref(&x));
        contrast.is_none_or(|contrast| resampled.significance(&contrast) <= most)
    };
    within(&squares, BENT) && within(&off(0), OFF) && within(&off(run.len() - 1), OFF)
}
