//! The order of a deterministic method from its signed errors.

use super::Note;
use super::line::least_squares;
use super::sample::{Sample, log2_abs, serialize_float};
use super::verdict::{Estimate, Evidence, Trend, Verdict, judge, remark_missing_floor};
use super::window::{self, Window};
use crate::method::Expected;
use rug::Float;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::cmp::Ordering;

/// An error of at most this many floors is taken for roundoff.
pub const FLOOR_MARGIN: u32 = 30;

/// Two neighbouring levels with finite, nonzero errors.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Pair {
    /// Index of the coarser level; the finer one is the next.
    pub coarse: usize,
    /// ln|eᵢ/eᵢ₊₁| / ln(dᵢ/dᵢ₊₁).
    pub order: f64,
    /// Both levels stand above the floor.
    pub above_floor: bool,
    /// Both levels lie in the window.
    pub in_window: bool,
    /// The error changes sign between the two.
    pub sign_change: bool,
}

/// Where the roundoff floor ended the ladder.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FloorCut {
    /// Index of the first level dropped; everything finer is dropped too.
    pub level: usize,
    /// Its step.
    pub step: f64,
    /// The floor there: the largest of this level's and of all coarser ones.
    #[serde(serialize_with = "serialize_float")]
    pub floor: Float,
}

/// An order of accuracy with its interval, and what that says.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fit {
    /// What the errors say of the expectation.
    pub verdict: Verdict,
    /// The order p: fitted in the window; without a window, the last pairwise order above the floor.
    /// `None` with fewer than two usable levels.
    pub order: Option<f64>,
    /// Half-width of the order's interval. Without a window it is a spread, not an interval:
    /// the largest distance of the last three usable pairwise orders from the last, and at least
    /// twice that of the last two; for one pair alone, |p|.
    pub half_width: Option<f64>,
    /// log₂ c in |e| = c·dᵖ.
    pub log2_constant: Option<f64>,
    /// The levels the order was fitted in.
    pub window: Option<Window>,
    /// Largest floor of all levels; 0 where none is known.
    #[serde(serialize_with = "serialize_float")]
    pub floor: Float,
    /// Where the floor ended the ladder, if it did.
    pub cut: Option<FloorCut>,
    /// Pairwise orders, coarse to fine.
    pub pairs: Vec<Pair>,
    /// Remarks.
    pub notes: Vec<Note>,
}

/// Samples or an expectation that no fit can take.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// A step is not a positive number.
    #[error("step {step} of level {level} is not allowed (allowed: finite, above 0)")]
    Step {
        /// Index of the level.
        level: usize,
        /// The step.
        step: f64,
    },
    /// A step does not lie below the one before it.
    #[error(
        "step {step} of level {level} does not lie below the step {previous} before it (allowed: strictly decreasing steps)"
    )]
    NotDecreasing {
        /// Index of the level.
        level: usize,
        /// The step.
        step: f64,
        /// The step of the level before.
        previous: f64,
    },
    /// A floor is negative.
    #[error("floor {floor} of level {level} is negative (allowed: 0 where unknown, or above)")]
    NegativeFloor {
        /// Index of the level.
        level: usize,
        /// The floor, rounded to binary64.
        floor: f64,
    },
    /// The expected order is no number.
    #[error("expected order {order} is not allowed (allowed: finite numbers)")]
    Expectation {
        /// The order.
        order: f64,
    },
}

/// Fits |e| = c·dᵖ in the asymptotic window of a ladder, and judges it.
///
/// `samples` are ordered from coarse to fine; steps are in the units of the ray, errors and floors
/// in those of the radiance.
///
/// 1. The floor at a level is the running maximum of the floors up to it. The first level with
///    |e| ≤ 30·floor is dropped *and everything finer*: an exact zero always is. Levels above are usable.
/// 2. The window is the longest fine-side run of at least 4 usable levels whose pairwise orders
///    pᵢ agree with the last one within 0.02; if none, within 0.05; if none, within 0.1. At 0.1, orders
///    that drift one way by more than 0.05 in total are bias on the way to another order, and no window.
/// 3. Least squares of log|e| on log d in the window gives p̂, and the half-width is
///    max(95 % t-interval, max|pᵢ − p̂|, |p̂ − p_last| + 2Δ / min(r − 1, 1))
///    + (Σ floor/|e| over the last two levels) / ln r, plus the rounding of the logarithms themselves.
///    r is the last step ratio, and Δ the drift max(|p_last − p_prev|, |p_prev − p_before| / r): a relative
///    bias of order d shrinks by r from pair to pair, and roundoff may hide the last difference.
/// 4. The verdict follows the table at [`Verdict`].
///
/// The interval contained the true order of synthetic errors c·dᵖ(1 + a·d + b·d²) plus roundoff in more than
/// 99 % of the fits (`fit/coverage.rs` measures it: 99.2 % in binary32, 99.7 % in binary64).
///
/// It does not promise that a plateau is the last one: an order shows as far as the ladder reaches.
///
/// # Errors
///
/// [`FitError`] where steps are not positive and strictly decreasing, a floor is negative, or the
/// expected order is not finite. NaN and infinite errors are no input errors but a verdict.
pub fn fit(samples: &[Sample], expected: Option<Expected>) -> Result<Fit, FitError> {
    check(samples, expected)?;
    let floors = running_floors(samples);
    let finite = samples
        .iter()
        .all(|s| s.error.is_finite() && s.floor.is_finite());
    let at_floor: Vec<bool> = samples
        .iter()
        .zip(&floors)
        .map(|(s, floor)| is_at_floor(&s.error, floor))
        .collect();
    let usable = samples
        .iter()
        .zip(&at_floor)
        .take_while(|(s, at_floor)| s.error.is_finite() && !**at_floor)
        .count();
    let points: Vec<(f64, f64)> = samples
        .iter()
        .map(|s| (s.step.log2(), log2_abs(&s.error)))
        .collect();
    let mut pairs = pairwise(samples, &points, usable);
    let orders: Vec<f64> = pairs
        .iter()
        .filter(|p| p.above_floor)
        .map(|p| p.order)
        .collect();

    let found = window::find(&orders).map(|(count, tolerance)| Window {
        first: usable - 1 - count,
        last: usable - 1,
        coarsest_step: samples[usable - 1 - count].step,
        finest_step: samples[usable - 1].step,
        coarsest_n: samples[usable - 1 - count].n,
        finest_n: samples[usable - 1].n,
        tolerance,
    });
    let fitted = found.and_then(|w| regress(w, samples, &floors, &points, &orders));
    let window = found.filter(|_| fitted.is_some());
    for pair in &mut pairs {
        pair.in_window = window.is_some_and(|w| pair.coarse >= w.first && pair.coarse < w.last);
    }

    let cut = at_floor.iter().position(|at| *at).filter(|c| *c == usable);
    let risen = cut.and_then(|c| (c..samples.len()).find(|i| !at_floor[*i]));
    let ends_above = at_floor.last() == Some(&false);
    let evidence = Evidence {
        levels: samples.len(),
        finite,
        all_at_floor: at_floor.iter().all(|at| *at),
        cut: cut.is_some(),
        rises: risen.is_some(),
        rises_to_the_end: risen.is_some()
            && ends_above
            && Trend::of(finest_run(&points)) == Trend::Growing,
        trend: Trend::of(&points[..usable]),
        late_sign_changes: pairs
            .iter()
            .filter(|p| p.above_floor && p.sign_change && p.coarse + 4 >= usable)
            .count(),
        estimate: fitted.map(|f| Estimate {
            sign_change: pairs.iter().any(|p| p.in_window && p.sign_change),
            ..f.estimate
        }),
    };
    let verdict = judge(&evidence, expected);

    let (order, half_width, log2_constant) = match fitted {
        Some(f) => (
            Some(f.estimate.order),
            Some(f.estimate.half_width),
            Some(f.log2_constant),
        ),
        None => last_order(&orders, points[..usable].last()),
    };
    let mut notes = Vec::new();
    if let Some(pair) = window.and_then(|w| {
        let mut before = pairs.iter().rev().filter(|p| p.coarse < w.first);
        before.find(|p| p.sign_change)
    }) {
        notes.push(Note::SignChange {
            level: pair.coarse,
            step: samples[pair.coarse].step,
        });
    }
    if let Some(level) = risen {
        let step = samples[level].step;
        notes.push(Note::RisesBeyondCut { level, step });
    }
    let floor = floors.last().cloned().unwrap_or_else(|| Float::new(53));
    remark_missing_floor(verdict, !floor.is_zero(), &mut notes);
    Ok(Fit {
        verdict,
        order,
        half_width,
        log2_constant,
        window,
        cut: cut.map(|level| FloorCut {
            level,
            step: samples[level].step,
            floor: floors[level].clone(),
        }),
        floor,
        pairs,
        notes,
    })
}

/// Refuses what no verdict covers.
fn check(samples: &[Sample], expected: Option<Expected>) -> Result<(), FitError> {
    for (level, sample) in samples.iter().enumerate() {
        let step = sample.step;
        if !step.is_finite() || step <= 0.0 {
            return Err(FitError::Step { level, step });
        }
        if sample.floor < 0 {
            let floor = sample.floor.to_f64();
            return Err(FitError::NegativeFloor { level, floor });
        }
    }
    for (level, pair) in samples.windows(2).enumerate() {
        if pair[1].step >= pair[0].step {
            return Err(FitError::NotDecreasing {
                level: level + 1,
                step: pair[1].step,
                previous: pair[0].step,
            });
        }
    }
    match expected {
        Some(Expected::Order(order)) if !order.is_finite() => Err(FitError::Expectation { order }),
        _ => Ok(()),
    }
}

/// The largest floor up to each level. A NaN stays NaN: it is a verdict of its own.
fn running_floors(samples: &[Sample]) -> Vec<Float> {
    let mut floors: Vec<Float> = Vec::with_capacity(samples.len());
    for sample in samples {
        let floor = match floors.last() {
            Some(before) if *before > sample.floor => before.clone(),
            _ => sample.floor.clone(),
        };
        floors.push(floor);
    }
    floors
}

/// |e| ≤ 30·floor, compared exactly.
fn is_at_floor(error: &Float, floor: &Float) -> bool {
    let margin = Float::with_val(floor.prec() + 8, floor * FLOOR_MARGIN);
    matches!(
        error.cmp_abs(&margin),
        Some(Ordering::Less | Ordering::Equal)
    )
}

/// Pairwise orders of all neighbours with finite, nonzero errors.
fn pairwise(samples: &[Sample], points: &[(f64, f64)], usable: usize) -> Vec<Pair> {
    (1..samples.len())
        .filter(|i| points[i - 1].1.is_finite() && points[*i].1.is_finite())
        .map(|i| Pair {
            coarse: i - 1,
            order: (points[i - 1].1 - points[i].1) / (points[i - 1].0 - points[i].0),
            above_floor: i < usable,
            in_window: false,
            sign_change: samples[i - 1].error.is_sign_negative()
                != samples[i].error.is_sign_negative(),
        })
        .collect()
}

/// A regression in a window.
#[derive(Clone, Copy)]
struct Regression {
    estimate: Estimate,
    log2_constant: f64,
}

/// Order and half-width in a window that ends at the last usable level.
fn regress(
    window: Window,
    samples: &[Sample],
    floors: &[Float],
    points: &[(f64, f64)],
    orders: &[f64],
) -> Option<Regression> {
    let inside = &points[window.first..=window.last];
    let weighted: Vec<(f64, f64, f64)> = inside.iter().map(|p| (p.0, p.1, 1.0)).collect();
    let line = least_squares(&weighted)?;
    let [.., before, previous, last] = *orders else {
        return None;
    };
    let quantile = StudentsT::new(0.0, 1.0, (inside.len() - 2) as f64)
        .ok()?
        .inverse_cdf(0.975);
    let scatter = orders[orders.len() - (inside.len() - 1)..]
        .iter()
        .map(|p| (p - line.slope).abs())
        .fold(0.0, f64::max);
    let ratio = samples[window.last - 1].step / samples[window.last].step;
    // A bias of relative size d drifts r times slower from pair to pair, and has drift/(r − 1) to go.
    // Roundoff may hide the last drift, not so easily the last two.
    let drift = (last - previous)
        .abs()
        .max((previous - before).abs() / ratio);
    let trend = (line.slope - last).abs() + 2.0 * drift / (ratio - 1.0).min(1.0);

    let floor_share = [window.last - 1, window.last]
        .into_iter()
        .map(|i| (log2_abs(&floors[i]) - points[i].1).exp2())
        .sum::<f64>()
        / ratio.ln();
    // The logarithms are rounded to binary64, which shows where errors follow a power exactly.
    let magnitude = inside
        .iter()
        .map(|p| p.1.abs() + line.slope.abs() * p.0.abs())
        .fold(1.0, f64::max);
    let rounding = 8.0 * f64::EPSILON * magnitude / ratio.log2();
    Some(Regression {
        estimate: Estimate {
            order: line.slope,
            half_width: (quantile * line.slope_error).max(scatter).max(trend)
                + floor_share
                + rounding,
            floor_share,
            sign_change: false,
        },
        log2_constant: line.intercept,
    })
}

/// What is left to report without a window: the last order, its spread, its constant.
fn last_order(
    orders: &[f64],
    finest: Option<&(f64, f64)>,
) -> (Option<f64>, Option<f64>, Option<f64>) {
    let (Some(last), Some(finest)) = (orders.last(), finest) else {
        return (None, None, None);
    };
    let distance = |p: &f64| (p - last).abs();
    let spread = orders
        .iter()
        .rev()
        .take(3)
        .map(distance)
        .fold(0.0, f64::max);
    let width = match orders {
        [.., previous, _] => spread.max(2.0 * distance(previous)),
        _ => last.abs(),
    };
    (Some(*last), Some(width), Some(finest.1 - last * finest.0))
}

/// The finest levels without a gap: all errors finite and nonzero.
fn finest_run(points: &[(f64, f64)]) -> &[(f64, f64)] {
    let gap = points.iter().rposition(|p| !p.1.is_finite());
    &points[gap.map_or(0, |g| g + 1)..]
}

#[cfg(test)]
mod coverage;
#[cfg(test)]
mod tests;
