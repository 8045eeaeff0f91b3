//! Numbers of every format: each is the nearest one, functions keep their promises, names come back, and counting
//! counts what is done.

// A test may stop, and its numbers are often exact.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::float_cmp
)]

mod any;
mod coarse_formats;
mod counted;
mod elementary;
mod formats;
mod lanes;
mod names;
mod scalars;
mod special;
mod tally;
