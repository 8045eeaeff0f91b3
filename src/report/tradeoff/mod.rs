//! Error against cost: for a terminal, as a document, for programs, for a paper, as a plot.

mod csv;
mod html;
mod json;
mod latex;
mod markdown;
#[cfg(test)]
mod tests;
mod text;
mod words;

pub use csv::csv;
pub use html::page;
pub use json::json;
pub use latex::latex;
pub use markdown::markdown;
pub use text::text;

use super::ReportError;
use crate::document::About;
use crate::render::html::place;
use crate::render::{svg, write_files};
use crate::study::tradeoff::Results;
use std::path::{Path, PathBuf};

/// Writes one plot a case, `tradeoff.csv`, `tradeoff.json`, `tradeoff.tex`, `tradeoff.md`, which shows them, and a
/// page, `index.html`, into `dir`; returns the paths written. Other files in `dir` stay.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, results: &Results, about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let page = page(results, about);
    let figures = svg::files(&page).into_iter();
    let mut files: Vec<(PathBuf, String)> = figures
        .map(|(file, figure)| (dir.join(file), figure))
        .collect();
    files.push((dir.join("tradeoff.csv"), csv(results)?));
    files.push((dir.join("tradeoff.json"), json(results)?));
    files.push((dir.join("tradeoff.tex"), latex(results)));
    files.push((dir.join("tradeoff.md"), markdown(results)));
    let mut paths = write_files(dir, files)?;
    paths.push(place(dir, &page)?);
    Ok(paths)
}
