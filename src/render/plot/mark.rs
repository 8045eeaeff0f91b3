//! The marks of a plot: their shape tells the series, their filling whether they are filled points.

use crate::document::Point;
use std::fmt::Write;

/// Later curves are smaller, so that they do not hide those that they coincide with.
pub(super) fn size(index: usize) -> f64 {
    [1.2, 1.0, 0.85, 0.7][index.min(3)]
}

const RADIUS: f64 = 4.2;
/// An upright cross, from its left end round.
const CROSS: [(f64, f64); 12] = [
    (-1.3, -0.4),
    (-0.4, -0.4),
    (-0.4, -1.3),
    (0.4, -1.3),
    (0.4, -0.4),
    (1.3, -0.4),
    (1.3, 0.4),
    (0.4, 0.4),
    (0.4, 1.3),
    (-0.4, 1.3),
    (-0.4, 0.4),
    (-1.3, 0.4),
];

/// The outline of a mark, as the `d` of a path. Colours are not all that tells series apart.
pub(super) fn outline(point: &Point, at: (f64, f64), shape: usize, size: f64) -> String {
    let radius = RADIUS * size;
    if point.negative {
        return polygon(at, radius, &[(0.0, 1.35), (-1.2, -0.75), (1.2, -0.75)]);
    }
    match shape % 5 {
        0 => circle(at, radius),
        1 => polygon(
            at,
            radius,
            &[(-0.95, -0.95), (0.95, -0.95), (0.95, 0.95), (-0.95, 0.95)],
        ),
        2 => polygon(
            at,
            radius,
            &[(0.0, -1.35), (1.35, 0.0), (0.0, 1.35), (-1.35, 0.0)],
        ),
        3 => polygon(at, radius, &[(0.0, -1.35), (1.2, 0.75), (-1.2, 0.75)]),
        _ => polygon(at, radius, &CROSS),
    }
}

fn circle((x, y): (f64, f64), radius: f64) -> String {
    let (left, across) = (x - radius, 2.0 * radius);
    format!(
        "M{left:.2} {y:.2}a{radius:.2} {radius:.2} 0 1 0 {across:.2} 0a{radius:.2} {radius:.2} 0 1 0 -{across:.2} 0z"
    )
}

fn polygon((x, y): (f64, f64), radius: f64, corners: &[(f64, f64)]) -> String {
    path(
        corners
            .iter()
            .map(|(dx, dy)| Some((x + radius * dx, y + radius * dy))),
    ) + "z"
}

/// A line through places, broken where there is none.
pub(super) fn path(places: impl Iterator<Item = Option<(f64, f64)>>) -> String {
    let mut path = String::new();
    let mut is_begun = false;
    for place in places {
        // Writing to a String does not fail.
        if let Some((x, y)) = place {
            let _ = write!(path, "{}{x:.2} {y:.2}", if is_begun { "L" } else { "M" });
        }
        is_begun = place.is_some();
    }
    path
}
