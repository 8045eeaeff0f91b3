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
#[cfg(test)]
mod tests;

pub use directory::{ComparisonError, Part, read_all};

use crate::document::{About, Block, Cell, Column, Document, Fact, Section, Table, Tone};
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

/// What [`own`] says, by name.
const OWN: [&str; 5] = ["report", "command", "volver", "seed", "machine"];

fn own(page: &Document) -> [String; 5] {
    let about = &page.about;
    [
        page.title.clone(),
        about.command.clone(),
        about.version.clone(),
        seeds(page).unwrap_or_default(),
        about.machine.clone(),
    ]
}

/// What each report says of itself, a column each.
fn side_by_side(parts: &[Part]) -> Section {
    let columns = parts.iter().map(|part| Column::text(&part.name));
    let mut table = Table::new(
        "Each report in its own words",
        std::iter::once(Column::text("")).chain(columns),
    );
    let said: Vec<[String; 5]> = parts.iter().map(|part| own(&part.page)).collect();
    for (index, name) in OWN.into_iter().enumerate() {
        let cells = said.iter().map(|own| Cell::text(&own[index]));
        table
            .rows
            .push(std::iter::once(Cell::text(name)).chain(cells).collect());
    }
    let mut names: Vec<&str> = Vec::new();
    for fact in parts.iter().flat_map(|part| &part.page.summary) {
        if !names.contains(&fact.name.as_str()) {
            names.push(&fact.name);
        }
    }
    for name in names {
        let cells = parts.iter().map(|part| {
            let fact = part.page.summary.iter().find(|fact| fact.name == name);
            fact.map_or_else(Cell::default, |fact| Cell {
                tone: fact.tone,
                ..Cell::text(&fact.value)
            })
        });
        table
            .rows
            .push(std::iter::once(Cell::text(name)).chain(cells).collect());
    }
    let mut section = Section::new("side-by-side", "Side by side");
    section.blocks.push(Block::Table(table));
    section
}

fn differing(found: &Differences) -> Section {
    let mut section = Section::new("differences", "What differs");
    let words = match (found.cells, found.tables.len()) {
        (0, 0) => "No table stands in more than one report: there is nothing to compare.".into(),
        (cells, 0) => format!(
            "Nothing: {cells} cells stand in more than one report, and all of them show the same."
        ),
        _ => "Cells that show something else than in the first report that has them.".to_string(),
    };
    section.blocks.push(Block::Text(words));
    section
        .blocks
        .extend(found.tables.iter().cloned().map(Block::Table));
    section
}

/// Where a report begins.
fn heading(part: &Part) -> Section {
    let page = &part.page;
    let mut section = Section::new(&part.name, format!("{}: {}", part.name, page.title));
    let mut facts = page.summary.clone();
    facts.push(Fact::new("command", &page.about.command));
    facts.push(Fact::new("volver", &page.about.version));
    facts.extend(seeds(page).map(|seeds| Fact::new("seed", seeds)));
    facts.push(Fact::new("machine", &page.about.machine));
    section.blocks.push(Block::Facts(facts));
    section
}

fn seeds(page: &Document) -> Option<String> {
    let seeds: Vec<String> = page.about.seeds.iter().map(ToString::to_string).collect();
    (!seeds.is_empty()).then(|| seeds.join(", "))
}
