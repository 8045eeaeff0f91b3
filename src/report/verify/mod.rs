//! A kernel put to the test: rows for a terminal as they come, a document with plots, JSON, `JUnit` XML.

mod html;
mod json;
mod junit;
mod markdown;
mod text;
mod words;

pub use html::page;
pub use json::json;
pub use junit::junit;
pub use markdown::markdown;
pub use text::{closing, heading, row};

use super::ReportError;
use crate::document::About;
use crate::render::html::place;
use crate::render::{svg, write_files};
use crate::study::verify::{Line, Measured, Verification};
use std::path::{Path, PathBuf};

/// Writes `verify.md`, `verify.json`, `verify.xml` (`JUnit`), one plot a channel and a page, `index.html`, into `dir`, which is
/// made where it does not exist; returns the paths written. Other files in `dir` stay.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(
    dir: &Path,
    verification: &Verification,
    about: &About,
) -> Result<Vec<PathBuf>, ReportError> {
    let page = page(verification, about);
    let figures = svg::files(&page).into_iter();
    let mut files: Vec<(PathBuf, String)> = figures
        .map(|(file, figure)| (dir.join(file), figure))
        .collect();
    files.push((dir.join("verify.json"), json(verification)?));
    files.push((dir.join("verify.xml"), junit(verification)));
    files.push((dir.join("verify.md"), markdown(verification)));
    let mut paths = write_files(dir, files)?;
    paths.push(place(dir, &page)?);
    Ok(paths)
}

/// Whether there is any error that logarithmic axes can show.
fn is_drawn(line: &Line) -> bool {
    match &line.measured {
        Measured::Fitted { samples, .. } => samples
            .iter()
            .any(|sample| sample.error.is_finite() && !sample.error.is_zero()),
        Measured::Scattered(_) | Measured::Nothing => false,
    }
}

/// `sine-squared.svg`, `rgb-transfer-red.svg`.
fn plot_name(line: &Line) -> String {
    format!("{}.svg", line.name.replace('/', "-"))
}
