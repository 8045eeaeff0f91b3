//! What is refined, and how far.

use crate::image::Image;
use crate::reference::ExactPicture;
use serde::Serialize;

/// Points along a pixel's side for its mean.
pub(super) const MEAN_POINTS: u32 = 4;

/// What is refined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// The length of steps along rays.
    Step,
    /// The distance of samples of the grid.
    Grid,
    /// The size of pixels.
    Pixel,
}

impl Axis {
    /// As options have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Axis::Step => "step",
            Axis::Grid => "grid",
            Axis::Pixel => "pixel",
        }
    }
}

/// What a pixel is to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum PixelIs {
    /// The radiance through its middle.
    Centre,
    /// The mean over it.
    Mean,
}

impl PixelIs {
    /// The exact picture of such pixels.
    #[must_use]
    pub fn exact(self, exact: &ExactPicture<'_>, size: [usize; 2]) -> Image {
        match self {
            PixelIs::Centre => exact.centres(size),
            PixelIs::Mean => exact.means(size, MEAN_POINTS),
        }
    }
}

/// The levels of all axes, and what is expected of each.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Steps along the diagonal of the box, by rising number.
    pub steps: Vec<usize>,
    /// Cells of the grid along each axis, by rising number.
    pub cells: Vec<usize>,
    /// Pixels along the shorter side, by rising number.
    pub pixels: Vec<usize>,
    /// Pixels along the shorter side where step and grid are refined.
    pub side: usize,
    /// Width by height of pictures, as a ratio.
    pub aspect: [usize; 2],
    /// Axes that are measured.
    pub axes: Vec<Axis>,
    /// What a pixel is to be where step and grid are refined.
    pub pixel: PixelIs,
    /// Orders that theory gives, where it is known.
    pub expected: [Option<f64>; 3],
}

impl Plan {
    /// The size of pictures of so many pixels along the shorter side.
    #[must_use]
    pub fn size(&self, side: usize) -> [usize; 2] {
        let [width, height] = self.aspect;
        let shorter = width.min(height).max(1);
        [side * width / shorter, side * height / shorter]
    }

    /// Pictures that are made.
    #[must_use]
    pub fn pictures(&self) -> usize {
        let of = |axis: Axis| match axis {
            Axis::Step => self.steps.len(),
            Axis::Grid => self.cells.len(),
            Axis::Pixel => self.pixels.len(),
        };
        self.axes.iter().map(|axis| of(*axis)).sum::<usize>() + 1
    }
}
