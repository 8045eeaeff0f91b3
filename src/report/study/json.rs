//! Everything but the levels, for programs.

use crate::case::Unproved;
use crate::convergence::Fit;
use crate::convergence::{Laws, float_schema, serialize_float};
use crate::report::ReportError;
use crate::report::schema::written;
use crate::study::sweep::{Bits, Errors, Line, Results, SplitSummary, State, Theory};
use rug::Float;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeMap;

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Study")]
struct Document<'a> {
    volver: &'static str,
    settings: Settings<'a>,
    rows: Vec<RowOf<'a>>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    unproved: Vec<Open<'a>>,
}

/// A statement of a case that is not proved.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "UnprovedOf")]
struct Open<'a> {
    case: &'a str,
    #[serde(flatten)]
    what: &'a Unproved,
}

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "StudySettings")]
struct Settings<'a> {
    cases: Vec<&'a str>,
    methods: &'a [String],
    formats: &'a [String],
    levels: &'a [u64],
    sweep_bits: Option<[u32; 2]>,
    #[serde(skip_serializing_if = "Errors::is_split")]
    #[schemars(with = "Option<String>")]
    errors: Errors,
}

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "StudyRow")]
struct RowOf<'a> {
    case: &'a str,
    method: &'a str,
    format: &'a str,
    bits: u32,
    #[serde(serialize_with = "serialize_float")]
    #[schemars(schema_with = "float_schema")]
    radiance: Float,
    #[schemars(with = "Value")]
    expected: Theory,
    contradicts_theory: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    discretization: Option<&'a Fit>,
    total: &'a Fit,
    #[serde(flatten)]
    models: Option<Models<'a>>,
    /// Levels by what became of them.
    states: BTreeMap<&'static str, usize>,
}

/// What needs errors that are split.
#[derive(Serialize, JsonSchema)]
struct Models<'a> {
    #[schemars(with = "Value")]
    laws: &'a Laws,
    crossing: Option<f64>,
    best: Option<Best>,
    #[schemars(with = "Vec<Value>")]
    bits_needed: &'a [Bits],
}

#[derive(Serialize, JsonSchema)]
struct Best {
    n: f64,
    #[serde(serialize_with = "serialize_float")]
    #[schemars(schema_with = "float_schema")]
    error: Float,
}

/// The JSON Schema of [`json`].
#[must_use]
pub fn schema() -> Value {
    written::<Document<'_>>()
}

/// `{"volver": version, "settings": {…}, "rows": […]}`, indented, with a newline at the end. Rows have the
/// fields of [`Summary`](crate::study::sweep::Summary); the errors themselves are in the CSV. Where errors are known as a whole
/// alone, rows have nothing of their parts.
///
/// # Errors
/// [`ReportError::Json`], which no study is known to cause.
pub fn json(results: &Results) -> Result<String, ReportError> {
    let header = &results.header;
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        settings: Settings {
            cases: header
                .cases
                .iter()
                .map(|[name, ..]| name.as_str())
                .collect(),
            methods: &header.methods,
            formats: &header.formats,
            levels: &header.levels,
            sweep_bits: results
                .sweep_bits
                .as_ref()
                .map(|bits| [*bits.start(), *bits.end()]),
            errors: header.errors,
        },
        rows: results.lines.iter().map(row).collect(),
        unproved: results
            .unproved
            .iter()
            .map(|(case, what)| Open { case, what })
            .collect(),
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}

fn row(line: &Line) -> RowOf<'_> {
    let summary = &line.summary;
    let mut states: BTreeMap<&'static str, usize> = BTreeMap::new();
    for level in &line.row.levels {
        *states.entry(State::name(&level.state)).or_default() += 1;
    }
    RowOf {
        case: &line.case,
        method: &line.row.method,
        format: &line.format,
        bits: line.bits,
        radiance: line.radiance.clone(),
        expected: line.row.expected,
        contradicts_theory: line.contradicts_theory(),
        discretization: summary.split.as_ref().map(|split| &split.discretization),
        total: &summary.total,
        models: summary.split.as_ref().map(models),
        states,
    }
}

fn models(split: &SplitSummary) -> Models<'_> {
    Models {
        laws: &split.laws,
        crossing: split.crossing,
        best: split.best.map(|best| Best {
            n: best.log2_n.exp2(),
            error: Float::with_val(64, best.log2_error).exp2(),
        }),
        bits_needed: &split.bits_needed,
    }
}
