//! What results rest on and is not proved, in the words of every report.

use crate::case::Unproved;
use crate::document::{Block, Finding, Tone};

/// A statement of a case, or its integral, that is not proved.
pub(super) fn not_proved(case: &str, open: &Unproved) -> Block {
    let finding = Finding::new("not proved", format!("{case}, {open}"));
    Block::Finding(finding.toned(Tone::Open))
}
