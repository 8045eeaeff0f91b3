//! `volver verify` and `volver check` keep their contract, whatever kernel they are given.

mod ask;
mod baseline;
mod batch;
mod caller;
mod declares;
mod help;
mod kernels;
mod new;
mod outputs;
mod promises;
pub(crate) mod run;
mod signals;
mod trouble;
mod usage;
