//! Order and half-width in a window.

use super::levels::Levels;
use super::{Pair, Window};
use crate::convergence::line::least_squares;
use crate::convergence::sample::log2_abs;
use crate::convergence::verdict::Estimate;
use statrs::distribution::{ContinuousCDF, StudentsT};
use std::f64::consts::LN_2;

/// A regression in a window.
#[derive(Clone, Copy)]
pub(super) struct Regression {
    pub(super) estimate: Estimate,
    pub(super) log2_constant: f64,
}

/// Order and half-width in a window that ends at the last usable level; `None` where the steps are too
/// close together to tell.
pub(super) fn regress(window: Window, levels: &Levels<'_>, usable: &[Pair]) -> Option<Regression> {
    let Levels { floors, points, .. } = levels;
    let inside = &points[window.first..=window.last];
    let pairs = &usable[usable.len() - (inside.len() - 1)..];
    let weighted: Vec<(f64, f64, f64)> = inside.iter().map(|p| (p.0, p.1, 1.0)).collect();
    let line = least_squares(&weighted)?;
    let [.., before, previous, last] = pairs else {
        return None;
    };
    let (before, previous, last) = (before.order, previous.order, last.order);
    let quantile = StudentsT::new(0.0, 1.0, (inside.len() - 2) as f64)
        .ok()?
        .inverse_cdf(0.975);
    let scatter = pairs
        .iter()
        .map(|p| (p.order - line.slope).abs())
        .fold(0.0, f64::max);
    let log2_ratio = levels.log2_ratio(window.last);
    let ratio = log2_ratio.exp2();
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
        / (log2_ratio * LN_2);
    // The logarithms are rounded to binary64, which shows where errors follow a power exactly.
    let magnitude = inside
        .iter()
        .map(|p| p.1.abs() + line.slope.abs() * p.0.abs())
        .fold(1.0, f64::max);
    let rounding = 8.0 * f64::EPSILON * magnitude / log2_ratio;
    let spread = (quantile * line.slope_error).max(scatter).max(trend);
    let half_width = spread + floor_share + rounding;
    half_width.is_finite().then_some(Regression {
        estimate: Estimate {
            order: line.slope,
            half_width,
            floor_share,
            sign_change: pairs.iter().any(|p| p.sign_change),
        },
        log2_constant: line.intercept,
    })
}
