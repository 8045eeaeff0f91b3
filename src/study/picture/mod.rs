//! A renderer of volumes put to the test: the step along rays, the grid of samples, the pixel.
//!
//! After Etiene, Jönsson, Ropinski, Scheidegger, Comba, Nonato, Kirby, Ynnerman and Silva, *Verifying Volume Rendering Using
//! Discretization Error Analysis*, TVCG 20 (2014).

mod classes;
mod ladder;
mod likeness;
mod measured;
mod norms;
mod orders;
mod own;
mod pixels;
mod plan;
mod program;
mod renderer;
mod run;

pub use classes::{Class, classes};
pub use likeness::{Likeness, likeness};
pub use measured::{Level, Lost, Map, Measured, Pictures};
pub use norms::{Norms, norms};
pub use own::{Own, OwnError};
pub use plan::{Axis, PixelIs, Plan};
pub use program::{PLACEHOLDERS, Program, ProgramOptions};
pub use renderer::{Asked, RenderError, Rendered, Renderer};
pub use run::pictures;
