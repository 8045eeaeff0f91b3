//! What was measured, as documents: one builder a command.
//!
//! A builder arranges what a study found into a [`Document`](crate::document::Document); nothing here computes an order, and
//! nothing here knows how a document will look: that is for the back ends of [`render`](crate::render). JSON is the result
//! itself, by serde.
//!
//! | builder | what |
//! |---|---|
//! | [`plots`] | curves of what was measured |
//! | [`reproduce`] | the paper's tables, measured again |
//! | [`nonsmooth`] | the table of jumps and kinks |
//! | [`study`] | a study of errors and their parts |
//! | [`verify`](mod@verify) | a kernel put to the test |
//! | [`extremes`] | digits of a kernel at the extremes |
//! | [`gradient`] | gradients of a kernel beside theory |
//! | [`adjoint`] | a projector beside its backprojector |
//! | [`gradient_test`] | Taylor remainders of anybody's gradient |
//! | [`identify`] | what a kernel computes |
//! | [`image`](mod@image) | a renderer of volumes along three axes of refinement |
//! | [`stress`] | digits and verdicts at the extremes |
//! | [`tradeoff`] | error against cost |
//! | [`plan`] | the least model of a scene |
//! | [`fit`] | an order from anybody's errors |
//! | [`cases`] | cases, their formulas and what is proved of them |
//! | [`reference`](mod@reference) | radiances to many digits |
//! | [`proofs`] | cases as theorems |
//! | [`comparison`] | several reports on one page, what differs first |

#[cfg(feature = "studies")]
pub mod adjoint;
#[cfg(feature = "studies")]
pub mod cases;
#[cfg(feature = "studies")]
pub mod comparison;
#[cfg(feature = "studies")]
mod counts;
#[cfg(feature = "studies")]
pub mod extremes;
#[cfg(feature = "studies")]
pub mod fit;
#[cfg(feature = "studies")]
pub mod gradient;
#[cfg(feature = "studies")]
pub mod gradient_test;
pub mod identify;
#[cfg(feature = "studies")]
pub mod image;
#[cfg(feature = "studies")]
mod names;
#[cfg(feature = "studies")]
pub mod nonsmooth;
#[cfg(feature = "studies")]
pub mod plan;
#[cfg(feature = "studies")]
pub mod plots;
#[cfg(feature = "studies")]
pub mod proofs;
#[cfg(feature = "studies")]
pub mod reference;
#[cfg(feature = "studies")]
pub mod reproduce;
#[cfg(feature = "studies")]
mod schema;
#[cfg(feature = "studies")]
pub mod stress;
#[cfg(feature = "studies")]
pub mod study;
#[cfg(feature = "studies")]
pub mod tradeoff;
mod unproved;
pub mod verify;

pub use crate::render::ReportError;
#[cfg(feature = "studies")]
pub use crate::render::{check_directory, check_file, make_directory, write_file};
#[cfg(feature = "studies")]
pub use reproduce::{Group, Row, groups};
