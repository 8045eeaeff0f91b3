//! The mark at one level: its shape tells the error's sign, its filling the fit's window.

use super::canvas::{Canvas, Point};
use super::curve::Mark;
use super::style::WHITE;
use plotters::prelude::RGBColor;

/// Later curves are thinner, so that they do not hide those that they coincide with.
pub(super) fn line_width(index: usize) -> f64 {
    [3.4, 2.4, 1.7, 1.1][index.min(3)]
}

fn radius(index: usize) -> f64 {
    [4.6, 3.9, 3.3, 2.8][index.min(3)]
}

/// A disc, or a triangle pointing down where the error is negative; hollow outside the window.
pub(super) fn draw(canvas: &mut Canvas<'_>, at: Point, mark: &Mark, index: usize, color: RGBColor) {
    let radius = radius(index);
    shape(canvas, at, mark.negative, radius, color);
    if !mark.fitted {
        shape(canvas, at, mark.negative, (radius - 1.3).max(1.0), WHITE);
    }
}

fn shape(canvas: &mut Canvas<'_>, at: Point, negative: bool, radius: f64, color: RGBColor) {
    if negative {
        canvas.polygon(&pointing_down(at, 1.25 * radius), color);
    } else {
        canvas.circle(at, radius, color);
    }
}

/// An equilateral triangle round its center.
fn pointing_down((x, y): Point, radius: f64) -> [Point; 3] {
    let half = radius * 3_f64.sqrt() / 2.0;
    [
        (x - half, y - radius / 2.0),
        (x + half, y - radius / 2.0),
        (x, y + radius),
    ]
}
