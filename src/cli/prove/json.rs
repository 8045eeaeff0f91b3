//! What became of the cases as one JSON document.

use super::outcome::Proof;
use serde::Serialize;

/// What the help says of the document.
pub(super) const HELP: &str = "\
JSON: volver (its version) and proofs, an object a case: case, file, theorems (as
Coq calls them in the file), outcome (proved, failed, not checked, not stated) and
reason, which is Coq's message where the proof failed.";

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
pub(super) fn render(proofs: &[Proof]) -> serde_json::Result<String> {
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        proofs: proofs.iter().map(Object::from).collect(),
    };
    serde_json::to_string_pretty(&document).map(|text| text + "\n")
}
