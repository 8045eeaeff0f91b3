//! Several reports on one page: what differs between them first, then each.
//!
//! ```no_run
//! use volver::document::About;
//! use volver::render::html::render;
//! use volver::report::comparison::{compare, read_all};
//!
//! let parts = read_all(&["before", "after"])?;
//! let comparison = compare(&parts, About::new(["volver", "report", "before", "after"]));
//! println!("{} verdicts differ", comparison.verdicts);
//! std::fs::write("report.html", render(&comparison.page)?)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cells;
mod differences;
mod directory;

pub use directory::{ComparisonError, Part, read_all};

use crate::document::{About, Block, Cell, Column, Document, Fact, Finding, Section, Table, Tone};
use differences::{Differences, differences};

/// The kind of page that is no report but several.
const KIND: &str = "comparison";

/// Several reports on one page.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The page.
    pub page: Document,
    /// Cells that stand in more than one report.
    pub cells: usize,
    /// Verdicts among them that differ.
    pub verdicts: usize,
    /// Other cells among them that differ.
    pub others: usize,
}

/// Puts reports onto one page. Tables are compared that have the same title under the same heading in reports of
/// one kind, row by row and column by column, with the first report that has them; cells that show the same are the
/// same.
#[must_use]
pub fn compare(parts: &[Part], about: About) -> Comparison {
    let mut page = Document::new(KIND, "Reports compared", about);
    let found = differences(parts);
    page.summary = summary(parts, &found);
    page.sections.push(side_by_side(parts));
    if parts.len() > 1 {
        page.sections.push(differing(&found));
    }
    for part in parts {
        page.sections.push(heading(part));
        for section in &part.page.sections {
            page.sections.push(Section {
                is_aside: section.is_aside,
                id: format!("{}-{}", part.name, section.id),
                title: format!("{} · {}", part.name, section.title),
                blocks: section.blocks.clone(),
            });
        }
    }
    Comparison {
        page,
        cells: found.cells,
        verdicts: found.verdicts,
        others: found.others,
    }
}

fn summary(parts: &[Part], found: &Differences) -> Vec<Fact> {
    let mut facts = Vec::new();
    if parts.len() > 1 {
        let tone = match (found.verdicts, found.worse) {
            (0, _) => Tone::Good,
            (_, 0) => Tone::Open,
            _ => Tone::Bad,
        };
        facts.push(Fact::new("verdicts differ", found.verdicts.to_string()).toned(tone));
        facts.push(Fact::new("other cells differ", found.others.to_string()));
        facts.push(Fact::new("cells compared", found.cells.to_string()));
    }
    facts.push(Fact::new("reports", parts.len().to_string()));
    facts
}

/// What a row says of a report, and whether that is a fact of the report's own.
type Name<'a> = (&'a str, bool);

/// What a report says of itself.
fn own(page: &Document) -> Vec<(Name<'_>, Cell)> {
    let about = &page.about;
    let plain = [
        ("report", page.title.clone()),
        ("command", about.command.clone()),
        ("volver", about.version.clone()),
        ("seed", seeds(page).unwrap_or_default()),
        ("machine", about.machine.clone()),
    ];
    let plain = plain.map(|(name, text)| ((name, false), Cell::text(text)));
    let judged = |text: &str, tone| Cell {
        tone,
        ..Cell::text(text)
    };
    let conclusion = page.conclusion.iter();
    let conclusion = conclusion.map(|c| (("conclusion", false), judged(&c.words, c.tone)));
    let facts = page.summary.iter();
    let facts = facts.map(|f| ((&*f.name, true), judged(&f.value, f.tone)));
    plain.into_iter().chain(conclusion).chain(facts).collect()
}

/// What each report says of itself, a column each.
fn side_by_side(parts: &[Part]) -> Section {
    let columns = parts.iter().map(|part| Column::text(&part.name));
    let columns = std::iter::once(Column::text("")).chain(columns);
    let said: Vec<_> = parts.iter().map(|part| own(&part.page)).collect();
    let mut names: Vec<Name<'_>> = Vec::new();
    for (name, _) in said.iter().flatten() {
        if !names.contains(name) {
            names.push(*name);
        }
    }
    let rows = names.into_iter().map(|name| {
        let of = |own: &Vec<(Name<'_>, Cell)>| {
            let mut own = own.iter();
            let found = own.find(|(known, _)| *known == name);
            found.map_or_else(Cell::default, |(_, cell)| cell.clone())
        };
        let cells = said.iter().map(of);
        std::iter::once(Cell::text(name.0)).chain(cells).collect()
    });
    let table = Table::new("Each report in its own words", columns).with(rows);
    Section::of("side-by-side", "Side by side", [Block::Table(table)])
}

fn differing(found: &Differences) -> Section {
    let words = match (found.cells, found.tables.len()) {
        (0, 0) => "No table stands in more than one report: there is nothing to compare.".into(),
        (cells, 0) => format!(
            "Nothing: {cells} cells stand in more than one report, and all of them show the same."
        ),
        _ => "Cells that show something else than in the first report that has them.".to_string(),
    };
    let tables = found.tables.iter().cloned().map(Block::Table);
    let blocks = std::iter::once(Block::Text(words)).chain(tables);
    Section::of("differences", "What differs", blocks)
}

/// Where a report begins.
fn heading(part: &Part) -> Section {
    let page = &part.page;
    let mut facts = page.summary.clone();
    facts.push(Fact::new("command", &page.about.command));
    facts.push(Fact::new("volver", &page.about.version));
    facts.extend(seeds(page).map(|seeds| Fact::new("seed", seeds)));
    facts.push(Fact::new("machine", &page.about.machine));
    let conclusion = page.conclusion.iter().map(|conclusion| {
        let tone = conclusion.tone;
        Block::Finding(Finding {
            tone,
            ..Finding::new("", &conclusion.words)
        })
    });
    let blocks = conclusion.chain([Block::Facts(facts)]);
    Section::of(&part.name, format!("{}: {}", part.name, page.title), blocks)
}

fn seeds(page: &Document) -> Option<String> {
    let seeds: Vec<String> = page.about.seeds.iter().map(ToString::to_string).collect();
    (!seeds.is_empty()).then(|| seeds.join(", "))
}
