//! What was measured, for people and programs: one format a file.
//!
//! | format | what |
//! |---|---|
//! | [`text`] | for the terminal: the paper's figure beside the order, row by row |
//! | [`markdown`] | the same as a document, with plots |
//! | [`page`] | the same as a page, with tables that sort and plots that answer |
//! | [`json`] | everything, for programs |
//! | [`svg`] | log–log convergence plots; cases along their ray |
//! | [`html`] | one page that opens in a browser, of any report |
//! | [`comparison`] | several reports on one page, what differs first |
//! | [`write_directory`] | all of them as files |
//! | [`nonsmooth`] | the table of jumps and kinks, as text, Markdown and JSON |
//! | [`study`] | a study, as text, Markdown, JSON, CSV, LaTeX and plots |
//! | [`verify`](mod@verify) | a kernel put to the test, as text, Markdown, JSON, `JUnit` XML and plots |
//! | [`stress`] | digits and verdicts at the extremes, as text, Markdown, JSON and a heat map |
//! | [`tradeoff`] | error against cost, as text, Markdown, JSON, CSV, LaTeX and plots |
//!
//! Nothing here computes an order: a report shows what [`Entry`](crate::study::reproduce::Entry) and
//! [`Fit`](crate::convergence::Fit) hold.

pub mod comparison;
mod error;
#[cfg(test)]
mod fixture;
mod group;
pub mod html;
pub mod json;
mod legend;
pub mod markdown;
pub mod nonsmooth;
pub mod page;
pub mod plan;
mod preflight;
mod proved;
pub mod stress;
pub mod study;
pub mod svg;
pub mod text;
mod tone;
pub mod tradeoff;
pub mod verify;
mod write;

pub use error::ReportError;
pub use group::{Group, Row, groups};
pub use preflight::{check_file, prepare_directory};
pub use write::{write_directory, write_file};
