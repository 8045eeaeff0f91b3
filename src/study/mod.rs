//! What to run, and running it: methods × levels × formats, node values shared.

mod level;
pub mod nonsmooth;
pub mod reproduce;
mod run;

pub use level::Level;
pub use run::{Progress, Run, Silent, samples};
