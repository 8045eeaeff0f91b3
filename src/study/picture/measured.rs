//! What was measured of a renderer.

use super::classes::Class;
use super::norms::Norms;
use super::plan::Axis;
use crate::convergence::Fit;
use crate::image::Image;
use serde::Serialize;

/// The part of an error that those of the other axes may be.
pub(super) const TENTH: f64 = 0.1;
/// An order this much lower is lost.
pub(super) const HALF: f64 = 0.5;

/// One picture of an axis beside the exact one.
#[derive(Clone, Debug, Serialize)]
pub struct Level {
    /// Cells, steps along the diagonal, or pixels along the shorter side.
    pub count: usize,
    /// The length of a step, the distance of samples, or the size of a pixel, in units of length at the target.
    pub size: f64,
    /// Of all pixels whose rays hit the volume.
    pub all: Norms,
    /// Of those where everything is analytic.
    pub smooth: Norms,
    /// What the errors of the other two axes may be, by the same norm (L2).
    pub others: f64,
    /// Whether these are under a tenth.
    pub is_clean: bool,
}

/// What is known of an axis.
#[derive(Clone, Debug, Serialize)]
pub struct Measured {
    /// Which.
    pub axis: Axis,
    /// From coarse to fine.
    pub levels: Vec<Level>,
    /// The order of L2 over smooth pixels.
    pub fit: Option<Fit>,
    /// Orders of max, L1 and L2 over all pixels.
    pub orders: [Option<f64>; 3],
    /// Whether errors are differences of levels one behind the other: those of the other axes, which stay, take no part.
    pub by_differences: bool,
    /// What was expected.
    pub expected: Option<f64>,
    /// The size of steps is that of equal segments: known, or because errors fall more steadily in it.
    pub equal_segments: bool,
    /// Refining it changes nothing beyond rounding: it has no error here.
    pub changes_nothing: bool,
    /// Where the order is lost.
    pub lost: Vec<Lost>,
    /// The order of every pixel, by its two finest levels; NaN where there is none.
    #[serde(skip)]
    pub per_pixel: Option<Map>,
    /// The error of every pixel at the finest level, the largest of its channels.
    #[serde(skip)]
    pub error: Option<Map>,
}

impl Measured {
    /// Orders of the last three refinements, coarse to fine, where they do not go to what is expected, though there is no
    /// window and the errors of the other axes are small: more than a half below, they fall, go up and down, or rise by less and less
    /// to a limit that is below as well (Aitken's).
    #[must_use]
    pub fn falls_short(&self) -> Option<[f64; 3]> {
        let [.., a, b, c, d] = self.levels.as_slice() else {
            return None;
        };
        let least = self.expected? - HALF;
        let order = |coarse: &Level, fine: &Level| {
            let error = (coarse.smooth.l2 / fine.smooth.l2).ln();
            error / (coarse.size / fine.size).ln()
        };
        let orders = [order(a, b), order(b, c), order(c, d)];
        let [first, second, third] = orders;
        let (before, now) = (second - first, third - second);
        let limit = if now <= 0.0 && before <= 0.0 {
            third
        } else if now > 0.0 && before > 0.0 {
            if now < before {
                third + now * now / (before - now)
            } else {
                f64::INFINITY
            }
        } else {
            first.max(second).max(third)
        };
        let is_clean = [a, b, c, d].iter().all(|level| level.is_clean);
        (is_clean && limit < least).then_some(orders)
    }
}

/// A number for every pixel.
#[derive(Clone, Debug)]
pub struct Map {
    /// Pixels in a row.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// From the upper left corner.
    pub values: Vec<f64>,
}

/// Pixels of a class, and how many of them lose order.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Lost {
    /// What their rays meet.
    pub class: Class,
    /// How many there are.
    pub pixels: usize,
    /// Of how many an order shows.
    pub shown: usize,
    /// How many of these are more than a half below what is expected, or seen on smooth pixels.
    pub lower: usize,
    /// The part of the squared error at the finest level.
    pub share: f64,
}

/// Everything that was measured of a renderer on a volume.
#[derive(Debug)]
pub struct Pictures {
    /// The renderer.
    pub renderer: String,
    /// By axis.
    pub axes: Vec<Measured>,
    /// The finest picture, with the exact one.
    pub finest: Image,
    /// The exact one.
    pub exact: Image,
    /// The next coarser one in all of step and grid, at the same size.
    pub coarser: Image,
    /// What is left of the errors of step and grid at the finest levels, L2 over smooth pixels; 0 where nothing is known.
    pub left: f64,
    /// Pixels whose values are no finite numbers.
    pub not_finite: usize,
    /// The quantum of values.
    pub quantum: Option<f64>,
    /// The classes of pixels.
    pub classes: Vec<Class>,
}
