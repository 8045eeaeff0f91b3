//! Slope triangles: their geometry.

use super::area::Area;
use super::canvas::Point;

/// The size of a triangle's figure.
pub(super) const LABEL_SIZE: f64 = 11.0;
/// How close a triangle may come to a curve, and a label to anything.
const TRIANGLE_MARGIN: f64 = 6.0;
const LABEL_MARGIN: f64 = 4.0;

/// Which side of its curve a triangle stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    Above,
    Below,
}

/// A right triangle whose hypotenuse has the slope of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Triangle {
    /// Both ends of the hypotenuse, then the right angle.
    pub(super) corners: [Point; 3],
    /// Where the order is written: beside the upright leg.
    pub(super) label: Area,
}

impl Triangle {
    /// `middle` is the middle of the hypotenuse, `slope` its rise in pixels (downwards) a pixel.
    pub(super) fn new(
        middle: Point,
        width: f64,
        slope: f64,
        side: Side,
        label_width: f64,
    ) -> Triangle {
        let (x0, x1) = (middle.0 - width / 2.0, middle.0 + width / 2.0);
        let (y0, y1) = (
            middle.1 - slope * width / 2.0,
            middle.1 + slope * width / 2.0,
        );
        // The right angle is the corner away from the curve.
        let at_left = (side == Side::Below) == (slope > 0.0);
        let right_angle = if at_left { (x0, y1) } else { (x1, y0) };
        let (left, right) = if at_left {
            (x0 - LABEL_MARGIN - label_width, x0 - LABEL_MARGIN)
        } else {
            (x1 + LABEL_MARGIN, x1 + LABEL_MARGIN + label_width)
        };
        Triangle {
            corners: [(x0, y0), (x1, y1), right_angle],
            label: Area {
                left,
                right,
                top: middle.1 - LABEL_SIZE / 2.0,
                bottom: middle.1 + LABEL_SIZE / 2.0,
            },
        }
    }

    /// The least rectangle round triangle and label.
    pub(super) fn bounds(&self) -> Area {
        let [(x0, y0), (x1, y1), _] = self.corners;
        Area {
            left: x0.min(self.label.left),
            right: x1.max(self.label.right),
            top: y0.min(y1).min(self.label.top),
            bottom: y0.max(y1).max(self.label.bottom),
        }
    }

    pub(super) fn covers(&self, point: Point) -> bool {
        self.label.contains(point, LABEL_MARGIN) || self.distance(point) < TRIANGLE_MARGIN
    }

    /// From the triangle's area, 0 inside.
    fn distance(&self, point: Point) -> f64 {
        let [a, b, c] = self.corners;
        let edges = [(a, b), (b, c), (c, a)];
        let turns =
            edges.map(|(p, q)| (q.0 - p.0) * (point.1 - p.1) - (q.1 - p.1) * (point.0 - p.0));
        if turns.iter().all(|t| *t >= 0.0) || turns.iter().all(|t| *t <= 0.0) {
            return 0.0;
        }
        edges
            .map(|(p, q)| distance_to_segment(point, p, q))
            .into_iter()
            .fold(f64::INFINITY, f64::min)
    }
}

fn distance_to_segment(point: Point, from: Point, to: Point) -> f64 {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let square = dx * dx + dy * dy;
    let share = if square > 0.0 {
        (((point.0 - from.0) * dx + (point.1 - from.1) * dy) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (point.0 - from.0 - share * dx).hypot(point.1 - from.1 - share * dy)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hypotenuse_has_the_slope_and_the_right_angle_points_away() {
        for (slope, side, corner) in [
            (2.0, Side::Below, (90.0, 70.0)),
            (2.0, Side::Above, (110.0, 30.0)),
            (-2.0, Side::Below, (110.0, 70.0)),
            (-2.0, Side::Above, (90.0, 30.0)),
        ] {
            let t = Triangle::new((100.0, 50.0), 20.0, slope, side, 24.0);
            let [a, b, c] = t.corners;
            assert_eq!((b.1 - a.1) / (b.0 - a.0), slope);
            assert_eq!(c, corner);
            // The figure stands beside the upright leg, outside.
            let outside = if corner.0 < 100.0 {
                t.label.right < 90.0
            } else {
                t.label.left > 110.0
            };
            assert!(outside, "{t:?}");
        }
    }

    #[test]
    fn distances_are_those_of_the_area() {
        let t = Triangle::new((5.0, 5.0), 10.0, 1.0, Side::Below, 0.0);
        assert_eq!(t.corners, [(0.0, 0.0), (10.0, 10.0), (0.0, 10.0)]);
        assert_eq!(t.distance((2.0, 8.0)), 0.0);
        assert_eq!(t.distance((-3.0, 5.0)), 3.0);
        assert!((t.distance((10.0, 0.0)) - 50_f64.sqrt()).abs() < 1e-12);
    }
}
