//! A plot with its legend.

use super::axes::{BOTTOM, HEIGHT, LEFT, RIGHT, Scales, TOP, WIDTH, axes, guides};
use super::mark::{outline, path, size};
use crate::document::{Plot, Point, Series, Stroke};
use maud::{Markup, html};

/// Colours of the palette in the style sheet.
const COLORS: usize = 8;

pub(super) fn figure(plot: &Plot) -> Markup {
    html! {
        figure.plot {
            figcaption { (plot.title) }
            @match Scales::new(plot) {
                Some(scales) => {
                    (legend(plot))
                    (drawing(plot, &scales))
                },
                None => p.none {
                    "Nothing to draw"
                    @for (index, series) in plot.series.iter().enumerate() {
                        (if index == 0 { ": " } else { "; " }) (series.name)
                    }
                    @for guide in &plot.guides { "; " (guide.label) }
                },
            }
        }
    }
}

fn color(index: usize, series: &Series) -> String {
    format!("c{}", series.color.unwrap_or(index) % COLORS)
}

fn legend(plot: &Plot) -> Markup {
    html! {
        ul.legend {
            @for (index, series) in plot.series.iter().enumerate() {
                li.(color(index, series)) data-series=(index) {
                    svg.swatch viewBox="0 0 26 14" aria-hidden="true" {
                        @if series.line || !series.traces.is_empty() { path.line d="M1 7H25" {} }
                        @if !series.points.is_empty() {
                            @let point = Point::new(0.0, 0.0, "").filled();
                            path.mark.filled d=(outline(&point, (13.0, 7.0), shape(index, series), 1.0)) {}
                        }
                    }
                    span { (series.name) }
                }
            }
        }
    }
}

/// The shape goes with the colour, unless the series has its own.
fn shape(index: usize, series: &Series) -> usize {
    series.shape.or(series.color).unwrap_or(index)
}

fn drawing(plot: &Plot, scales: &Scales) -> Markup {
    let box_ = format!("0 0 {WIDTH} {HEIGHT}");
    let names: Vec<&str> = plot
        .series
        .iter()
        .map(|series| series.name.as_str())
        .collect();
    let label = format!(
        "{}: {} against {}; {}",
        plot.title,
        plot.y.title,
        plot.x.title,
        names.join("; ")
    );
    html! {
        svg viewBox=(box_) role="img" aria-label=(label) {
            (axes(plot, scales))
            (guides(plot, scales))
            @for (index, series) in plot.series.iter().enumerate() {
                g.series.(color(index, series)) data-series=(index) data-name=(series.name) {
                    (curve(series, scales, size(index)))
                    @for point in &series.points {
                        @if let Some(at) = scales.at((point.x, point.y)) {
                            path.mark.filled[point.filled] d=(outline(point, at, shape(index, series), size(index)))
                                data-x=(format!("{:.2}", at.0)) data-y=(format!("{:.2}", at.1)) data-label=(point.label) {}
                            @if !point.tag.is_empty() {
                                text.tag x=(format!("{:.2}", at.0 - 6.0)) y=(format!("{:.2}", at.1 + 13.0)) { (point.tag) }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn curve(series: &Series, scales: &Scales, size: f64) -> Markup {
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

fn stroke(stroke: Stroke) -> &'static str {
    match stroke {
        Stroke::Thin => "thin",
        Stroke::Dashed => "dashed",
        Stroke::Dotted => "dotted",
    }
}
