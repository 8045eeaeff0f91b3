//! Orders of accuracy, from the reference and the parts of an error to the paper's tables.

// A test may stop at what a library must not; its numbers are often exact.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::float_cmp,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss
)]

mod convergence;
mod fit;
mod gradient_test;
mod model;
mod nonsmooth;
mod paper;
mod reference;
mod reproduce;
mod split;
