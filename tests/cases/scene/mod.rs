//! Scenes: what is read of them, and what `volver plan` and `volver render` make of them.

mod command;
mod files;
mod pieces;
mod refused;

use std::path::Path;
use volver::scene::{Scene, SceneProblem, read};

fn media(text: &str) -> Result<Scene, SceneProblem> {
    read(text, Path::new(".")).map_err(|error| error.problem)
}

fn medium(body: &str) -> Result<Scene, SceneProblem> {
    media(&format!("[[media]]\nfrom = 0\nto = 2\n{body}\n"))
}
