//! What was measured, as documents, and what the back ends make of them.

#![allow(clippy::unwrap_used, clippy::panic, clippy::float_cmp)] // A test may stop, and may know a number exactly.

mod entries;
mod fixture;
mod plan;
mod plots;
mod stress;
mod study;
mod svg;
mod tradeoff;
mod verify;
