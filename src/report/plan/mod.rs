//! Plans as text and files.

mod json;
mod markdown;
mod text;
mod words;

pub use json::json;
pub use markdown::markdown;
pub use text::text;

use super::ReportError;
use super::write::write_files;
use crate::study::plan::Plan;
use std::path::{Path, PathBuf};

/// Writes `plan.json` and `plan.md` into `directory`. Returns the paths written.
///
/// # Errors
/// [`ReportError`] where a file cannot be made or written.
pub fn write(directory: &Path, plan: &Plan) -> Result<Vec<PathBuf>, ReportError> {
    let files = [
        (directory.join("plan.json"), json(plan)?),
        (directory.join("plan.md"), markdown(plan)),
    ];
    write_files(directory, files)
}
