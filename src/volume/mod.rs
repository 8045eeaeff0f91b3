//! A volume as renderers have it: samples on a grid, transfer functions by control points, a camera.
//!
//! The field between samples is what a renderer makes of it; `raycast` and `case::volume` stand to the right.

mod camera;
pub mod file;
mod grid;
mod transfer;

pub use camera::{Camera, Lens, Ray};
pub use grid::{Grid, Samples};
pub use transfer::{ControlPoint, TransferFunction};
