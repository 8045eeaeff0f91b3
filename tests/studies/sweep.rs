//! Studies: estimated, run, kept in a journal, summed up.

mod between;
mod blocks;
mod estimate;
mod file;
pub(crate) mod fixture;
mod journal;
mod run;
mod summary;
mod total;
