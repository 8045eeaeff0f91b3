//! Where rays enter the box of the samples, and where they leave it.

use super::{LastStep, RaycastError};
use crate::volume::{Grid, Ray};

/// How near to a face counts as on it, and how little more than n steps as n, in parts: what rounding leaves of a camera that
/// was turned, and nothing that anybody means.
const ROUNDING: f64 = 1e-12;

/// From space to places of the grid, sample (i, j, k) standing at (i, j, k).
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Row by row.
    to_places: [[f64; 3]; 3],
    origin: [f64; 3],
    /// The last sample's place.
    last: [f64; 3],
    /// The length of the longest line through the box.
    diagonal: f64,
}

/// The part of a ray inside the box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Span {
    /// Where it begins, in places of the grid.
    pub(super) start: [f64; 3],
    /// How the place changes over a unit of length.
    pub(super) direction: [f64; 3],
    /// In units of length.
    pub(super) length: f64,
}

/// How a ray is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Steps {
    /// How many segments.
    pub(super) count: usize,
    /// The length of all but the last.
    pub(super) step: f64,
    /// Where the last one ends, in steps: above `count` − 1, up to `count`.
    pub(super) end: f64,
}

impl Frame {
    pub(super) fn new(grid: &Grid) -> Result<Frame, RaycastError> {
        let Grid {
            dimensions,
            origin,
            spacing,
            direction: [[a, b, c], [d, e, f], [g, h, i]],
            ..
        } = *grid;
        let determinant = grid.determinant();
        let cofactors = [
            [e * i - f * h, c * h - b * i, b * f - c * e],
            [f * g - d * i, a * i - c * g, c * d - a * f],
            [d * h - e * g, b * g - a * h, a * e - b * d],
        ];
        let to_places = [0, 1, 2]
            .map(|axis| cofactors[axis].map(|cofactor| cofactor / determinant / spacing[axis]));
        let numbers = to_places.as_flattened().iter().chain(&origin);
        let is_placed = numbers.copied().all(f64::is_finite)
            && spacing
                .into_iter()
                .all(|width| width > 0.0 && width.is_finite());
        if !is_placed {
            return Err(RaycastError::Place);
        }
        let last = dimensions.map(|count| count.saturating_sub(1) as f64);
        let corner = grid.place([0.0; 3]);
        let lines = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|[y, z]| {
            let far = [last[0], y * last[1], z * last[2]];
            let [x, y, z] = grid.place(far);
            (x - corner[0]).hypot(y - corner[1]).hypot(z - corner[2])
        });
        let diagonal = lines.into_iter().fold(0.0, f64::max);
        Ok(Frame {
            to_places,
            origin,
            last,
            diagonal,
        })
    }

    pub(super) fn diagonal(&self) -> f64 {
        self.diagonal
    }

    fn turned(&self, vector: [f64; 3]) -> [f64; 3] {
        self.to_places
            .map(|[a, b, c]| a * vector[0] + b * vector[1] + c * vector[2])
    }

    /// What a ray has inside the box, its faces, edges and corners included; `None` where it passes.
    ///
    /// A ray that moves less along an axis than rounding does, while it crosses the box, is one along a face: what is asked
    /// of it is whether it lies between both, or on one.
    pub(super) fn span(&self, ray: &Ray) -> Option<Span> {
        let from = [0, 1, 2].map(|axis| ray.origin[axis] - self.origin[axis]);
        let start = self.turned(from);
        let mut direction = self.turned(ray.direction);
        let (mut enter, mut leave) = (0.0_f64, f64::INFINITY);
        for axis in 0..3 {
            let last = self.last[axis];
            let near = ROUNDING * last.max(start[axis].abs());
            if direction[axis].abs() * self.diagonal <= near {
                direction[axis] = 0.0;
                // Not a number is nowhere.
                if !(start[axis] >= -near && start[axis] <= last + near) {
                    return None;
                }
                continue;
            }
            let ends = [0.0, last].map(|face| (face - start[axis]) / direction[axis]);
            enter = enter.max(ends[0].min(ends[1]));
            leave = leave.min(ends[0].max(ends[1]));
        }
        // Rounding may put the ends of a ray through an edge in the wrong order: it is on the edge.
        let is_hit = leave >= enter - ROUNDING * enter.max(self.diagonal) && leave.is_finite();
        is_hit.then(|| Span {
            start: [0, 1, 2]
                .map(|axis| (start[axis] + enter * direction[axis]).clamp(0.0, self.last[axis])),
            direction,
            length: (leave - enter).max(0.0),
        })
    }
}

impl Span {
    /// Cuts it in as many segments of a length as it takes.
    pub(super) fn cut(&self, step: f64, last: LastStep) -> Steps {
        let steps = self.length / step;
        // Up to 2³⁰, as was checked.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let count = ((steps * (1.0 - ROUNDING)).ceil() as usize).max(1);
        match last {
            LastStep::Equal => self.cut_evenly(count),
            LastStep::Shorter => Steps {
                count,
                step,
                end: steps.min(count as f64),
            },
        }
    }

    pub(super) fn cut_evenly(&self, count: usize) -> Steps {
        let end = count as f64;
        Steps {
            count,
            step: self.length / end,
            end,
        }
    }
}
