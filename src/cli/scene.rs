//! Scenes as arguments.

use super::Failure;
use super::input::read;
use std::path::Path;
use volver::input::WRITTEN;
use volver::scene::Scene;

/// The scene of a file, or of standard input for `-`; files that it names are sought beside it.
pub(super) fn load(path: &str) -> Result<Scene, Failure> {
    let text = read(path, WRITTEN)?;
    let directory = match path {
        "-" => Path::new("."),
        path => Path::new(path).parent().unwrap_or(Path::new(".")),
    };
    volver::scene::read(&text, directory).map_err(|error| Failure::Content {
        path: path.into(),
        error: error.into(),
    })
}
