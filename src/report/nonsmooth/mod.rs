//! The table of jumps and kinks.

mod json;
mod words;

pub use json::json;

use crate::document::{
    self, About, Block, Column, Conclusion, Document, Fact, Finding, Section, Table, Tone,
};
use crate::render::{ReportError, write_document};
use crate::study::nonsmooth::{BITS, Cell, Kind, Place};
use std::path::{Path, PathBuf};
use words::{LEGEND, contradiction, order, summary, theory, usual};

/// A table a kind of break, with what contradicts theory below it.
#[must_use]
pub fn document(cells: &[Cell], about: &About) -> Document {
    let mut document = Document::new("nonsmooth", "Orders at jumps and kinks", about.clone());
    let bad = cells.iter().filter(|cell| cell.contradicts_theory());
    let bad = bad.count();
    let good = (cells.len() - bad).to_string();
    let mut facts = vec![Fact::new("agree with theory", good).toned(Tone::Good)];
    if bad > 0 {
        facts.push(Fact::new("contradict it", bad.to_string()).toned(Tone::Bad));
    }
    facts.push(Fact::new("cells", cells.len().to_string()));
    facts.push(Fact::new("format", format!("mpfr:{BITS}")));
    document.summary = facts;
    document.conclusion = Some(Conclusion::new(summary(cells)));
    document.sections = Kind::ALL.map(|kind| section(cells, kind)).into();
    let legend = LEGEND.iter();
    let legend = legend.map(|(word, meaning)| Fact::new(*word, *meaning));
    let legend = Block::Facts(legend.collect());
    document
        .sections
        .push(Section::of("words", "Words", [legend]).aside());
    document
}

/// Writes `nonsmooth.json`, `nonsmooth.md` and a page, `index.html` or `nonsmooth.html`, into `dir`; see [`write_document`].
/// Returns the paths written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, cells: &[Cell], about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let data = [("nonsmooth.json".to_string(), json(cells)?)];
    write_document(dir, &document(cells, about), "nonsmooth", data)
}

fn section(cells: &[Cell], kind: Kind) -> Section {
    let contradicting = cells
        .iter()
        .filter(|cell| cell.kind == kind && cell.contradicts_theory());
    let said = |cell| Block::Finding(Finding::new("", contradiction(cell)).toned(Tone::Bad));
    let blocks = std::iter::once(Block::Table(table(cells, kind)));
    Section::of(
        kind.title(),
        kind.title(),
        blocks.chain(contradicting.map(said)),
    )
}

fn table(cells: &[Cell], kind: Kind) -> Table {
    let places = Place::ALL.map(|place| Column::number(place.title()));
    let columns = std::iter::once(Column::text("rule")).chain(places);
    let rows = rows(cells, kind).into_iter().map(|(rule, row)| {
        let entries = row.into_iter().map(entry);
        std::iter::once(document::Cell::text(rule))
            .chain(entries)
            .collect()
    });
    Table::new(
        "Order, [theory], and what a ladder of doublings shows",
        columns,
    )
    .with(rows)
}

/// The cells of one kind, rule by rule; each row's in the order of the places.
fn rows(cells: &[Cell], kind: Kind) -> Vec<(&'static str, Vec<&Cell>)> {
    let mut rows: Vec<(&'static str, Vec<&Cell>)> = Vec::new();
    for cell in cells.iter().filter(|cell| cell.kind == kind) {
        match rows.iter_mut().find(|(rule, _)| *rule == cell.rule) {
            Some((_, row)) => row.push(cell),
            None => rows.push((cell.rule, vec![cell])),
        }
    }
    rows
}

fn entry(cell: &Cell) -> document::Cell {
    let text = format!(
        "{} [{}]\ndoublings: {}",
        order(cell),
        theory(cell.theory),
        usual(cell)
    );
    let tone = if cell.contradicts_theory() {
        Tone::Bad
    } else {
        Tone::Good
    };
    document::Cell::number(text, cell.measured.order).toned(tone)
}
