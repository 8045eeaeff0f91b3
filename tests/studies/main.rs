//! Many runs: studies, what accuracy costs, plans, extremes, and the command line's promises.

// A test may stop at what a library must not; its numbers are often exact.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::float_cmp
)]

mod command_line;
mod nonsmooth;
mod plan;
mod report;
mod run;
mod standing;
mod stress;
mod study;
mod sweep;
mod tradeoff;
