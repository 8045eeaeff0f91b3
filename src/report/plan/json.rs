//! The plan as JSON, as `volver render` reads it.

use crate::report::ReportError;
use crate::study::plan::Plan;

/// One document; `volver schema plan` describes it.
///
/// # Errors
/// [`ReportError::Json`] where a number has no JSON.
pub fn json(plan: &Plan) -> Result<String, ReportError> {
    let mut text = serde_json::to_string_pretty(plan.stored())?;
    text.push('\n');
    Ok(text)
}
