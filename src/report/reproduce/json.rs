//! Everything, for programs.

use crate::render::ReportError;
use crate::study::reproduce::{Entry, REPLICAS, Settings};
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    settings: Run<'a>,
    entries: &'a [Entry],
}

/// [`Settings`] as text: the names that the command line takes.
#[derive(Serialize)]
struct Run<'a> {
    tables: Vec<String>,
    formats: Vec<String>,
    ladder: &'a [u64],
    seed: u64,
    replicas: usize,
}

/// `{"volver": version, "settings": {…}, "entries": […]}`, indented, with a newline at the end.
///
/// Settings have `tables`, `formats`, `ladder`, `seed` and `replicas`; entries are those of
/// [`Entry`]. An error below 1e-300 is a string, see
/// [`serialize_float`](crate::convergence::serialize_float).
///
/// # Errors
///
/// [`ReportError::Json`], which no entry is known to cause.
pub fn json(settings: &Settings, entries: &[Entry]) -> Result<String, ReportError> {
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        settings: Run {
            tables: settings.tables.iter().map(ToString::to_string).collect(),
            formats: settings.formats.iter().map(ToString::to_string).collect(),
            ladder: &settings.ladder,
            seed: settings.seed,
            replicas: REPLICAS,
        },
        entries,
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}
