//! Volumes and pictures: what is read, and what the renderer makes of it.

// A test may stop, and its numbers are often exact.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::float_cmp
)]

mod raycast;
