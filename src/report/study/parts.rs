//! The parts of an error as plots.

use super::words::{PARTS, best, crossing};
use crate::convergence::{Fit, RoundoffLaw};
use crate::document::{Axis, Guide, Plot, Point, Series, Stroke, Trace};
use crate::report::plots::{FLAT, Level, curve, gap, key, slope, trace};
use crate::study::sweep::{LevelRecord, Line, Part};
use std::cmp::Ordering;
use std::f64::consts::LOG10_2;

/// n* is drawn up to so many octaves beyond the finest level.
const BEYOND: f64 = 3.0;
/// Places of a model an octave.
const STEPS: f64 = 8.0;
const ERROR: &str = "|part of the error|";

/// The parts of a method's error on a case against n, a plot a format: measured, with thin curves that were fitted, and a
/// line at n*, from where on roundoff is larger than discretization.
///
/// Levels where a part is 0, or so small that the oracle's rounding hides it, are left out.
#[must_use]
pub fn of_split(lines: &[&Line]) -> Vec<Plot> {
    lines.iter().map(|line| plot(line)).collect()
}

fn plot(line: &Line) -> Plot {
    let levels = line.row.levels.iter().map(|level| level.n);
    let octaves: Vec<f64> = levels
        .filter(|n| *n > 0)
        .map(|n| (n as f64).log2())
        .collect();
    let first = octaves.first().copied().unwrap_or(0.0);
    let last = octaves.last().copied().unwrap_or(0.0);
    let split = line.summary.split.as_ref();
    let cross = split.and_then(|split| split.crossing).map(f64::log2);
    let cross = cross.filter(|x| *x <= last + BEYOND);
    let end = cross.map_or(last, |x| last.max(x + 0.5));
    let axes = (Axis::log("segments n"), Axis::log(ERROR));
    let mut plot = Plot::new(&line.format, axes.0, axes.1).keyed(key("fitted model"));
    plot.series = PARTS
        .iter()
        .filter_map(|(part, name)| series(line, *part, name))
        .collect();
    for (part, model) in models(line, first, end) {
        let color = Some(color(part));
        match plot.series.iter_mut().find(|series| series.color == color) {
            Some(series) => series.traces.push(model),
            // A model whose part has no marks.
            None => plot.series.push(Series {
                color,
                traces: vec![model],
                ..Series::marks("model", [])
            }),
        }
    }
    plot.guides.extend(guide(line, cross));
    plot
}

/// A part's place in the palette.
fn color(part: Part) -> usize {
    match part {
        Part::Total => 6,
        Part::Discretization => 0,
        Part::Truncation => 3,
        Part::Input => 2,
        Part::Arithmetic => 4,
    }
}

/// The curve of a part; none where it is nothing at all levels.
fn series(line: &Line, part: Part, name: &str) -> Option<Series> {
    let fit = match part {
        Part::Total => Some(&line.summary.total),
        Part::Discretization => line
            .summary
            .split
            .as_ref()
            .map(|split| &split.discretization),
        _ => None,
    };
    let in_fit = |n: u64| match fit.map(|fit| fit.window) {
        None => true,
        Some(window) => window.is_some_and(|window| {
            window.coarsest_n.is_some_and(|first| first <= n)
                && window.finest_n.is_some_and(|last| n <= last)
        }),
    };
    let levels = line.row.levels.iter();
    let points: Vec<Point> = levels
        .map(|level| {
            let at = Level::of_n(level.n);
            visible(level, part).map_or_else(gap, |error| at.mark(error, in_fit(level.n), ERROR))
        })
        .collect();
    let order = |fit: &Fit| fit.order.filter(|_| fit.window.is_some());
    let order = fit.filter(|_| part == Part::Discretization).and_then(order);
    let slope = slope(&points, order);
    let name = match order.filter(|order| order.abs() >= FLAT) {
        Some(order) => format!("{name} {order:.2}"),
        None => name.into(),
    };
    let is_drawn = points.iter().any(|point| point.y.is_finite());
    is_drawn.then(|| curve(name, points, [slope]).colored(color(part)))
}

/// The part where the oracle sees it.
fn visible(level: &LevelRecord, part: Part) -> Option<&rug::Float> {
    let error = level.part(part)?;
    let hidden = |resolution| error.cmp_abs(resolution).is_none_or(Ordering::is_le);
    let is_hidden = level.n == 0 || level.resolution.as_ref().is_some_and(hidden);
    (!is_hidden).then_some(error)
}

/// The model of the whole error, and the laws of its roundoff, between two octaves.
fn models(line: &Line, first: f64, end: f64) -> Vec<(Part, Trace)> {
    let Some(split) = &line.summary.split else {
        return Vec::new();
    };
    let law = |law: Option<RoundoffLaw>| {
        let at = |law: RoundoffLaw, x: f64| {
            (x * LOG10_2, law.log2_at(x, f64::from(line.bits)) * LOG10_2)
        };
        law.and_then(|law| trace(Stroke::Thin, [at(law, first), at(law, end)]))
    };
    let next = |x: &f64| Some(x + 1.0 / STEPS).filter(|x| *x <= end);
    let whole = std::iter::successors(Some(first), next)
        .map(|x| (x * LOG10_2, split.model.log2_error(x) * LOG10_2))
        .filter(|(_, y)| y.is_finite());
    let models = [
        (Part::Total, trace(Stroke::Thin, whole)),
        (Part::Input, law(split.laws.input)),
        (Part::Arithmetic, law(split.laws.arithmetic)),
    ];
    models
        .into_iter()
        .filter_map(|(part, trace)| Some((part, trace?)))
        .collect()
}

/// At n*, given as an octave.
fn guide(line: &Line, x: Option<f64>) -> Option<Guide> {
    let split = line.summary.split.as_ref()?;
    let mut words = Vec::new();
    if split.crossing.is_some() {
        words.push(format!("n* = {}", crossing(line)));
    }
    if split.best.is_some() {
        words.push(format!("best {}", best(line)));
    }
    (!words.is_empty()).then(|| Guide {
        upright: true,
        at: x.map_or(f64::NAN, |x| x * LOG10_2),
        label: words.join(", "),
    })
}
