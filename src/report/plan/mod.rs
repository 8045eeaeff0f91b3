//! Plans as text and files.

mod html;
mod json;
mod markdown;
mod text;
mod words;

pub use html::page;
pub use json::json;
pub use markdown::markdown;
pub use text::text;

use super::ReportError;
use crate::document::About;
use crate::render::html::place;
use crate::render::write_files;
use crate::study::plan::Plan;
use std::path::{Path, PathBuf};

/// Writes `plan.json`, `plan.md` and a page, `index.html`, into `directory`. Returns the paths written.
///
/// # Errors
/// [`ReportError`] where a file cannot be made or written.
pub fn write(directory: &Path, plan: &Plan, about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let files = [
        (directory.join("plan.json"), json(plan)?),
        (directory.join("plan.md"), markdown(plan)),
    ];
    let mut paths = write_files(directory, files)?;
    paths.push(place(directory, &page(plan, about))?);
    Ok(paths)
}
