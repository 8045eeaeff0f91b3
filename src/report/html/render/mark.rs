//! The marks of a plot: their shape tells the series, their filling what [`Point::filled`] says.

use crate::report::html::Point;
use std::fmt::Write;

const RADIUS: f64 = 4.2;

/// The outline of a mark, as the `d` of a path. Colours are not all that tells series apart.
pub(super) fn outline(point: &Point, (x, y): (f64, f64), series: usize) -> String {
    if point.negative {
        return polygon((x, y), &[(0.0, 1.35), (-1.2, -0.75), (1.2, -0.75)]);
    }
    match series % 4 {
        0 => circle((x, y)),
        1 => polygon(
            (x, y),
            &[(-0.95, -0.95), (0.95, -0.95), (0.95, 0.95), (-0.95, 0.95)],
        ),
        2 => polygon(
            (x, y),
            &[(0.0, -1.35), (1.35, 0.0), (0.0, 1.35), (-1.35, 0.0)],
        ),
        _ => polygon((x, y), &[(0.0, -1.35), (1.2, 0.75), (-1.2, 0.75)]),
    }
}

fn circle((x, y): (f64, f64)) -> String {
    let (left, r, across) = (x - RADIUS, RADIUS, 2.0 * RADIUS);
    format!("M{left:.2} {y:.2}a{r} {r} 0 1 0 {across} 0a{r} {r} 0 1 0 -{across} 0z")
}

fn polygon((x, y): (f64, f64), corners: &[(f64, f64)]) -> String {
    path(
        corners
            .iter()
            .map(|(dx, dy)| Some((x + RADIUS * dx, y + RADIUS * dy))),
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
