//! The order of the bias: of b·dᵝ, from all means and their standard errors.

use super::interval::{CONFIDENCE, widening};
use super::moments::believable_errors;
use super::{BELIEVED, LevelMoments, OrderInterval, Replicas};
use crate::convergence::FLOOR_MARGIN;
use crate::convergence::verdict::NO_CONVERGENCE;
use crate::convergence::window::MIN_WINDOW;
use statrs::distribution::{ChiSquared, ContinuousCDF};
use std::ops::RangeInclusive;

/// Levels do not keep to one order where they would by chance in one of a hundred runs.
const UNLIKELY: f64 = 0.01;
/// Orders looked at, and how closely at first.
const ORDERS: RangeInclusive<i32> = -400..=1200;
const ORDERS_IN_ONE: f64 = 100.0;
/// Halvings to the end of an interval: to 1e-8.
const HALVINGS: usize = 20;

/// What the means say of their order.
pub(super) struct Bias {
    /// The order of the run of levels that keeps to one, where a mean is significant.
    pub(super) interval: Option<OrderInterval>,
    /// Of the finest four levels alone.
    finest: Option<OrderInterval>,
    /// A mean of the finest four levels is significant.
    pub(super) seen: bool,
}

impl Bias {
    /// A bias is seen where it matters, and may be of order 0 for all that is known.
    pub(super) fn may_stay(&self) -> bool {
        self.seen && self.interval.is_none_or(|i| i.low <= NO_CONVERGENCE)
    }

    /// It is seen where it matters and falls more slowly than that: over its run and over the finest levels alone.
    pub(super) fn is_below(&self, order: f64) -> bool {
        let below = |i: Option<OrderInterval>| i.is_some_and(|i| i.high < order);
        self.seen && below(self.interval) && below(self.finest)
    }
}

/// One mean.
struct Mean {
    /// ln(d/d of the finest level).
    logarithm: f64,
    value: f64,
    /// 1/σ².
    weight: f64,
}

pub(super) fn of(moments: &[LevelMoments], levels: &[Replicas], replicas: usize) -> Bias {
    let finest_step = moments.last().map_or(1.0, |level| level.step);
    let mut floor = 0.0_f64;
    let means: Vec<Mean> = moments
        .iter()
        .zip(levels)
        .zip(believable_errors(moments, levels))
        .map(|((moments, level), error)| {
            floor = floor.max(level.floor);
            // What stands three of these above 0 stands above the floor.
            let rounding = f64::from(FLOOR_MARGIN) / 3.0 * floor;
            let sigma = error.hypot(rounding);
            let sigma = sigma.hypot(BELIEVED * moments.mean);
            Mean {
                logarithm: (moments.step / finest_step).ln(),
                value: moments.mean,
                weight: if sigma > 0.0 { sigma.powi(-2) } else { 0.0 },
            }
        })
        .collect();
    let most = means.len().saturating_sub(MIN_WINDOW);
    let run = (0..=most)
        .map(|first| &means[first..])
        .filter(|run| run.len() >= MIN_WINDOW)
        .find_map(|run| power(run, replicas, finest_step));
    let is_seen = |levels: usize| moments.iter().rev().take(levels).any(|level| level.biased);
    Bias {
        interval: run.filter(|run| is_seen(run.levels)),
        finest: means
            .get(most..)
            .and_then(|run| power(run, replicas, finest_step)),
        seen: is_seen(MIN_WINDOW),
    }
}

/// The order that a run keeps to, if it does.
fn power(run: &[Mean], replicas: usize, finest_step: f64) -> Option<OrderInterval> {
    let chi = |freedom: f64, level: f64| Some(ChiSquared::new(freedom).ok()?.inverse_cdf(level));
    let order = |index: i32| f64::from(index) / ORDERS_IN_ONE;
    let sums: Vec<(f64, f64)> = ORDERS
        .map(|index| (order(index), squares(run, order(index)).0))
        .filter(|(_, sum)| sum.is_finite())
        .collect();
    let best = sums.iter().copied().min_by(|a, b| a.1.total_cmp(&b.1))?;
    // A squared t of R − 1 degrees of freedom is larger than 1 in the mean.
    let spread = (replicas as f64 - 1.0) / (replicas as f64 - 3.0);
    if best.1 > spread * chi(run.len() as f64 - 2.0, 1.0 - UNLIKELY)? {
        return None;
    }
    let limit = best.1 + chi(1.0, CONFIDENCE)? * widening(replicas).powi(2);
    let beyond = |(_, sum): &&(f64, f64)| *sum > limit;
    let end = |outside: Option<&(f64, f64)>, open: f64| {
        outside.map_or(open, |outside| {
            let (mut outside, mut inside) = (outside.0, best.0);
            for _ in 0..HALVINGS {
                let middle = f64::midpoint(outside, inside);
                if squares(run, middle).0 > limit {
                    outside = middle;
                } else {
                    inside = middle;
                }
            }
            outside
        })
    };
    let (_, constant) = squares(run, best.0);
    Some(OrderInterval {
        order: best.0,
        low: end(
            sums.iter().filter(|s| s.0 < best.0).rev().find(beyond),
            f64::NEG_INFINITY,
        ),
        high: end(
            sums.iter().filter(|s| s.0 > best.0).find(beyond),
            f64::INFINITY,
        ),
        log2_constant: constant.abs().log2() - best.0 * finest_step.log2(),
        levels: run.len(),
    })
}

/// Σ((m − b·dᵝ)/σ)² with the best b for that β, and b, in units of the finest step.
fn squares(run: &[Mean], order: f64) -> (f64, f64) {
    let shape = |mean: &Mean| (order * mean.logarithm).exp();
    let (above, below) = run.iter().fold((0.0, 0.0), |(above, below), mean| {
        let shape = shape(mean);
        (
            above + mean.weight * mean.value * shape,
            below + mean.weight * shape * shape,
        )
    });
    let constant = above / below;
    let left = |mean: &Mean| mean.weight * (mean.value - constant * shape(mean)).powi(2);
    (run.iter().map(left).sum(), constant)
}
