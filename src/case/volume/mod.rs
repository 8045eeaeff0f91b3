//! A field in space, by a formula, seen by a camera: a picture every pixel of which is a case of its own.
//!
//! A ray x = o + λ u enters the box of the volume at λ₀ and leaves it at λ₁; with s(x) and the transfer functions τ(s)
//! and C(s), the pixel is ∫ C τ e^(−∫τ) dλ from λ₀ to λ₁. Outside the box there is nothing.

mod breaks;
pub mod catalogue;
mod chord;
mod field;
mod file;
mod ray;

pub use breaks::{Break, breaks};
pub use chord::{Chord, chord};
pub use field::{Field, Shape};
pub use file::{VolumeFile, VolumeFileError, VolumeProblem, read};

use crate::volume::{Camera, Grid, Ray, Samples, TransferFunction};

/// A volume by formulas, and who looks at it.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeCase {
    /// Its name.
    pub name: String,
    /// In a few words.
    pub title: String,
    /// The corners of the box along the axes: the least coordinates, then the largest.
    pub corners: [[f64; 3]; 2],
    /// s(x).
    pub field: Field,
    /// τ(s) and C(s).
    pub transfer: TransferFunction,
    /// Who looks at it.
    pub camera: Camera,
}

impl VolumeCase {
    /// The part of a ray in the box; `None` where it misses it.
    #[must_use]
    pub fn chord(&self, ray: &Ray) -> Option<Chord> {
        chord(self.corners, ray)
    }

    /// The field on a grid of so many samples along the axes, the outermost on the faces of the box.
    #[must_use]
    pub fn sampled(&self, dimensions: [usize; 3]) -> Grid {
        let [low, high] = self.corners;
        let spacing = [0, 1, 2].map(|axis| {
            let cells = dimensions[axis].saturating_sub(1).max(1) as f64;
            (high[axis] - low[axis]) / cells
        });
        let mut grid = Grid {
            dimensions,
            origin: low,
            spacing,
            direction: Grid::ALONG_AXES,
            samples: Samples::F64(Vec::new()),
        };
        let [width, height, depth] = dimensions;
        let mut values = Vec::with_capacity(width * height * depth);
        for k in 0..depth {
            for j in 0..height {
                for i in 0..width {
                    values.push(self.field.at(grid.place([i as f64, j as f64, k as f64])));
                }
            }
        }
        grid.samples = Samples::F64(values);
        grid
    }
}
