//! What was measured, as plots: errors against segments, the parts of an error, a case along its ray.
//!
//! Errors are drawn by the logarithms of the numbers themselves, so that those below binary64's range have their place too.
//! Marks stand at levels, filled where the order was fitted; one that points down is an error below 0, so that sign changes
//! show. An error that is 0, NaN or infinite has no logarithm: the curve breaks there, and the legend says the verdict.

mod case;
mod convergence;
mod sample;
mod thin;

pub use case::of_case;
pub use convergence::of_convergence;

use crate::convergence::Verdict;
use crate::document::{Point, Series, Sign, Stroke, Trace};
use crate::real::{MpfrReal, Real};
use rug::Float;
use std::f64::consts::LOG10_2;

/// Orders of less than this are no slope worth a line.
pub(super) const FLAT: f64 = 0.1;

/// What marks and lines mean, thin ones among them.
pub(super) fn key(thin: &'static str) -> [(Sign, &'static str); 6] {
    [
        (Sign::Filled, "level in the fit"),
        (Sign::Hollow, "other level"),
        (Sign::Negative, "error below 0"),
        (Sign::Line(Stroke::Thin), thin),
        (Sign::Line(Stroke::Dashed), "|bias|"),
        (Sign::Line(Stroke::Dotted), "roundoff floor"),
    ]
}

/// The place of a level: a decimal logarithm, and words.
pub(super) struct Level {
    pub(super) x: f64,
    words: String,
}

impl Level {
    pub(super) fn of_n(n: u64) -> Self {
        Level {
            x: (n as f64).log10(),
            words: format!("n = {n}"),
        }
    }

    /// Finer levels stand to the right.
    pub(super) fn of_step(step: f64) -> Self {
        let x = -step.log10();
        Level {
            x,
            words: format!("d = {}", decimal(-x)),
        }
    }

    /// The mark of an error there; without a place, where the error has no logarithm.
    pub(super) fn mark(&self, error: &Float, is_fitted: bool, axis: &str) -> Point {
        let Some(y) = log10_abs(error) else {
            return gap();
        };
        let negative = error.is_sign_negative();
        let sign = if negative { ", below 0" } else { "" };
        let fitted = if is_fitted { "\nin the fit" } else { "" };
        let label = format!("{}\n{axis} = {}{sign}{fitted}", self.words, decimal(y));
        Point {
            filled: is_fitted,
            negative,
            ..Point::new(self.x, y, label)
        }
    }
}

/// Where a line breaks.
pub(super) fn gap() -> Point {
    Point::new(f64::NAN, f64::NAN, "")
}

/// log₁₀|x|, `None` for 0, NaN and infinities.
pub(super) fn log10_abs(x: &Float) -> Option<f64> {
    let log = MpfrReal::from(x.clone()).log2_abs() * LOG10_2;
    log.is_finite().then_some(log)
}

/// Three digits of the number with this decimal logarithm, of any magnitude.
fn decimal(log10: f64) -> String {
    let exponent = log10.floor();
    let digits = format!("{:.2}", 10_f64.powf(log10 - exponent));
    match &digits[..] {
        "10.00" => format!("1.00e{:.0}", exponent + 1.0),
        digits => format!("{digits}e{exponent:.0}"),
    }
}

/// "boole 4.00"; other verdicts than the unremarkable ones by name.
pub(super) fn legend(name: &str, order: Option<f64>, verdict: Verdict) -> String {
    let order = order.map(|p| format!("{p:.2}"));
    let remark = match verdict {
        Verdict::Confirmed | Verdict::Fitted => None,
        Verdict::NotFinite => Some("not finite"),
        other => Some(other.name()),
    };
    let figure = match (verdict, order, remark) {
        (Verdict::Exact | Verdict::NotFinite | Verdict::Stalled, _, Some(remark)) => remark.into(),
        (_, Some(order), Some(remark)) => format!("{order} {remark}"),
        (_, Some(order), None) => order,
        (_, None, remark) => remark.unwrap_or("no order").into(),
    };
    format!("{name} {figure}")
}

/// A line of this order through the middle of the levels that it was fitted to, from the coarsest level to the finest: where
/// the errors leave it, they are not of that order.
pub(super) fn slope(points: &[Point], order: Option<f64>) -> Option<Trace> {
    let order = order.filter(|order| order.is_finite() && order.abs() >= FLAT)?;
    let placed: Vec<&Point> = points.iter().filter(|point| point.y.is_finite()).collect();
    let fitted: Vec<&&Point> = placed.iter().filter(|point| point.filled).collect();
    let mean = |of: fn(&Point) -> f64| {
        fitted.iter().map(|point| of(point)).sum::<f64>() / fitted.len() as f64
    };
    let (x, y) = (mean(|point| point.x), mean(|point| point.y));
    let at = |point: &&Point| (point.x, y - order * (point.x - x));
    y.is_finite().then(|| Trace {
        stroke: Stroke::Thin,
        points: [placed.first(), placed.last()]
            .into_iter()
            .flatten()
            .map(at)
            .collect(),
    })
}

/// A line of this stroke.
pub(super) fn trace(stroke: Stroke, points: impl IntoIterator<Item = (f64, f64)>) -> Option<Trace> {
    let points: Vec<(f64, f64)> = points.into_iter().collect();
    (!points.is_empty()).then_some(Trace { stroke, points })
}

/// Points with the traces that belong to them; where no point has a place there is nothing to draw.
pub(super) fn curve<const N: usize>(
    name: String,
    points: Vec<Point>,
    traces: [Option<Trace>; N],
) -> Series {
    let is_drawn = points.iter().any(|point| point.y.is_finite());
    let traces = traces.into_iter().flatten().filter(|_| is_drawn);
    Series {
        traces: traces.collect(),
        ..Series::line(name, points)
    }
}
