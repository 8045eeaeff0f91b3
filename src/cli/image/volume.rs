//! Volumes by name or from files.

use crate::cli::Failure;
use crate::cli::input::read;
use std::fmt::Write as _;
use std::path::Path;
use volver::case::volume::{self, VolumeCase, catalogue};
use volver::reference::ExactPicture;
use volver::study::picture::Plan;

/// The largest file of a volume by formulas.
const MAX_FILE: u64 = 1 << 20;
/// A volume of the catalogue, or of a file.
pub(super) fn load(name: &str) -> Result<VolumeCase, Failure> {
    if let Some(case) = catalogue::find(name) {
        return Ok(case);
    }
    let is_toml = Path::new(name)
        .extension()
        .is_some_and(|ending| ending == "toml");
    let is_file = name == "-" || name.contains('/') || is_toml;
    if !is_file {
        let names: Vec<&str> = catalogue::names().collect();
        return Err(Failure::Usage(format!(
            "no volume '{}' (allowed: {}, or a file: a path with a / in it or .toml at its end)",
            name.escape_debug(),
            names.join(", ")
        )));
    }
    let text = read(name, MAX_FILE)?;
    volume::read(&text).map_err(|error| Failure::Content {
        path: name.into(),
        error: error.into(),
    })
}

/// All of the catalogue.
pub(super) fn listed() -> String {
    let mut text = String::new();
    for case in catalogue::names().filter_map(catalogue::find) {
        // Writing to a text cannot fail.
        let _ = writeln!(text, "{:<12} {}", case.name, case.title);
    }
    text
}

/// What a volume is, and what its picture comes to.
pub(super) fn shown(case: &VolumeCase, plan: &Plan) -> String {
    let size = plan.size(plan.side);
    let exact = ExactPicture::new(case).centres(size);
    let lit = exact.values.chunks(exact.channels.len().max(1));
    let lit = lit.filter(|pixel| pixel.iter().any(|v| *v != 0.0)).count();
    let most = exact.values.iter().copied().fold(0.0, f64::max);
    let [low, high] = case.corners;
    format!(
        "{}: {}\nbox         {low:?} to {high:?}\nchannels    {}\npicture     {} × {} pixels, {lit} of them lit, at most {most:.4}\n",
        case.name,
        case.title,
        exact.channels.join(", "),
        size[0],
        size[1],
    )
}
