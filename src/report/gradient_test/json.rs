//! Remainders as one JSON document.

use crate::convergence::{Fit, Sample, Taylor};
use crate::render::ReportError;
use crate::report::schema::written;
use schemars::JsonSchema;
use serde::Serialize;

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Taylor")]
struct Document<'a> {
    remainder: &'static str,
    passes: bool,
    first: Option<f64>,
    second: Option<f64>,
    slope: Option<f64>,
    wrong_by: Option<f64>,
    roundoff: Option<usize>,
    fit: &'a Fit,
    samples: &'a [Sample],
}

/// The JSON Schema of [`json`].
#[must_use]
pub fn schema() -> serde_json::Value {
    written::<Document<'_>>()
}

/// `{"remainder": "first-order", "passes": false, "first": …, "second": …, "slope": …, "wrong_by": …, "roundoff": …, "fit": …}`, indented,
/// with a newline at the end.
///
/// # Errors
/// [`ReportError::Json`], which no fit is known to cause.
pub fn json(taylor: &Taylor) -> Result<String, ReportError> {
    let document = Document {
        remainder: taylor.smoothness.name(),
        passes: taylor.smoothness.passes(),
        first: taylor.first,
        second: taylor.second,
        slope: taylor.slope,
        wrong_by: taylor.wrong_by(),
        roundoff: taylor.roundoff,
        fit: &taylor.fit,
        samples: &taylor.samples,
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}
