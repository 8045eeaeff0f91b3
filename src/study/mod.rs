//! What to run, and running it: methods × levels × formats, node values shared.

#[cfg(feature = "studies")]
pub mod adjoint;
#[cfg(feature = "studies")]
pub mod extremes;
#[cfg(feature = "studies")]
pub mod gradient;
#[cfg(feature = "studies")]
pub mod nonsmooth;
#[cfg(feature = "studies")]
pub mod picture;
#[cfg(feature = "studies")]
pub mod plan;
#[cfg(feature = "studies")]
pub mod reproduce;
pub(crate) mod run;
#[cfg(feature = "studies")]
pub mod shards;
#[cfg(feature = "studies")]
pub mod stress;
#[cfg(feature = "studies")]
pub mod sweep;
#[cfg(feature = "studies")]
pub mod tradeoff;
pub mod verify;

pub use run::{Progress, Run, Silent, samples};
