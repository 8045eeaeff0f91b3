//! A plot without its legend.

use super::axes::{BOTTOM, LEFT, LETTER, RIGHT, Scales, TOP, axes, guides};
use super::key::{class, shape, stroke};
use super::mark::{outline, path, size};
use crate::document::{Plot, Point, Series};
use maud::{Markup, html};

/// Between the letters of a mark and those below.
const LINE: f64 = 12.0;
/// Letters go so far down to find a place of their own.
const MOST_LINES: u32 = 14;

/// Who says what a mark stands for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(in crate::render) enum Reader {
    /// A script, which finds it in attributes.
    Script,
    /// Whatever shows the drawing: most show titles.
    Viewer,
}

/// Axes, guides and curves, in a box of [`WIDTH`](super::WIDTH) × [`HEIGHT`](super::HEIGHT).
pub(in crate::render) fn drawing(plot: &Plot, scales: &Scales, reader: Reader) -> Markup {
    let mut taken = Vec::new();
    html! {
        (axes(plot, scales))
        (guides(plot, scales))
        @for (index, series) in plot.series.iter().enumerate() {
            @let for_script = (reader == Reader::Script).then_some(&series.name);
            g.series.(class(index, series)) data-series=[for_script.map(|_| index)] data-name=[for_script] {
                (lines(series, scales, size(index)))
                @for point in &series.points {
                    @if let Some(at) = scales.at((point.x, point.y)) {
                        @let outline = outline(point, at, shape(index, series), size(index));
                        @if reader == Reader::Script {
                            path.mark.filled[point.filled] d=(outline)
                                data-x=(format!("{:.2}", at.0)) data-y=(format!("{:.2}", at.1)) data-label=(point.label) {}
                        } @else {
                            path.mark.filled[point.filled] d=(outline) { title { (series.name) "\n" (point.label) } }
                        }
                        @if !point.tag.is_empty() { (tag(point, at, &mut taken)) }
                    }
                }
            }
        }
    }
}

/// Letters below a mark on the left, where no others stand; with a line to the mark where that is not beside it.
fn tag(point: &Point, (x, y): (f64, f64), taken: &mut Vec<(f64, f64, f64)>) -> Markup {
    let width = LETTER * point.tag.chars().count() as f64;
    let place = |line: u32| {
        let down = LINE * f64::from(line);
        (x - 6.0 - 0.35 * down, y + 13.0 + down)
    };
    let is_free = |(right, base): (f64, f64)| {
        let touches = |other: &(f64, f64, f64)| {
            (other.2 - base).abs() < LINE && other.0 < right && other.1 > right - width
        };
        !taken.iter().any(touches)
    };
    let line = (0..MOST_LINES).find(|line| is_free(place(*line)));
    let (right, base) = place(line.unwrap_or(0));
    taken.push((right - width, right, base));
    html! {
        @if line.is_some_and(|line| line > 0) {
            path.leader d=(path([Some((x, y)), Some((right, base - 9.0))].into_iter())) {}
        }
        text.tag x=(format!("{right:.2}")) y=(format!("{base:.2}")) { (point.tag) }
    }
}

fn lines(series: &Series, scales: &Scales, size: f64) -> Markup {
    let line = series
        .points
        .iter()
        .map(|point| scales.at((point.x, point.y)));
    html! {
        @if !series.traces.is_empty() {
            // An inner drawing ends at its frame.
            svg x=(LEFT) y=(TOP) width=(RIGHT - LEFT) height=(BOTTOM - TOP) viewBox={ (LEFT) " " (TOP) " " (RIGHT - LEFT) " " (BOTTOM - TOP) } {
                @for trace in &series.traces {
                    path.trace.(stroke(trace.stroke)) d=(path(trace.points.iter().map(|at| scales.at(*at)))) {}
                }
            }
        }
        @if series.line { path.line d=(path(line)) stroke-width=(2.0 * size) {} }
    }
}
