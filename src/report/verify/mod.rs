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

use super::{ReportError, svg};
use crate::document::About;
use crate::render::html::place;
use crate::render::write_files;
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
    let mut files = Vec::new();
    for line in &verification.lines {
        if let Some(plot) = plot(line)? {
            files.push((dir.join(plot_name(line)), plot));
        }
    }
    files.push((dir.join("verify.json"), json(verification)?));
    files.push((dir.join("verify.xml"), junit(verification)));
    files.push((dir.join("verify.md"), markdown(verification)));
    let mut paths = write_files(dir, files)?;
    paths.push(place(dir, &page(verification, about))?);
    Ok(paths)
}

/// The convergence of one channel, where it has errors to draw.
fn plot(line: &Line) -> Result<Option<String>, ReportError> {
    let Measured::Fitted { fit, samples } = &line.measured else {
        return Ok(None);
    };
    if !is_drawn(line) {
        return Ok(None);
    }
    svg::convergence_plot(samples, fit, &line.name).map(Some)
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
