//! Reference values as text.

use super::{Found, source_name};
use crate::cli::case::value;
use std::fmt::Write;
use volver::case::Case;
use volver::reference::Source;

/// A paragraph a channel, all digits of the value on one line.
pub(super) fn render(found: &[Found<'_>], digits: u32) -> String {
    let paragraphs: Vec<String> = found.iter().map(|found| paragraph(found, digits)).collect();
    paragraphs.join("\n")
}

// Writing to a String does not fail, so that results are dropped here.
fn paragraph(found: &Found<'_>, digits: u32) -> String {
    let reference = &found.reference;
    let mut text = String::new();
    let _ = writeln!(text, "{}", found.case.case.name());
    let shown = value::decimal_of(&reference.value, digits as usize);
    let _ = writeln!(text, "I(D)        {shown}");
    let believed = match reference.digits() {
        Some(believed) => format!("{digits} asked for, {believed} believed"),
        None => "exact".into(),
    };
    let _ = writeln!(text, "digits      {believed}");
    let _ = writeln!(text, "source      {}", source_name(reference.source));
    if reference.source == Source::Spectral {
        let work = &reference.work;
        let _ = writeln!(
            text,
            "grid        {} panels, {} points",
            work.panels, work.points
        );
        let _ = writeln!(
            text,
            "work        {} evaluations of the medium, {} transcendental functions",
            work.evaluations, work.transcendental_calls
        );
    }
    if let Some(difference) = &found.difference {
        let verdict = if difference.is_within_errors {
            "within"
        } else {
            "beyond"
        };
        let amount = value::decimal(&difference.amount);
        let _ = writeln!(
            text,
            "difference  {amount} to the closed form, {verdict} the estimated error"
        );
    }
    text
}
