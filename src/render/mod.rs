//! Back ends: each shows any [`Document`](crate::document::Document), whatever it reports.
//!
//! | back end | for |
//! |---|---|
//! | [`terminal`](terminal()) | a terminal: lines of a width, with colour where there is colour |
//! | [`markdown`](markdown()) | GitHub Markdown, with figures as files beside it |
//! | [`html`] | one page that opens in a browser, with tables that sort and plots that answer |
//! | [`svg`] | the figures and maps of a document as files |
//! | [`csv`](csv()) | the tables of a document, for programs |
//! | [`latex`](latex()) | the tables of a document, for papers |

#[cfg(feature = "studies")]
mod csv;
mod error;
#[cfg(feature = "studies")]
pub mod html;
#[cfg(feature = "studies")]
mod latex;
#[cfg(feature = "studies")]
mod markdown;
#[cfg(feature = "studies")]
mod plot;
#[cfg(feature = "studies")]
mod preflight;
#[cfg(feature = "studies")]
pub mod svg;
pub mod terminal;
#[cfg(feature = "studies")]
mod write;

#[cfg(feature = "studies")]
pub use csv::csv;
pub use error::ReportError;
#[cfg(feature = "studies")]
pub use latex::latex;
#[cfg(feature = "studies")]
pub use markdown::markdown;
#[cfg(feature = "studies")]
pub use preflight::{check_directory, check_file, make_directory};
pub use terminal::terminal;
#[cfg(feature = "studies")]
pub use write::{write_document, write_file};
