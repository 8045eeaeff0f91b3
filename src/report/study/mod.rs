//! A study: for a terminal, as a document, for programs, for a paper.

mod csv;
mod html;
mod json;
pub(super) mod latex;
pub(super) mod markdown;
pub(super) mod names;
#[cfg(test)]
mod tests;
mod text;
pub(super) mod words;

pub use csv::csv;
pub use html::page;
pub use json::json;
pub use latex::latex;
pub use markdown::markdown;
pub use text::text;

use super::{ReportError, write_file};
use crate::document::About;
use crate::render::html::place;
use crate::render::svg;
use crate::study::sweep::Results;
use std::fs;
use std::path::{Path, PathBuf};

/// Writes `study.csv`, `study.json`, `study.tex`, one plot a case and method, `study.md`, which shows them, and a page,
/// `index.html`, into `dir`; returns the paths written. Other files in `dir` stay.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, results: &Results, about: &About) -> Result<Vec<PathBuf>, ReportError> {
    fs::create_dir_all(dir).map_err(|reason| ReportError::Directory {
        path: dir.into(),
        reason,
    })?;
    let mut paths = Vec::new();
    let mut put = |name: &str, contents: &str| -> Result<(), ReportError> {
        let path = dir.join(name);
        write_file(&path, contents)?;
        paths.push(path);
        Ok(())
    };
    let page = page(results, about);
    for (file, figure) in svg::files(&page) {
        put(&file, &figure)?;
    }
    put("study.csv", &csv(results)?)?;
    put("study.json", &json(results)?)?;
    put("study.tex", &latex(results))?;
    put("study.md", &markdown(results))?;
    paths.push(place(dir, &page)?);
    Ok(paths)
}
