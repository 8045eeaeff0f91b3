//! Everything, for programs.

use super::ReportError;
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
pub fn reproduction(settings: &Settings, entries: &[Entry]) -> Result<String, ReportError> {
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

#[cfg(test)]
mod tests {
    use super::super::fixture::{entry, replicated};
    use super::*;

    #[test]
    fn a_document_has_version_settings_and_entries() {
        let entries = [
            entry("simpson", "boole"),
            replicated("monte-carlo", "boole"),
        ];
        let text = reproduction(&Settings::default(), &entries).unwrap();
        assert!(text.ends_with("}\n"));
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(json["volver"], env!("CARGO_PKG_VERSION"));
        assert_eq!(json["settings"]["tables"][1], "2");
        assert_eq!(json["settings"]["formats"][0], "mpfr:128");
        assert_eq!(json["settings"]["ladder"][9], 4096);
        assert_eq!(json["settings"]["seed"], 1);
        assert_eq!(json["settings"]["replicas"], 64);
        assert_eq!(json["entries"].as_array().unwrap().len(), 2);
        assert_eq!(json["entries"][0]["table"], "1-exact");
        assert_eq!(json["entries"][0]["inner"], "simpson");
        assert_eq!(json["entries"][0]["levels"][0]["n"], 8);
    }

    #[test]
    fn numbers_that_are_none_do_not_break_the_document() {
        let mut broken = entry("simpson", "boole");
        broken.asymptotic_order = Some(f64::NAN);
        broken.levels[0].error = rug::Float::with_val(53, rug::float::Special::Nan);
        let text = reproduction(&Settings::default(), &[broken]).unwrap();
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert!(json["entries"][0]["asymptotic_order"].is_null());
        assert_eq!(json["entries"][0]["levels"][0]["error"], "NaN");
    }
}
