//! A renderer of volumes: rays through samples on a grid, integrated by the crate's own methods.
//!
//! A pixel is I = ∫ C(s) τ(s) exp(−∫ τ(s)) dλ along the ray through its middle, from where that ray enters the box of the
//! samples (or from the camera, where it stands inside) to where it leaves it. s is made of the samples by [`Interpolation`],
//! and the ray is cut in n segments of the length [`Raycaster::step`] or a little less.
//!
//! Two errors add up: that of the method in the step, whose order [`expected`](crate::method::expected) states, and that of
//! the interpolation in the distance h of samples, whose order [`Interpolation::order`] states. Where interpolants of cells
//! meet they have kinks, so that methods above order 2 keep their orders only where h falls with the step.
//!
//! Rays go side by side in [lanes](crate::real::lanes), in binary32 or binary64, and pictures have the same bits whatever the
//! width and however many the threads. The samples are read in place.
//!
//! ```
//! use volver::raycast::{Interpolation, LastStep, Precision, Raycaster};
//! use volver::volume::{Camera, ControlPoint, Grid, Lens, Samples, TransferFunction};
//!
//! // s = x on 9 x 9 x 9 samples, tau = 2 s, C = 1.
//! let grid = Grid {
//!     dimensions: [9; 3],
//!     origin: [0.0; 3],
//!     spacing: [0.125; 3],
//!     direction: Grid::ALONG_AXES,
//!     samples: Samples::F32((0..729_u16).map(|i| f32::from(i % 9) / 8.0).collect()),
//! };
//! let point = |s, extinction| ControlPoint { s, extinction, emission: vec![1.0] };
//! let transfer = TransferFunction {
//!     channels: vec!["light".into()],
//!     points: vec![point(0.0, 0.0), point(1.0, 2.0)],
//! };
//! let picture = Raycaster {
//!     grid: &grid,
//!     transfer: &transfer,
//!     camera: Camera {
//!         position: [-2.0, 0.5, 0.5],
//!         target: [0.5; 3],
//!         up: [0.0, 0.0, 1.0],
//!         lens: Lens::Orthographic { height: 1.0 },
//!     },
//!     size: [4, 4],
//!     step: 1.0 / 256.0,
//!     last_step: LastStep::Equal,
//!     interpolation: Interpolation::Linear,
//!     method: "front-to-back/middle/expm1".parse()?,
//!     precision: Precision::Binary64,
//!     opacity: false,
//! }
//! .render()?;
//!
//! // t = 1 through the whole cube.
//! assert_eq!(picture.hits, 16);
//! assert!((picture.image.pixel(1, 2)[0] - (1.0 - f64::exp(-1.0))).abs() < 1e-6);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// What takes lanes must be inlined into the function that has the instructions.
#![allow(clippy::inline_always)]

mod bundle;
mod error;
mod integrate;
mod interpolate;
mod nodes;
mod number;
mod row;
mod rows;
mod span;
mod table;
mod way;

pub use error::RaycastError;
pub use interpolate::Interpolation;

use crate::image::Image;
use crate::method::Method;
use crate::volume::{Camera, ControlPoint, Grid, TransferFunction};
use span::Frame;
use std::borrow::Cow;

/// In which numbers rays are integrated. Where a ray meets the box is worked out in binary64.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Precision {
    /// `f32-lanes`.
    Binary32,
    /// `f64-lanes`.
    Binary64,
}

/// What becomes of a ray that is no multiple of the step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LastStep {
    /// All its segments are alike, and a little shorter than the step: the method keeps its order.
    Equal,
    /// All have the length of the step, and the last has what is left.
    Shorter,
}

/// A volume, who looks at it, and how.
#[derive(Clone, Copy, Debug)]
pub struct Raycaster<'v> {
    /// The samples: at least 2 along each axis, under [`Interpolation::Cubic`] at least 4.
    pub grid: &'v Grid,
    /// τ and C of the field's values.
    pub transfer: &'v TransferFunction,
    /// Who looks.
    pub camera: Camera,
    /// Pixels in a row, and rows.
    pub size: [usize; 2],
    /// The length of a segment, above 0; the most there is of it where segments are [`LastStep::Equal`].
    pub step: f64,
    /// What becomes of the rest.
    pub last_step: LastStep,
    /// The field between samples.
    pub interpolation: Interpolation,
    /// How rays are integrated. `front-to-back/POSITION/OPACITY` with subtraction, expm1 or linear and one way or another to
    /// keep the transmittance, and `trapezoid/trapezoid`, go in lanes; every other method of the crate goes ray by ray and
    /// channel by channel, on the next number of segments that it takes.
    pub method: Method,
    /// In which numbers.
    pub precision: Precision,
    /// Whether the picture has a last channel, [`OPACITY`](Raycaster::OPACITY).
    pub opacity: bool,
}

/// A picture, and how much of it shows the volume.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Radiance, with nothing behind the volume; 0 where a ray misses it.
    pub image: Image,
    /// How many rays meet the volume's box.
    pub hits: usize,
}

impl Raycaster<'_> {
    /// The name of the channel of opacity: the radiance of C = 1 everywhere, by the same method; 1 − exp(−∫ τ) in the limit.
    pub const OPACITY: &'static str = "opacity";

    /// Casts a ray through the middle of every pixel, on all threads.
    ///
    /// Takes the memory of the picture beside that of the volume, and less than a megabyte a thread; methods that do not go in
    /// lanes also the samples of a ray.
    ///
    /// # Errors
    /// [`RaycastError`] where the camera looks nowhere, the step is none, the grid or the transfer function is none, the
    /// picture has no pixels, or the method does not go on rays such as these.
    pub fn render(&self) -> Result<Picture, RaycastError> {
        let frame = Frame::new(self.grid)?;
        let transfer = self.with_opacity();
        error::check(self, &frame, &transfer)?;
        rows::render(self, &frame, &transfer)
    }

    fn with_opacity(&self) -> Cow<'_, TransferFunction> {
        let mut transfer = Cow::Borrowed(self.transfer);
        if self.opacity {
            let owned = transfer.to_mut();
            owned.channels.push(Self::OPACITY.into());
            for ControlPoint { emission, .. } in &mut owned.points {
                emission.push(1.0);
            }
        }
        transfer
    }
}
