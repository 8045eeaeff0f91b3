//! What methods and their rules compute: by their definitions, in every format, at the orders that theory gives.

// A test may stop at what a library must not; its numbers are often exact.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::float_cmp
)]

mod compositing;
mod definitions;
mod even;
mod layers;
mod method;
mod method_names;
mod precision;
mod properties;
mod quadrature;
mod random_cases;
mod rays;
mod rules;
mod sharing;
