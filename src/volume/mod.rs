//! A volume as renderers have it: samples on a grid, transfer functions by control points, a camera.
//!
//! The field between samples is what a renderer makes of it; `raycast` and `case::volume` stand to the right.

mod camera;
mod grid;
mod transfer;

pub use camera::{Camera, Lens, Ray};
pub use grid::{Grid, Samples};
pub use transfer::{ControlPoint, TransferFunction};
