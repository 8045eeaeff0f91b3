//! Many runs: studies, what accuracy costs, plans, extremes, and the command line's promises.

// A test may stop at what a library must not; its numbers are often exact.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::float_cmp
)]

mod budgets;
mod command_line;
mod every;
mod input;
mod nonsmooth;
mod pipes;
mod plan;
mod progress;
mod report;
mod run;
mod shards;
mod standing;
mod stress;
mod study;
mod sweep;
mod tradeoff;
