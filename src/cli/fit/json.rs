//! A fit as one JSON document.

use super::Report;
use serde::Serialize;
use serde_json::Value;
use volver::convergence::table::FloorSource;
use volver::convergence::{Fit, Sample};
use volver::method::Expected;

/// The document: the fields of the library's [`Fit`] and what they rest on.
#[derive(Serialize)]
struct Document<'a> {
    /// Whether the check passes; null where nothing was expected.
    passes: Option<bool>,
    /// The order expected, the word `exact`, or null.
    expected: Value,
    /// `errors`, `exact` (values minus the exact one) or `differences`.
    source: &'a str,
    floor_source: FloorSource,
    #[serde(flatten)]
    fit: &'a Fit,
    samples: &'a [Sample],
}

pub(super) fn render(report: &Report) -> serde_json::Result<String> {
    let verdict = report.fit.verdict;
    let document = Document {
        passes: report.expected.map(|_| verdict.passes(report.expected)),
        expected: match report.expected {
            Some(Expected::Order(p)) => p.into(),
            Some(Expected::Exact) => "exact".into(),
            Some(Expected::Blind { .. } | Expected::Unknown) | None => Value::Null,
        },
        source: report.source,
        floor_source: report.floor_source,
        fit: &report.fit,
        samples: &report.samples,
    };
    serde_json::to_string_pretty(&document).map(|text| text + "\n")
}
