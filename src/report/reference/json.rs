//! Reference values as one JSON document.

use super::{Found, source};
use crate::case::{Case, Unproved};
use crate::convergence::{float_schema, serialize_float};
use crate::render::ReportError;
use crate::report::cases::{decimal_of, serialize_optional};
use crate::report::schema::written;
use rug::Float;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "References")]
struct Document<'a> {
    volver: &'static str,
    references: Vec<Object<'a>>,
}

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Reference")]
struct Object<'a> {
    name: &'a str,
    channel: Option<&'a str>,
    radiance: String,
    asked: u32,
    digits: Option<u32>,
    #[serde(serialize_with = "serialize_float")]
    #[schemars(schema_with = "float_schema")]
    error: Float,
    proved: bool,
    not_proved: Option<String>,
    source: &'static str,
    panels: u64,
    points: u64,
    evaluations: u64,
    transcendental_calls: u64,
    #[serde(serialize_with = "serialize_optional")]
    #[schemars(with = "Option<Value>")]
    difference: Option<Float>,
    /// What the value rests on without a proof.
    unproved: &'a [Unproved],
}

/// The JSON Schema of [`json`].
#[must_use]
pub fn schema() -> Value {
    written::<Document<'_>>()
}

/// All channels, indented, with a newline at the end.
///
/// # Errors
/// [`ReportError::Json`], which no value is known to cause.
pub fn json(found: &[Found<'_>], digits: u32) -> Result<String, ReportError> {
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        references: found.iter().map(|found| object(found, digits)).collect(),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

fn object<'a>(found: &'a Found<'_>, digits: u32) -> Object<'a> {
    let reference = &found.reference;
    Object {
        name: found.case.case.name(),
        channel: found.case.channel.as_deref(),
        radiance: decimal_of(&reference.value, digits as usize),
        asked: digits,
        digits: reference.digits(),
        error: reference.error.clone(),
        proved: reference.is_enclosed(),
        not_proved: reference.not_enclosed.as_ref().map(ToString::to_string),
        source: source(reference.source),
        panels: reference.work.panels,
        points: reference.work.points,
        evaluations: reference.work.evaluations,
        transcendental_calls: reference.work.transcendental_calls,
        difference: found.difference.as_ref().map(|d| d.amount.clone()),
        unproved: found.case.unproved(),
    }
}
