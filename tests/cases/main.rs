//! Cases: expressions and what is derived of them, closed forms and what proves them, files, scenes, and the
//! programs that write them out.

// A test may stop, and its numbers are often exact.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::float_cmp
)]

mod case;
mod cases;
mod catalogue;
mod generated_code;
mod manufacture;
mod mutations;
mod proofs;
mod scene;
mod symbolic;
mod truths;
mod volume;
