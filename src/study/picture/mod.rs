//! A renderer of volumes put to the test: the step along rays, the grid of samples, the pixel.
//!
//! After Etiene, Jönsson, Ropinski, Scheidegger, Comba, Nonato, Kirby, Ynnerman and Silva, *Verifying Volume Rendering Using
//! Discretization Error Analysis*, TVCG 20 (2014).

mod axes;
mod classes;
mod likeness;
mod norms;
mod own;
mod program;
mod renderer;

pub use axes::{Axis, Level, Lost, Map, Measured, Pictures, PixelIs, Plan, pictures};
pub use classes::{Class, classes};
pub use likeness::{Likeness, likeness};
pub use norms::{Norms, norms};
pub use own::{Own, OwnError};
pub use program::{PLACEHOLDERS, Program, ProgramOptions};
pub use renderer::{Asked, RenderError, Rendered, Renderer};
