//! What series are called, and what kinds of marks and lines mean.

use super::axes::Scales;
use super::mark::outline;
use crate::document::{Plot, Point, Series, Sign, Stroke};
use maud::{Markup, html};

/// Colours of the palette in the style sheet.
const COLORS: usize = 8;

/// Width and height of a sample.
pub(in crate::render) const SAMPLE: (f64, f64) = (26.0, 14.0);

const MIDDLE: (f64, f64) = (13.0, 7.0);
const ACROSS: &str = "M1 7H25";

/// A sample with its words.
pub(in crate::render) struct Entry {
    /// The place of its series in the plot, if it is one's.
    pub(in crate::render) index: Option<usize>,
    /// The class of its colour.
    pub(in crate::render) class: String,
    pub(in crate::render) sample: Markup,
    pub(in crate::render) words: String,
}

/// The series that have a name.
pub(in crate::render) fn legend(plot: &Plot) -> Vec<Entry> {
    let named = plot
        .series
        .iter()
        .enumerate()
        .filter(|(_, series)| !series.name.is_empty());
    let entry = |(index, series): (usize, &Series)| Entry {
        index: Some(index),
        class: class(index, series),
        sample: sample(index, series),
        words: series.name.clone(),
    };
    named.map(entry).collect()
}

/// What a plot is about that has nothing to draw: its series and what its lines say.
pub(in crate::render) fn names(plot: &Plot) -> String {
    let series = plot.series.iter().map(|series| &series.name);
    let lines = plot.guides.iter().map(|guide| &guide.label);
    let names = series.chain(lines).filter(|name| !name.is_empty());
    names.map(String::as_str).collect::<Vec<_>>().join("; ")
}

/// The class of the colour.
pub(super) fn class(index: usize, series: &Series) -> String {
    format!("c{}", series.color.unwrap_or(index) % COLORS)
}

/// The shape goes with the colour, unless the series has its own.
pub(super) fn shape(index: usize, series: &Series) -> usize {
    series.shape.or(series.color).unwrap_or(index)
}

fn sample(index: usize, series: &Series) -> Markup {
    let point = Point::new(0.0, 0.0, "").filled();
    html! {
        @if series.line {
            path.line d=(ACROSS) stroke-width="2" {}
        } @else if let Some(trace) = series.traces.first() {
            path.trace.(stroke(trace.stroke)) d=(ACROSS) {}
        }
        @if !series.points.is_empty() {
            path.mark.filled d=(outline(&point, MIDDLE, shape(index, series), 1.0)) {}
        }
    }
}

/// What the kinds of marks and lines that occur mean, each once, with samples.
pub(in crate::render) fn key(plots: &[(&Plot, Scales)]) -> Vec<Entry> {
    let mut found: Vec<&(Sign, String)> = Vec::new();
    for (plot, scales) in plots {
        for entry in &plot.key {
            if !found.contains(&entry) && occurs(entry.0, plot, scales) {
                found.push(entry);
            }
        }
    }
    let entry = |(sign, words): &(Sign, String)| Entry {
        index: None,
        class: "key".into(),
        sample: of_sign(*sign),
        words: words.clone(),
    };
    found.into_iter().map(entry).collect()
}

fn occurs(sign: Sign, plot: &Plot, scales: &Scales) -> bool {
    let mut points = plot.series.iter().flat_map(|series| &series.points);
    let mut traces = plot.series.iter().flat_map(|series| &series.traces);
    let is_drawn = |point: &Point| scales.at((point.x, point.y)).is_some();
    match sign {
        Sign::Filled => points.any(|point| is_drawn(point) && point.filled),
        Sign::Hollow => points.any(|point| is_drawn(point) && !point.filled),
        Sign::Negative => points.any(|point| is_drawn(point) && point.negative),
        Sign::Line(stroke) => {
            traces.any(|trace| trace.stroke == stroke && scales.meet(&trace.points))
        }
    }
}

fn of_sign(sign: Sign) -> Markup {
    let mut point = Point::new(0.0, 0.0, "");
    point.filled = sign != Sign::Hollow;
    point.negative = sign == Sign::Negative;
    html! {
        @match sign {
            Sign::Line(line) => path.trace.(stroke(line)) d=(ACROSS) {},
            _ => path.mark.filled[point.filled] d=(outline(&point, MIDDLE, 0, 1.0)) {},
        }
    }
}

/// The class of a stroke.
pub(super) fn stroke(stroke: Stroke) -> &'static str {
    match stroke {
        Stroke::Solid => "solid",
        Stroke::Thin => "thin",
        Stroke::Dashed => "dashed",
        Stroke::Dotted => "dotted",
    }
}
