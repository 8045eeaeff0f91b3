//! A kernel at the extremes: a row an answer, and what is wrong.

mod json;
mod words;

pub use json::json;

use super::stress::whole;
use crate::document::{
    self, About, Block, Column, Conclusion, Document, Fact, Finding, Section, Table, Tone,
};
use crate::render::{ReportError, write_document};
use crate::study::extremes::{Answer, Cell, Extremes};
use std::path::{Path, PathBuf};
use words::{FIGURES, NONE, RULE, accusations, figure, number, summary};

/// Digits, promises and answers; what is wrong; what figures and words mean.
#[must_use]
pub fn document(extremes: &Extremes, about: &About) -> Document {
    let name = &extremes.declaration.name;
    let mut document = Document::new("extremes", format!("{name} at the extremes"), about.clone());
    let wrong = extremes.faults().count();
    let tone = if wrong == 0 { Tone::Good } else { Tone::Bad };
    document.summary = vec![
        Fact::new("wrong", wrong.to_string()).toned(tone),
        Fact::new("answers", extremes.cells.len().to_string()),
    ];
    document.conclusion = Some(Conclusion::new(summary(extremes)).toned(tone));
    let accused = accusations(extremes)
        .into_iter()
        .map(|(cells, words)| Block::Finding(Finding::new(cells, words).toned(Tone::Bad)));
    let rule =
        (!extremes.is_exact).then(|| Block::Finding(Finding::new("found", RULE).toned(Tone::Open)));
    document.sections = vec![
        Section::of("digits", "Digits", [Block::Table(table(extremes))]),
        Section::of("wrong", "What is wrong", accused.chain(rule)),
        words(extremes),
    ];
    document
}

/// Writes `extremes.json`, `extremes.md`, and a page, `index.html`, into `dir`; see [`write_document`]. Returns the paths
/// written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, extremes: &Extremes, about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let data = [("extremes.json".to_string(), json(extremes)?)];
    write_document(dir, &document(extremes, about), "extremes", data)
}

fn table(extremes: &Extremes) -> Table {
    let columns = [
        Column::text("scenario"),
        Column::number("n").detail(),
        Column::number("digits"),
        Column::number("promised"),
        Column::number("answer"),
        Column::number("truth"),
        Column::verdict("is"),
    ];
    let caption =
        "Digits of what the method gives without rounding and of the truth, or what the answer is";
    Table::new(caption, columns).with(extremes.cells.iter().map(row))
}

fn row(cell: &Cell) -> Vec<document::Cell> {
    let tone = match (cell.is_fault, cell.answer) {
        (true, _) => Tone::Bad,
        (false, None | Some(Answer::Rectified)) => Tone::Good,
        (false, Some(_)) => Tone::Open,
    };
    let of = |value: &Option<rug::Float>| match value {
        Some(value) => document::Cell::number(number(value), Some(value.to_f64())),
        None => document::Cell::text(NONE),
    };
    let promised = cell
        .promised
        .map_or(NONE.into(), |digits| format!("{:.0}", digits.floor()));
    let said = match (cell.answer, cell.is_fault) {
        (Some(answer), _) => answer.name(),
        (None, true) => "wrong",
        (None, false) => "right",
    };
    vec![
        document::Cell::text(cell.name()),
        document::Cell::number(cell.n.to_string(), Some(cell.n as f64)),
        document::Cell::text(figure(cell)).toned(tone),
        document::Cell::number(promised, cell.promised),
        of(&cell.value),
        of(&cell.truth),
        document::Cell::verdict(said, tone),
    ]
}

/// What occurs.
fn words(extremes: &Extremes) -> Section {
    let occurs = |answer: &Answer| {
        let mut cells = extremes.cells.iter();
        cells.any(|cell| cell.answer == Some(*answer))
    };
    let meanings = Answer::ALL.into_iter().filter(occurs);
    let meanings: Vec<Fact> = meanings
        .map(|answer| Fact::new(answer.name(), answer.meaning()))
        .collect();
    let mut blocks = vec![Block::Text(format!("{FIGURES}."))];
    if !meanings.is_empty() {
        blocks.push(Block::Facts(meanings));
    }
    Section::of("words", "Words", blocks).aside()
}
