//! What became of the cases as one JSON document.

use super::Proof;
use crate::render::ReportError;
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    proofs: Vec<Object<'a>>,
}

#[derive(Serialize)]
struct Object<'a> {
    case: &'a str,
    file: Option<&'a str>,
    theorems: &'a [String],
    outcome: &'static str,
    reason: Option<&'a str>,
}

impl<'a> From<&'a Proof> for Object<'a> {
    fn from(proof: &'a Proof) -> Self {
        Object {
            case: &proof.case,
            file: proof.file.as_deref(),
            theorems: &proof.theorems,
            outcome: proof.fate.name(),
            reason: proof.fate.reason(),
        }
    }
}

/// All cases, indented, with a newline at the end.
///
/// # Errors
/// [`ReportError::Json`], which no case is known to cause.
pub fn json(proofs: &[Proof]) -> Result<String, ReportError> {
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        proofs: proofs.iter().map(Object::from).collect(),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}
