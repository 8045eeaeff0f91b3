//! Studies: estimated, run, kept in a journal, summed up.

mod between;
mod estimate;
mod file;
mod fixture;
mod journal;
mod run;
mod summary;
mod total;
