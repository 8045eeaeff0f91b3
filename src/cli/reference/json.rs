//! Reference values as one JSON document.

use super::{Found, source_name};
use crate::cli::case::json::serialize_optional;
use crate::cli::case::value;
use rug::Float;
use serde::Serialize;
use volver::case::Case;
use volver::convergence::serialize_float;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    references: Vec<Object<'a>>,
}

#[derive(Serialize)]
struct Object<'a> {
    name: &'a str,
    channel: Option<&'a str>,
    radiance: String,
    asked: u32,
    believed: Option<u32>,
    #[serde(serialize_with = "serialize_float")]
    error: Float,
    source: &'static str,
    panels: u64,
    points: u64,
    evaluations: u64,
    transcendental_calls: u64,
    #[serde(serialize_with = "serialize_optional")]
    difference: Option<Float>,
}

/// All channels, indented, with a newline at the end.
pub(super) fn render(found: &[Found<'_>], digits: u32) -> serde_json::Result<String> {
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        references: found.iter().map(|found| object(found, digits)).collect(),
    };
    serde_json::to_string_pretty(&document).map(|text| text + "\n")
}

fn object<'a>(found: &'a Found<'_>, digits: u32) -> Object<'a> {
    let reference = &found.reference;
    Object {
        name: found.case.case.name(),
        channel: found.case.channel.as_deref(),
        radiance: value::decimal_of(&reference.value, digits as usize),
        asked: digits,
        believed: reference.digits(),
        error: reference.error.clone(),
        source: source_name(reference.source),
        panels: reference.work.panels,
        points: reference.work.points,
        evaluations: reference.work.evaluations,
        transcendental_calls: reference.work.transcendental_calls,
        difference: found.difference.as_ref().map(|d| d.amount.clone()),
    }
}
