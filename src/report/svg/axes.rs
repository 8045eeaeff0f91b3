//! Axes: their ranges, their ticks, and from logarithms to pixels.

use super::area::Area;
use super::canvas::{Canvas, Letters, Point, text_width};
use super::curve::{Curve, Panel};
use super::scale::{Scale, apart, power_of_ten, range, whole_ticks};
use super::style::{AXIS, GRID, TICK_SIZE, letters};
use plotters::style::text_anchor::HPos;
use std::f64::consts::LOG10_2;

/// A bias of so many decades below all deviations is cut off, so that it does not flatten them.
const BIAS_DECADES: f64 = 1.0;

/// Axes: log₂ of the segments against log₁₀ of the error.
pub(super) struct Axes {
    x: Scale,
    y: Scale,
    x_range: (f64, f64),
    y_range: (f64, f64),
    pub(super) plot: Area,
}

/// The axes that hold all marks; `None` without any.
pub(super) fn axes(panel: &Panel, plot: Area) -> Option<Axes> {
    let marks = || panel.curves.iter().flat_map(Curve::marks);
    let models = panel.models.iter().flat_map(|model| &model.path);
    let xs = marks()
        .map(|mark| mark.x)
        .chain(models.map(|place| place.0));
    let x_range = range(xs, 0.35, 1.0)?;
    let lowest = marks().map(|mark| mark.y).fold(f64::INFINITY, f64::min) - BIAS_DECADES;
    let biases = panel.curves.iter().flat_map(|c| c.bias.iter().map(|b| b.1));
    let heights = marks()
        .map(|mark| mark.y)
        .chain(biases.filter(|&y| y >= lowest));
    let y_range = range(heights, 0.3, 2.0)?;
    Some(Axes {
        x: Scale::new(x_range, (plot.left, plot.right)),
        y: Scale::new(y_range, (plot.bottom, plot.top)),
        x_range,
        y_range,
        plot,
    })
}

impl Axes {
    pub(super) fn at(&self, (x, y): (f64, f64)) -> Point {
        (self.x.pixel(x), self.y.pixel(y))
    }

    pub(super) fn path(&self, values: &[(f64, f64)]) -> Vec<Point> {
        values.iter().map(|v| self.at(*v)).collect()
    }

    /// The pieces of a path between the plot's upper and lower end.
    pub(super) fn inside(&self, path: &[Point]) -> Vec<(Point, Point)> {
        let (top, bottom) = (self.plot.top, self.plot.bottom);
        path.windows(2)
            .filter_map(|ends| cut(ends[0], ends[1], top, bottom))
            .collect()
    }

    /// A curve's paths: it breaks where an error has no logarithm.
    pub(super) fn unbroken(&self, curve: &Curve) -> Vec<Vec<Point>> {
        curve
            .marks
            .split(Option::is_none)
            .map(|run| run.iter().flatten().map(|m| self.at((m.x, m.y))).collect())
            .filter(|path: &Vec<Point>| path.len() > 1)
            .collect()
    }

    /// What one order is in pixels (downwards) a pixel.
    pub(super) fn slope_of_order(&self) -> f64 {
        -LOG10_2 * self.y.pixels_a_unit() / self.x.pixels_a_unit()
    }
}

/// The part of a segment with heights in `top ..= bottom`.
fn cut(from: Point, to: Point, top: f64, bottom: f64) -> Option<(Point, Point)> {
    let rise = to.1 - from.1;
    let at = |height: f64| (height - from.1) / rise;
    let (enter, leave) = if rise == 0.0 {
        (
            0.0,
            if (top..=bottom).contains(&from.1) {
                1.0
            } else {
                -1.0
            },
        )
    } else {
        let (a, b) = (at(top), at(bottom));
        (a.min(b).max(0.0), a.max(b).min(1.0))
    };
    let point = |s: f64| (from.0 + s * (to.0 - from.0), from.1 + s * rise);
    (enter < leave).then(|| (point(enter), point(leave)))
}

pub(super) fn draw(canvas: &mut Canvas<'_>, panel: &Panel, axes: &Axes) {
    let plot = axes.plot;
    let x_ticks: Vec<(f64, String)> = if panel.ticks.is_empty() {
        // Powers of ten of the step: x is −log₂ d.
        let steps = (-axes.x_range.1 * LOG10_2, -axes.x_range.0 * LOG10_2);
        let tick = |k: f64| (-k / LOG10_2, power_of_ten(k));
        whole_ticks(steps, 8).into_iter().rev().map(tick).collect()
    } else {
        panel.ticks.clone()
    };
    let places: Vec<(f64, f64)> = x_ticks
        .iter()
        .map(|(x, text)| (axes.x.pixel(*x), text_width(text, TICK_SIZE)))
        .collect();
    for index in apart(&places, 5.0) {
        let (x, text) = (places[index].0, &x_ticks[index].1);
        if x >= plot.left && x <= plot.right {
            canvas.path(&[(x, plot.top), (x, plot.bottom)], GRID);
            let at = (x, plot.bottom + 11.0);
            canvas.text(text, at, letters(TICK_SIZE, false, HPos::Center));
        }
    }
    for exponent in whole_ticks(axes.y_range, 8) {
        let y = axes.y.pixel(exponent);
        canvas.path(&[(plot.left, y), (plot.right, y)], GRID);
        let at = (plot.left - 5.0, y);
        let text = power_of_ten(exponent);
        canvas.text(&text, at, letters(TICK_SIZE, false, HPos::Right));
    }
    let corners = [
        (plot.left, plot.top),
        (plot.left, plot.bottom),
        (plot.right, plot.bottom),
    ];
    canvas.path(&corners, AXIS);
    let below = (f64::midpoint(plot.left, plot.right), plot.bottom + 28.0);
    canvas.text(panel.x_label, below, letters(11.5, false, HPos::Center));
    let beside = (plot.left - 52.0, f64::midpoint(plot.top, plot.bottom));
    let upwards = Letters {
        upwards: true,
        ..letters(11.5, false, HPos::Center)
    };
    canvas.text(panel.y_label, beside, upwards);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_are_cut_at_the_ends_of_the_plot() {
        let (top, bottom) = (10.0, 20.0);
        let cut = |from, to| cut(from, to, top, bottom);
        assert_eq!(
            cut((0.0, 0.0), (4.0, 40.0)),
            Some(((1.0, 10.0), (2.0, 20.0)))
        );
        assert_eq!(
            cut((0.0, 15.0), (2.0, 25.0)),
            Some(((0.0, 15.0), (1.0, 20.0)))
        );
        assert_eq!(
            cut((0.0, 12.0), (5.0, 12.0)),
            Some(((0.0, 12.0), (5.0, 12.0)))
        );
        assert_eq!(cut((0.0, 21.0), (5.0, 21.0)), None);
        assert_eq!(cut((0.0, 25.0), (5.0, 30.0)), None);
    }
}
