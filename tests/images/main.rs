//! Volumes and pictures: their files, the library's renderer, renderers put to the test.

// A test may stop, and its numbers are often exact.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::float_cmp
)]

mod command;
mod files;
mod picture;
mod raycast;
