//! A place for each slope triangle where it covers nothing.

use super::area::Area;
use super::canvas::{Point, text_width};
use super::triangle::{LABEL_SIZE, Side, Triangle};

/// Distances between a triangle and its curve, tried in this order.
const GAPS: [f64; 3] = [9.0, 13.0, 20.0];
/// Widths as shares of the plot's.
const WIDTHS: [f64; 4] = [0.18, 0.14, 0.1, 0.07];
/// A triangle takes no more of the plot's height than this.
const MAX_HEIGHT: f64 = 0.38;
const MIN_WIDTH: f64 = 12.0;
/// Places tried along the window.
const PLACES: u32 = 16;
/// With more points of curves covered than this, no triangle is better.
const MOST_COVERED: usize = 4;

/// Points on a path, some 3 pixels apart: what a triangle must not cover.
pub(super) fn points_along(path: &[Point]) -> Vec<Point> {
    let mut points: Vec<Point> = path.first().copied().into_iter().collect();
    for ends in path.windows(2) {
        let (from, to) = (ends[0], ends[1]);
        let pieces = ((to.0 - from.0).hypot(to.1 - from.1) / 3.0)
            .ceil()
            .clamp(1.0, 1e4);
        let mut piece = 1.0;
        while piece <= pieces {
            let share = piece / pieces;
            points.push((
                from.0 + share * (to.0 - from.0),
                from.1 + share * (to.1 - from.1),
            ));
            piece += 1.0;
        }
    }
    points
}

/// A stretch of a curve that a triangle may stand at.
pub(super) struct Stretch<'a> {
    /// The curve in its window, from left to right.
    pub(super) path: &'a [Point],
    /// Rise in pixels (downwards) a pixel.
    pub(super) slope: f64,
    pub(super) label: &'a str,
}

/// The best place for a triangle at one of the stretches: inside `plot`, off the curves, off the
/// `taken` triangles.
pub(super) fn place(
    stretches: &[Stretch<'_>],
    plot: &Area,
    curves: &[Point],
    taken: &[Triangle],
) -> Option<Triangle> {
    let mut best: Option<(f64, Triangle)> = None;
    for stretch in stretches {
        for (cost, triangle) in candidates(stretch, plot) {
            let bounds = triangle.bounds();
            let free = |other: &Triangle| !other.bounds().meets(&bounds);
            if !bounds.lies_in(plot) || !taken.iter().all(free) {
                continue;
            }
            let covered = curves.iter().filter(|p| triangle.covers(**p)).count();
            let cost = cost + 100.0 * covered as f64;
            let better = best.is_none_or(|(least, _)| cost < least);
            if covered <= MOST_COVERED && better {
                best = Some((cost, triangle));
            }
        }
    }
    best.map(|(_, triangle)| triangle)
}

/// Triangles along a stretch, each with what is to be said against its shape.
fn candidates(stretch: &Stretch<'_>, plot: &Area) -> Vec<(f64, Triangle)> {
    let slope = stretch.slope;
    let (Some(first), Some(last)) = (stretch.path.first(), stretch.path.last()) else {
        return Vec::new();
    };
    let label_width = text_width(stretch.label, LABEL_SIZE);
    let highest = MAX_HEIGHT * (plot.bottom - plot.top);
    let mut found = Vec::new();
    for width in WIDTHS.map(|share| share * (plot.right - plot.left)) {
        let width = width.min(highest / slope.abs());
        if !width.is_finite() || width < MIN_WIDTH || width > last.0 - first.0 {
            continue;
        }
        for place in 0..=PLACES {
            let share = f64::from(place) / f64::from(PLACES);
            let x = first.0 + width / 2.0 + share * (last.0 - first.0 - width);
            let Some(y) = height_at(stretch.path, x) else {
                continue;
            };
            for side in [Side::Below, Side::Above] {
                for gap in GAPS {
                    // Perpendicular to the curve.
                    let down = gap * slope.hypot(1.0);
                    let y = if side == Side::Below {
                        y + down
                    } else {
                        y - down
                    };
                    let cost = 4.0 * (0.5 - share).abs()
                        + gap / 4.0
                        + 20.0 * (WIDTHS[0] - width / (plot.right - plot.left))
                        + if side == Side::Above { 0.5 } else { 0.0 };
                    found.push((cost, Triangle::new((x, y), width, slope, side, label_width)));
                }
            }
        }
    }
    found
}

/// The height of a path at x, between its points.
fn height_at(path: &[Point], x: f64) -> Option<f64> {
    let ends = path.windows(2).find(|w| w[0].0 <= x && x <= w[1].0)?;
    let width = ends[1].0 - ends[0].0;
    let share = if width > 0.0 {
        (x - ends[0].0) / width
    } else {
        0.0
    };
    Some(ends[0].1 + share * (ends[1].1 - ends[0].1))
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLOT: Area = Area {
        left: 0.0,
        top: 0.0,
        right: 300.0,
        bottom: 200.0,
    };

    #[test]
    fn a_triangle_keeps_off_curves_and_other_triangles() {
        let path = [(10.0, 10.0), (290.0, 150.0)];
        let other = [(10.0, 60.0), (290.0, 200.0)];
        let stretches = [Stretch {
            path: &path,
            slope: 0.5,
            label: "1.00",
        }];
        let curves: Vec<Point> = [points_along(&path), points_along(&other)].concat();
        let mut taken = Vec::new();
        for _ in 0..2 {
            let triangle = place(&stretches, &PLOT, &curves, &taken).unwrap();
            assert!(triangle.bounds().lies_in(&PLOT));
            assert!(!curves.iter().any(|p| triangle.covers(*p)), "{triangle:?}");
            assert!(
                !taken
                    .iter()
                    .any(|t: &Triangle| t.bounds().meets(&triangle.bounds()))
            );
            taken.push(triangle);
        }
    }

    #[test]
    fn no_place_no_triangle() {
        let path = [(10.0, 10.0), (290.0, 150.0)];
        let stretch = |slope| Stretch {
            path: &path,
            slope,
            label: "1.00",
        };
        let everywhere: Vec<Point> = (0..300)
            .flat_map(|x| (0..40).map(move |y| (f64::from(x), f64::from(5 * y))))
            .collect();
        assert_eq!(place(&[stretch(0.5)], &PLOT, &everywhere, &[]), None);
        assert_eq!(place(&[stretch(f64::NAN)], &PLOT, &[], &[]), None);
        assert_eq!(place(&[], &PLOT, &[], &[]), None);
    }
}
