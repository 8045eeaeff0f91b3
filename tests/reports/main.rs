//! What was measured, as documents, and what the back ends make of them.

#![allow(clippy::unwrap_used, clippy::panic)] // A test may stop.

mod fixture;
mod study;
mod tradeoff;
