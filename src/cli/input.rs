//! Text that a command reads.

use super::Failure;
use std::path::Path;
use volver::input;

/// The text of a file, or of standard input for `-`, of at most so many bytes.
pub(super) fn read(path: &str, most: u64) -> Result<String, Failure> {
    let text = match path {
        "-" => input::standard(most),
        path => input::text(Path::new(path), most),
    };
    text.map_err(|error| Failure::Input {
        path: path.into(),
        error,
    })
}
