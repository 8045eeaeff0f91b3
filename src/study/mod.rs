//! What to run, and running it: methods × levels × formats, node values shared.

pub mod nonsmooth;
pub mod plan;
pub mod reproduce;
pub(crate) mod run;
pub mod stress;
pub mod sweep;
pub mod tradeoff;
pub mod verify;

pub use run::{Progress, Run, Silent, samples};
