//! Order and half-width in a window.

use super::drift::Drift;
use super::levels::Levels;
use super::{Window, logarithm};
use crate::convergence::line::least_squares;
use crate::convergence::verdict::Estimate;
use crate::convergence::window;
use std::f64::consts::LN_2;

/// A regression in a window.
#[derive(Clone, Copy)]
pub(super) struct Regression {
    pub(super) window: Window,
    pub(super) estimate: Estimate,
    pub(super) log2_constant: f64,
    /// The order is one up to a logarithm.
    pub(super) logarithm: bool,
}

/// What the finest usable levels are on the way to.
#[derive(Clone, Copy)]
pub(super) enum Asymptote {
    /// An order.
    Order(Regression),
    /// An order that is out of sight: the next power lies this far away from it, as far as it shows.
    Slow(f64),
    /// Another order than the one that shows.
    Growing,
    /// No order shows.
    Open,
}

impl Asymptote {
    /// Of the usable levels.
    pub(super) fn of(levels: &Levels<'_>) -> Self {
        let locals = levels.locals();
        let orders: Vec<f64> = locals.iter().map(|local| local.order).collect();
        let (Some((count, tolerance)), Some(drift)) =
            (window::find(&orders), super::drift::drift(&locals))
        else {
            return Asymptote::Open;
        };
        let window = levels.window(count, tolerance);
        let is_scatter = matches!(drift, Drift::Still { .. });
        if is_scatter && !window::is_plateau(&orders[orders.len() - count..], tolerance) {
            return Asymptote::Open;
        }
        let regression = match drift {
            Drift::Growing => return Asymptote::Growing,
            Drift::Slow { next } => match logarithm::logarithm(&locals) {
                Some((order, width)) => {
                    regress(window, levels, |_| (order, width), GoesOn::Logarithm)
                }
                None => return Asymptote::Slow(next),
            },
            Drift::Settling { order, width } => {
                regress(window, levels, |_| (order, width), GoesOn::Power)
            }
            Drift::Still { width } => regress(
                window,
                levels,
                |line| (line.order, line.width(width)),
                GoesOn::No,
            ),
        };
        regression.map_or(Asymptote::Open, Asymptote::Order)
    }

    /// The order, where there is one.
    pub(super) fn regression(self) -> Option<Regression> {
        match self {
            Asymptote::Order(regression) => Some(regression),
            _ => None,
        }
    }
}

/// Whether pairwise orders go on beyond the finest level.
#[derive(Clone, Copy, PartialEq, Eq)]
enum GoesOn {
    No,
    Power,
    Logarithm,
}

/// Least squares in a window, and what the pairwise orders there leave open.
struct InWindow {
    order: f64,
    scatter: f64,
    last: f64,
}

impl InWindow {
    /// The half-width where the last order may be off by `width`.
    fn width(&self, width: f64) -> f64 {
        let trend = (self.order - self.last).abs() + width;
        self.scatter.max(trend)
    }
}

/// Order and half-width in a window that ends at the last usable level; `None` where the steps are too
/// close together to tell.
fn regress(
    window: Window,
    levels: &Levels<'_>,
    order: impl Fn(&InWindow) -> (f64, f64),
    goes_on: GoesOn,
) -> Option<Regression> {
    let inside = levels.points.get(window.first..=window.last)?;
    let all = levels.locals();
    let locals = all.get(window.first..window.last)?;
    let last = locals.last()?;
    let weighted: Vec<(f64, f64, f64)> = inside.iter().map(|p| (p.0, p.1, 1.0)).collect();
    let line = least_squares(&weighted)?;
    let scatter = locals.iter().map(|l| (l.order - line.slope).abs());
    let (order, spread) = order(&InWindow {
        order: line.slope,
        scatter: scatter.fold(0.0, f64::max),
        last: last.order,
    });
    let log2_ratio = levels.log2_ratio(window.last);
    let floor_share = levels.noise[window.last - 1..=window.last]
        .iter()
        .sum::<f64>()
        / (log2_ratio * LN_2);
    // The logarithms are rounded to binary64, which shows where errors follow a power exactly.
    let magnitude = inside
        .iter()
        .map(|p| p.1.abs() + order.abs() * p.0.abs())
        .fold(1.0, f64::max);
    let rounding = 8.0 * f64::EPSILON * magnitude / log2_ratio;
    let half_width = spread + floor_share + rounding;
    // A drift is smallest at the finest level.
    let log2_constant = match goes_on {
        GoesOn::No => line.intercept,
        GoesOn::Power | GoesOn::Logarithm => {
            let (x, y) = *inside.last()?;
            y - order * x
        }
    };
    let sign_change = levels
        .signs(window)
        .windows(2)
        .any(|pair| pair[0] != pair[1]);
    half_width.is_finite().then_some(Regression {
        window,
        estimate: Estimate {
            order,
            half_width,
            floor_share,
            sign_change,
        },
        log2_constant,
        logarithm: goes_on == GoesOn::Logarithm,
    })
}
