//! The same figures as plots of a page: what is drawn is decided once.

use super::curve::{Curve, Mark, Model, Panel};
use super::style::PALETTE;
use super::{curve, of_fit, split};
use crate::convergence::{Fit, Sample};
use crate::document::{Axis, Plot, Point, Series, Stroke, Trace};
use crate::report::Group;
use crate::study::sweep::Line;
use std::f64::consts::LOG10_2;

/// [`table_plot`](super::table_plot), a plot a panel.
pub(in crate::report) fn of_table(group: &Group<'_>) -> Vec<Plot> {
    curve::panels(group).iter().map(plot).collect()
}

/// [`convergence_plot`](super::convergence_plot).
pub(in crate::report) fn of_convergence(samples: &[Sample], fit: &Fit, title: &str) -> Plot {
    Plot {
        title: title.into(),
        ..plot(&of_fit::of_fit(samples, fit))
    }
}

/// [`split_plot`](super::split_plot), a plot a format.
pub(in crate::report) fn of_split(lines: &[&Line]) -> Vec<Plot> {
    split::panels(lines).iter().map(plot).collect()
}

fn plot(panel: &Panel) -> Plot {
    // Without ticks the places are octaves of 1/d.
    let x = match panel.ticks[..] {
        [] => "1/d, finer to the right",
        _ => panel.x_label,
    };
    let mut plot = Plot::new(&panel.title, Axis::log(x), Axis::log(panel.y_label));
    plot.series = panel
        .curves
        .iter()
        .map(|curve| series(curve, panel))
        .collect();
    for model in &panel.models {
        let trace = trace(Stroke::Thin, &model.path);
        let own = plot
            .series
            .iter_mut()
            .find(|s| s.color == Some(model.color));
        match own {
            Some(series) => series.traces.push(trace),
            None => plot.series.push(alone(model, trace)),
        }
    }
    if let Some(guide) = &panel.guide {
        plot.guides.push(crate::document::Guide {
            upright: true,
            at: guide.x.map_or(f64::NAN, |x| x * LOG10_2),
            label: guide.lines.join(", "),
        });
    }
    plot
}

/// A model whose part has no marks.
fn alone(model: &Model, trace: Trace) -> Series {
    let mut series = Series::marks("model", []).colored(model.color);
    series.traces.push(trace);
    series
}

fn series(curve: &Curve, panel: &Panel) -> Series {
    let points = curve.marks.iter().map(|mark| match mark {
        Some(mark) => point(mark, panel),
        // The line breaks.
        None => Point::new(f64::NAN, f64::NAN, ""),
    });
    let name = match curve.slope.map(|slope| format!("{slope:.2}")) {
        Some(slope) if !curve.legend.contains(&slope) => format!("{} {slope}", curve.legend),
        _ => curve.legend.clone(),
    };
    let mut series = Series::line(name, points).colored(curve.color % PALETTE.len());
    for (stroke, path) in [
        (Stroke::Dashed, &curve.bias),
        (Stroke::Dotted, &curve.floor),
    ] {
        if !path.is_empty() {
            series.traces.push(trace(stroke, path));
        }
    }
    series
}

fn point(mark: &Mark, panel: &Panel) -> Point {
    let tick = panel.ticks.iter().find(|(x, _)| (x - mark.x).abs() < 1e-9);
    let place = match tick {
        Some((_, n)) => format!("n = {n}"),
        None => format!("d = {}", decimal(-mark.x * LOG10_2)),
    };
    let sign = if mark.negative { ", below 0" } else { "" };
    let fitted = if mark.fitted { "\nin the fit" } else { "" };
    let label = format!(
        "{place}\n{} = {}{sign}{fitted}",
        panel.y_label,
        decimal(mark.y)
    );
    Point {
        filled: mark.fitted,
        negative: mark.negative,
        ..Point::new(mark.x * LOG10_2, mark.y, label)
    }
}

fn trace(stroke: Stroke, path: &[(f64, f64)]) -> Trace {
    Trace {
        stroke,
        points: path.iter().map(|(x, y)| (x * LOG10_2, *y)).collect(),
    }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::fixture::{entry, replicated};
    use crate::report::groups;
    use rug::Float;

    #[test]
    fn numbers_of_any_magnitude_have_three_digits() {
        assert_eq!(decimal(-400.0), "1.00e-400");
        assert_eq!(decimal(-5000.3), "5.01e-5001");
        assert_eq!(decimal(2.0 - 1e-9), "1.00e2");
    }

    #[test]
    fn a_plot_has_what_its_panel_has() {
        let mut measured = entry("simpson", "boole");
        measured.levels[1].error = -measured.levels[1].error.clone();
        measured.levels[2].error = Float::new(53);
        let entries = [measured, replicated("monte-carlo", "boole")];
        let plots = of_table(&groups(&entries)[0]);
        assert_eq!(plots[0].title, "inner: simpson");
        let series = &plots[0].series[0];
        assert_eq!(series.name, "boole 4.00");
        let first = &series.points[0];
        assert!((first.x - 8_f64.log10()).abs() < 1e-12);
        assert!((first.y - -12.0 * LOG10_2).abs() < 1e-12);
        assert_eq!(first.label, "n = 8\n|error| = 2.44e-4");
        let second = &series.points[1];
        assert!(second.negative && second.filled);
        assert!(
            second.label.ends_with(", below 0\nin the fit"),
            "{}",
            second.label
        );
        assert!(series.points[2].x.is_nan());
        assert_eq!(plots[1].series[0].traces[0].stroke, Stroke::Dashed);
    }
}
