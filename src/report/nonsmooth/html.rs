//! The table as a page.

use super::rows;
use super::words::{LEGEND, contradiction, order, theory, usual};
use crate::report::html::{self, About, Block, Column, Fact, Page, Section, Table, Tone};
use crate::study::nonsmooth::{BITS, Cell, Kind, Place};

/// What [`markdown`](super::markdown()) says, with tables that sort.
#[must_use]
pub fn page(cells: &[Cell], about: &About) -> Page {
    let mut page = Page::new("nonsmooth", "Orders at jumps and kinks", about.clone());
    let bad = cells
        .iter()
        .filter(|cell| cell.contradicts_theory())
        .count();
    page.summary
        .push(Fact::new("agree with theory", (cells.len() - bad).to_string()).toned(Tone::Good));
    if bad > 0 {
        page.summary
            .push(Fact::new("contradict it", bad.to_string()).toned(Tone::Bad));
    }
    page.summary
        .push(Fact::new("cells", cells.len().to_string()));
    page.summary
        .push(Fact::new("format", format!("mpfr:{BITS}")));
    for kind in Kind::ALL {
        let mut section = Section::new(kind.title(), kind.title());
        section.blocks.push(Block::Table(table(cells, kind)));
        let contradicting = cells
            .iter()
            .filter(|cell| cell.kind == kind && cell.contradicts_theory());
        let facts =
            contradicting.map(|cell| Fact::new(cell.rule, contradiction(cell)).toned(Tone::Bad));
        let facts: Vec<Fact> = facts.collect();
        if !facts.is_empty() {
            section.blocks.push(Block::Facts(facts));
        }
        page.sections.push(section);
    }
    let mut words = Section::new("words", "Words");
    let legend = LEGEND
        .iter()
        .map(|(word, meaning)| Fact::new(*word, *meaning));
    words.blocks.push(Block::Facts(legend.collect()));
    page.sections.push(words);
    page
}

fn table(cells: &[Cell], kind: Kind) -> Table {
    let places = Place::ALL.map(|place| Column::number(place.title()));
    let first = Column::text("rule");
    let mut table = Table::new(
        "Order, [theory], and what a ladder of doublings shows",
        std::iter::once(first).chain(places),
    );
    for (rule, row) in rows(cells, kind) {
        let entries = row.iter().map(|cell| entry(cell));
        table.rows.push(
            std::iter::once(html::Cell::text(rule))
                .chain(entries)
                .collect(),
        );
    }
    table
}

fn entry(cell: &Cell) -> html::Cell {
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
    html::Cell::number(text, cell.measured.order).toned(tone)
}
