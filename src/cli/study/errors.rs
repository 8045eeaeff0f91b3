//! How much about errors.

use super::asked::{Asked, Asking};
use crate::cli::Failure;
use volver::study::sweep::Errors;

pub(in crate::cli) fn chosen(asking: &Asking, given: Option<&str>) -> Result<Errors, Failure> {
    let asked = |text: &str, at: String| Asked {
        text: text.into(),
        at,
        directory: None,
    };
    let asked = match (given, &asking.file.errors) {
        (Some(text), _) => asked(text, "--errors".into()),
        (None, Some(text)) => asked(text.get_ref(), asking.place(text)),
        (None, None) => return Ok(Errors::default()),
    };
    asked
        .text
        .parse()
        .map_err(|error: volver::study::sweep::ErrorsError| asked.refused(error))
}
