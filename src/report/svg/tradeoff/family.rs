//! Families of methods, each with a shape.

use super::super::canvas::{Canvas, Point};
use crate::method::{Inner, Method};
use crate::quadrature::Rule;
use plotters::prelude::RGBColor;

/// Methods that work alike.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Family {
    NewtonCotes,
    Gauss,
    Compositing,
    Preintegrated,
    Random,
}

impl Family {
    pub(super) const ALL: [Family; 5] = [
        Family::NewtonCotes,
        Family::Gauss,
        Family::Compositing,
        Family::Preintegrated,
        Family::Random,
    ];

    pub(super) fn of(method: &Method) -> Family {
        let is_gauss = |rule| matches!(rule, Rule::GaussLegendre(_));
        match method {
            Method::Composited(_) => Family::Compositing,
            Method::Preintegrated(_) => Family::Preintegrated,
            Method::Nested(nested) => match nested.inner {
                Inner::MonteCarlo { .. } => Family::Random,
                Inner::PerSegment(rule) if is_gauss(rule) => Family::Gauss,
                _ if is_gauss(nested.outer.0) => Family::Gauss,
                _ => Family::NewtonCotes,
            },
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Family::NewtonCotes => "Newton–Cotes",
            Family::Gauss => "Gauss",
            Family::Compositing => "compositing",
            Family::Preintegrated => "pre-integration",
            Family::Random => "random depths",
        }
    }

    pub(super) fn draw(self, canvas: &mut Canvas<'_>, at: Point, size: f64, color: RGBColor) {
        match self {
            Family::NewtonCotes => canvas.circle(at, size, color),
            Family::Gauss => polygon(canvas, at, 1.25 * size, 4, 0.0, color),
            Family::Compositing => polygon(canvas, at, 1.3 * size, 3, -0.25, color),
            Family::Preintegrated => polygon(canvas, at, 1.25 * size, 4, 0.125, color),
            Family::Random => polygon(canvas, at, 1.3 * size, 3, 0.25, color),
        }
    }
}

/// A regular polygon whose first corner is `turn` full turns past the right.
fn polygon(
    canvas: &mut Canvas<'_>,
    (x, y): Point,
    radius: f64,
    corners: u32,
    turn: f64,
    color: RGBColor,
) {
    let corner = |k: u32| {
        let angle = (f64::from(k) / f64::from(corners) + turn) * std::f64::consts::TAU;
        (x + radius * angle.cos(), y + radius * angle.sin())
    };
    let points: Vec<Point> = (0..corners).map(corner).collect();
    canvas.polygon(&points, color);
}
