//! What to run, and running it: methods × levels × formats, node values shared.

pub mod nonsmooth;
pub mod reproduce;
pub mod sweep;
mod run;

pub use run::{Progress, Run, Silent, samples};
