//! A fit as one JSON document.

use super::{Fitted, Source};
use crate::convergence::table::FloorSource;
use crate::convergence::{Fit, Sample};
use crate::method::Expected;
use crate::render::ReportError;
use serde::Serialize;
use serde_json::Value;

/// The document: the fields of the library's [`Fit`] and what they rest on.
#[derive(Serialize)]
struct Document<'a> {
    /// Whether the check passes; null where nothing was expected.
    passes: Option<bool>,
    /// The order expected, the word `exact`, or null.
    expected: Value,
    source: Source,
    floor_source: FloorSource,
    #[serde(flatten)]
    fit: &'a Fit,
    samples: &'a [Sample],
}

/// The fields of the [`Fit`], and `passes`, `expected`, `source`, `floor_source` and `samples`; indented, with a newline at the
/// end.
///
/// # Errors
/// [`ReportError::Json`], which no fit is known to cause.
pub fn json(fitted: &Fitted) -> Result<String, ReportError> {
    let verdict = fitted.fit.verdict;
    let document = Document {
        passes: fitted.expected.map(|_| verdict.passes(fitted.expected)),
        expected: match fitted.expected {
            Some(Expected::Order(p)) => p.into(),
            Some(Expected::Exact) => "exact".into(),
            Some(Expected::Blind { .. } | Expected::Unknown) | None => Value::Null,
        },
        source: fitted.source,
        floor_source: fitted.floor_source,
        fit: &fitted.fit,
        samples: &fitted.samples,
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}
