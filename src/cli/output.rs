//! Where output goes: standard output for `-`, else a file.

use super::Failure;
use std::fmt::Display;
use std::path::Path;
use volver::report;

/// Into a file, or to what is printed.
pub(super) fn put(file: &Path, text: &str, printed: &mut String) -> Result<(), Failure> {
    if is_dash(Some(file)) {
        printed.push_str(text);
        return Ok(());
    }
    Ok(report::write_file(file, text)?)
}

/// Whether standard output is meant.
pub(super) fn is_dash(file: Option<&Path>) -> bool {
    file == Some(Path::new("-"))
}

/// What a library's error says.
pub(super) fn said(error: impl Display) -> Failure {
    Failure::Usage(error.to_string())
}
