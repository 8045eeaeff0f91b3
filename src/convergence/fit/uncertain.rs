//! The order of errors that have standard errors of their own.

use super::levels::Levels;
use super::{Fit, FitError, Pair, check, last_order};
use crate::convergence::line::least_squares;
use crate::convergence::sample::{Sample, log2_abs};
use crate::convergence::verdict::{Beyond, Estimate, Evidence, Trend, judge};
use crate::convergence::window::{MIN_WINDOW, Window};
use crate::method::Expected;
use rug::Float;
use statrs::distribution::{ChiSquared, ContinuousCDF};
use std::f64::consts::LN_2;

/// An error of at most this many standard errors may as well be 0.
const SIGNIFICANT: f64 = 4.0;
/// Levels whose squares are above this quantile of χ² lie on no straight line.
const STRAIGHT: f64 = 0.99;
/// Standard errors of the slope in a half-width, with and without a next power.
const DEVIATIONS: (f64, f64) = (3.0, 4.0);
/// The nearest next power that is allowed for.
const NEXT_POWER: f64 = 0.35;

/// log₂ step, log₂|error|, and one over the variance of the latter.
type Point = (f64, f64, f64);

/// Fits |e| = c·dᵖ to errors with standard errors σ, and judges it: where [`fit`](super::fit()) sees bias alone.
///
/// Levels count up to the first with |e| ≤ 4σ or at most 30 floors, weighted by (e/σ)². The window is the longest fine-side run
/// of at least 4 of them that lies on a straight line by χ² at 99 %. Its slope is the order; the half-width is
///
/// ```text
/// max(4·s, |p̂ − p̃| + 3·s̃) + (Σ floor/|e|)/ln r
/// ```
///
/// with s the standard error of the slope p̂, and p̃ ± s̃ the slope where a next power d^0.35 is fitted as well: bias that hides in
/// the noise. Of 20,000 simulated ladders each with no next power, and with one ½, 1 and 2 away, no interval excluded the order.
///
/// # Errors
///
/// [`FitError`] as for [`fit`](super::fit()), and where there are not as many standard errors as levels, or one is not
/// above 0.
pub fn fit_uncertain(
    samples: &[Sample],
    standard_errors: &[Float],
    expected: Option<Expected>,
) -> Result<Fit, FitError> {
    check(samples, expected)?;
    if standard_errors.len() != samples.len() {
        return Err(FitError::StandardErrors {
            given: standard_errors.len(),
            levels: samples.len(),
        });
    }
    for (level, size) in standard_errors.iter().enumerate() {
        if !size.is_finite() || *size <= 0 {
            let size = size.to_f64();
            return Err(FitError::StandardError { level, size });
        }
    }
    let levels = Levels::new(samples);
    let points: Vec<Point> = levels
        .points
        .iter()
        .zip(standard_errors)
        .take(levels.usable)
        .map(|((x, y), size)| (*x, *y, (log2_abs(size) - y).exp2()))
        .take_while(|(_, _, relative)| SIGNIFICANT * relative < 1.0)
        .map(|(x, y, relative)| (x, y, (LN_2 / relative).powi(2)))
        .collect();
    let found = (0..(points.len() + 1).saturating_sub(MIN_WINDOW))
        .find_map(|first| Some((first, straight(points.get(first..)?)?)));
    let window = found.map(|(first, _)| {
        let orders: Vec<f64> = points[first..]
            .windows(2)
            .map(|pair| (pair[0].1 - pair[1].1) / (pair[0].0 - pair[1].0))
            .collect();
        let last = orders.last().copied().unwrap_or_default();
        let distances = orders.iter().map(|order| (order - last).abs());
        let spread = distances.fold(0.0, f64::max);
        levels.window_of(first, points.len() - 1, spread)
    });
    let estimate = found
        .zip(window)
        .map(|((_, (order, width)), window)| estimate(&levels, window, order, width));
    let mut pairs = levels.pairs();
    for pair in &mut pairs {
        pair.above_floor = pair.coarse + 1 < points.len();
        pair.in_window = window.is_some_and(|w| (w.first..w.last).contains(&pair.coarse));
    }
    let orders: Vec<f64> = above(&pairs).map(|p| p.order).collect();
    let insignificant = points.len() < samples.len();
    let evidence = Evidence {
        levels: samples.len(),
        finite: samples
            .iter()
            .all(|s| s.error.is_finite() && s.floor.is_finite()),
        all_at_floor: points.is_empty(),
        all_zero: samples.iter().all(|s| s.error.is_zero()),
        beyond: if insignificant {
            Beyond::Floor
        } else {
            Beyond::Nothing
        },
        // Errors that scatter have no trend without an order.
        trend: Trend::Converging,
        late_sign_changes: above(&pairs)
            .filter(|p| p.sign_change && p.coarse + MIN_WINDOW >= points.len())
            .count(),
        estimate,
    };
    let heights: Vec<(f64, f64)> = points.iter().map(|p| (p.0, p.1)).collect();
    let (order, half_width, log2_constant) = match (estimate, found) {
        (Some(e), Some((first, _))) => {
            let constant = least_squares(&points[first..]).map(|line| line.intercept);
            (Some(e.order), Some(e.half_width), constant)
        }
        _ => last_order(&orders, heights.last()),
    };
    Ok(Fit {
        verdict: judge(&evidence, expected),
        order,
        half_width,
        log2_constant,
        window,
        floor: levels
            .floors
            .last()
            .cloned()
            .unwrap_or_else(|| Float::new(53)),
        cut: None,
        pairs,
        notes: Vec::new(),
    })
}

/// The pairs of significant levels.
fn above(pairs: &[Pair]) -> impl Iterator<Item = &Pair> {
    pairs.iter().filter(|pair| pair.above_floor)
}

/// The slope and how far it may be off; `None` where the points lie on no straight line.
fn straight(points: &[Point]) -> Option<(f64, f64)> {
    let line = least_squares(points)?;
    let squares: f64 = points
        .iter()
        .map(|(x, y, weight)| weight * (y - line.intercept - line.slope * x).powi(2))
        .sum();
    let freedom = points.len().checked_sub(2)?;
    let quantile = ChiSquared::new(freedom as f64).ok()?.inverse_cdf(STRAIGHT);
    if squares > quantile {
        return None;
    }
    let total: f64 = points.iter().map(|p| p.2).sum();
    let mean = points.iter().map(|p| p.2 * p.0).sum::<f64>() / total;
    let (order, error) = slope(points, |x| x - mean);
    let finest = points.last()?.0;
    let next = |x: f64| (NEXT_POWER * (x - finest)).exp2();
    let explained: Vec<Point> = points.iter().map(|p| (next(p.0), p.0, p.2)).collect();
    let by_next = least_squares(&explained)?;
    let (with_next, error_with_next) =
        slope(points, |x| x - by_next.intercept - by_next.slope * next(x));
    let hidden = (order - with_next).abs() + DEVIATIONS.0 * error_with_next;
    Some((order, hidden.max(DEVIATIONS.1 * error)))
}

/// Slope and its standard error from what is left of x beside the other terms.
fn slope(points: &[Point], rest: impl Fn(f64) -> f64) -> (f64, f64) {
    let squares: f64 = points.iter().map(|p| p.2 * rest(p.0).powi(2)).sum();
    let products: f64 = points.iter().map(|p| p.2 * rest(p.0) * p.1).sum();
    (products / squares, 1.0 / squares.sqrt())
}

fn estimate(levels: &Levels<'_>, window: Window, order: f64, width: f64) -> Estimate {
    let floors: f64 = levels.noise[window.last - 1..=window.last].iter().sum();
    let floor_share = floors / (levels.log2_ratio(window.last) * LN_2);
    Estimate {
        order,
        half_width: width + floor_share,
        floor_share,
        sign_change: levels
            .signs(window)
            .windows(2)
            .any(|pair| pair[0] != pair[1]),
    }
}
