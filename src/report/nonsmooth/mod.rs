//! The table of jumps and kinks: for a terminal, as a document, for programs.

mod html;
mod json;
mod markdown;
#[cfg(test)]
mod tests;
mod text;
mod words;

pub use html::page;
pub use json::json;
pub use markdown::markdown;
pub use text::text;

use super::ReportError;
use super::html::{About, place};
use super::write::write_files;
use crate::study::nonsmooth::{Cell, Kind};
use std::path::{Path, PathBuf};

/// The cells of one kind, rule by rule; each row's in the order of the places.
fn rows(cells: &[Cell], kind: Kind) -> Vec<(&'static str, Vec<&Cell>)> {
    let mut rows: Vec<(&'static str, Vec<&Cell>)> = Vec::new();
    for cell in cells.iter().filter(|cell| cell.kind == kind) {
        match rows.iter_mut().find(|(rule, _)| *rule == cell.rule) {
            Some((_, row)) => row.push(cell),
            None => rows.push((cell.rule, vec![cell])),
        }
    }
    rows
}

/// Writes `nonsmooth.json`, `nonsmooth.md` and a page, `index.html` or `nonsmooth.html`, into `dir`, which is made where it does not exist; returns the
/// paths written. Other files in `dir` stay, see [`place`].
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, cells: &[Cell], about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let files = [
        (dir.join("nonsmooth.json"), json(cells)?),
        (dir.join("nonsmooth.md"), markdown(cells)),
    ];
    let mut paths = write_files(dir, files)?;
    paths.push(place(dir, &page(cells, about))?);
    Ok(paths)
}
