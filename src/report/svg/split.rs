//! The parts of an error against n.

use super::curve::{Curve, Guide, Mark, Model, Panel, is_slope, log10_abs, ticks};
use crate::convergence::{Fit, RoundoffLaw};
use crate::report::study::words::{PARTS, best, crossing};
use crate::study::sweep::{LevelRecord, Line, Part};
use std::cmp::Ordering;
use std::f64::consts::LOG10_2;

/// n* is drawn up to so many octaves beyond the finest level.
const BEYOND: f64 = 3.0;
/// Places of a model an octave.
const STEPS: f64 = 8.0;

/// One panel a format.
pub(super) fn panels(lines: &[&Line]) -> Vec<Panel> {
    lines.iter().map(|line| panel(line)).collect()
}

fn panel(line: &Line) -> Panel {
    let levels: Vec<u64> = line
        .row
        .levels
        .iter()
        .map(|level| level.n)
        .filter(|n| *n > 0)
        .collect();
    let curves = PARTS
        .iter()
        .filter_map(|(part, name)| curve(line, *part, name));
    let first = levels.first().map_or(0.0, |n| (*n as f64).log2());
    let last = levels.last().map_or(0.0, |n| (*n as f64).log2());
    let crossing_x = line
        .summary
        .crossing
        .map(f64::log2)
        .filter(|x| *x <= last + BEYOND);
    let end = crossing_x.map_or(last, |x| last.max(x + 0.5));
    Panel {
        title: line.format.clone(),
        x_label: "segments n",
        y_label: "|part of the error|",
        ticks: ticks(&levels),
        curves: curves.collect(),
        models: models(line, first, end),
        guide: guide(line, crossing_x),
    }
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
fn curve(line: &Line, part: Part, name: &str) -> Option<Curve> {
    let fit = match part {
        Part::Total => Some(&line.summary.total),
        Part::Discretization => Some(&line.summary.discretization),
        _ => None,
    };
    let in_fit = |n: u64| match fit.map(|fit| fit.window) {
        None => true,
        Some(window) => window.is_some_and(|window| {
            window.coarsest_n.is_some_and(|first| first <= n)
                && window.finest_n.is_some_and(|last| n <= last)
        }),
    };
    let marks: Vec<Option<Mark>> = line
        .row
        .levels
        .iter()
        .map(|level| {
            let (y, negative) = visible(level, part)?;
            Some(Mark {
                x: (level.n as f64).log2(),
                y,
                negative,
                fitted: in_fit(level.n),
            })
        })
        .collect();
    let slope = |fit: &Fit| fit.order.filter(|p| fit.window.is_some() && is_slope(*p));
    marks.iter().any(Option::is_some).then(|| Curve {
        color: color(part),
        legend: name.into(),
        marks,
        bias: Vec::new(),
        floor: Vec::new(),
        slope: fit.filter(|_| part == Part::Discretization).and_then(slope),
    })
}

/// log₁₀|part| and whether it is negative, where the oracle sees it.
fn visible(level: &LevelRecord, part: Part) -> Option<(f64, bool)> {
    let error = level.part(part)?;
    let hidden = |resolution| error.cmp_abs(resolution).is_none_or(Ordering::is_le);
    if level.n == 0 || level.resolution.as_ref().is_some_and(hidden) {
        return None;
    }
    Some((log10_abs(error)?, error.is_sign_negative()))
}

/// The model of the whole error, and the laws of its roundoff.
fn models(line: &Line, first: f64, end: f64) -> Vec<Model> {
    let summary = &line.summary;
    let law = |law: Option<RoundoffLaw>, part| {
        let law = law?;
        let at = |x: f64| (x, law.log2_at(x, f64::from(line.bits)) * LOG10_2);
        Some(Model {
            color: color(part),
            path: vec![at(first), at(end)],
        })
    };
    let next = |x: &f64| Some(x + 1.0 / STEPS).filter(|x| *x <= end);
    let whole: Vec<(f64, f64)> = std::iter::successors(Some(first), next)
        .map(|x| (x, summary.model.log2_error(x) * LOG10_2))
        .filter(|(_, y)| y.is_finite())
        .collect();
    let whole = (whole.len() > 1).then(|| Model {
        color: color(Part::Total),
        path: whole,
    });
    let models = [
        whole,
        law(summary.laws.input, Part::Input),
        law(summary.laws.arithmetic, Part::Arithmetic),
    ];
    models.into_iter().flatten().collect()
}

fn guide(line: &Line, x: Option<f64>) -> Option<Guide> {
    let mut lines = Vec::new();
    if line.summary.crossing.is_some() {
        lines.push(format!("n* = {}", crossing(line)));
    }
    if line.summary.best.is_some() {
        lines.push(format!("best {}", best(line)));
    }
    (!lines.is_empty()).then_some(Guide { x, lines })
}
