//! What was measured, as documents: one builder a command.
//!
//! A builder arranges what a study found into a [`Document`](crate::document::Document); nothing here computes an order, and
//! nothing here knows how a document will look: that is for the back ends of [`render`](crate::render). JSON is the result
//! itself, by serde.
//!
//! | builder | what |
//! |---|---|
//! | [`reproduce`] | the paper's tables, measured again |
//! | [`nonsmooth`] | the table of jumps and kinks |
//! | [`study`] | a study of errors and their parts |
//! | [`verify`](mod@verify) | a kernel put to the test |
//! | [`stress`] | digits and verdicts at the extremes |
//! | [`tradeoff`] | error against cost |
//! | [`plan`] | the least model of a scene |
//! | [`comparison`] | several reports on one page, what differs first |

pub mod comparison;
#[cfg(test)]
mod fixture;
mod names;
pub mod nonsmooth;
pub mod plan;
pub mod reproduce;
pub mod stress;
pub mod study;
pub mod svg;
pub mod text;
mod tone;
pub mod tradeoff;
pub mod verify;

pub use crate::render::{ReportError, check_file, prepare_directory, write_file};
pub use reproduce::{Group, Row, groups};
