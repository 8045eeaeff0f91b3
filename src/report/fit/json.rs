//! A fit as one JSON document.

use super::{Fitted, Source};
use crate::convergence::table::FloorSource;
use crate::convergence::{Fit, Sample};
use crate::method::Expected;
use crate::render::ReportError;
use crate::report::schema::written;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

/// The document: the fields of the library's [`Fit`] and what they rest on.
#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Fitted")]
struct Document<'a> {
    /// Whether the checks pass; null where none was asked for.
    passes: Option<bool>,
    /// The order expected, the word `exact`, or null.
    expected: Value,
    #[schemars(with = "String")]
    source: Source,
    #[schemars(with = "String")]
    floor_source: FloorSource,
    /// The order that has to be reached, or null.
    at_least: Option<f64>,
    #[serde(flatten)]
    fit: Fit,
    samples: &'a [Sample],
}

/// The JSON Schema of [`json`].
#[must_use]
pub fn schema() -> Value {
    written::<Document<'_>>()
}

/// The fields of the [`Fit`], and `passes`, `expected`, `at_least`, `source`, `floor_source` and `samples`; order, half-width and
/// constant are null without a window. Indented, with a newline at the end.
///
/// # Errors
/// [`ReportError::Json`], which no fit is known to cause.
pub fn json(fitted: &Fitted) -> Result<String, ReportError> {
    let mut fit = fitted.fit.clone();
    if fit.window.is_none() {
        // The last pair is among the pairs.
        (fit.order, fit.half_width, fit.log2_constant) = (None, None, None);
    }
    let document = Document {
        passes: fitted.passes(),
        expected: match fitted.expected {
            Some(Expected::Order(p)) => p.into(),
            Some(Expected::Exact) => "exact".into(),
            Some(Expected::Blind { .. } | Expected::Unknown) | None => Value::Null,
        },
        source: fitted.source,
        floor_source: fitted.floor_source,
        at_least: fitted.at_least,
        fit,
        samples: &fitted.samples,
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}
