//! The report as a page.

use super::html::{About, Block, Cell, Column, Fact, Page, Section, Table};
use super::svg::plots;
use super::text::style;
use super::tone::{counts, tone};
use super::{Group, groups, legend, proved};
use crate::study::reproduce::{Entry, REPLICAS, Settings};

/// What [`markdown`](super::markdown::reproduction) says, with tables that sort and plots that answer.
#[must_use]
pub fn reproduction(settings: &Settings, entries: &[Entry], about: &About) -> Page {
    let mut about = about.clone();
    about.seeds = vec![settings.seed];
    let mut page = Page::new("reproduce", "Orders of accuracy, measured again", about);
    let verdict = |entry: &Entry| (entry.verdict.name().to_string(), tone(style(entry)));
    page.summary = counts(entries.iter().map(verdict));
    page.summary
        .push(Fact::new("entries", entries.len().to_string()));
    page.sections.push(run(settings));
    for group in groups(entries) {
        let mut section = Section::new(group.file_stem(), group.title());
        section.blocks.push(Block::Table(matrix(&group)));
        section
            .blocks
            .extend(plots::of_table(&group).into_iter().map(Block::Plot));
        section.blocks.push(Block::Table(list(&group)));
        let noted = group
            .entries()
            .filter_map(|entry| Some((entry, entry.note.as_ref()?)));
        let notes: Vec<Fact> = noted
            .map(|(entry, note)| Fact::new(legend::name(entry), note))
            .collect();
        if !notes.is_empty() {
            section
                .blocks
                .push(Block::Text("Why paper and order differ:".into()));
            section.blocks.push(Block::Facts(notes));
        }
        let theorems = proved::theorems(group.entries()).into_iter();
        let theorems = theorems.map(|(theorem, of)| Fact::new(proved::name(theorem), of));
        section
            .blocks
            .push(Block::Text("Proofs of the orders expected:".into()));
        section.blocks.push(Block::Facts(theorems.collect()));
        page.sections.push(section);
    }
    page.sections.push(words(entries));
    page
}

fn run(settings: &Settings) -> Section {
    let join = |items: Vec<String>| items.join(", ");
    let mut section = Section::new("run", "What was run");
    section.blocks.push(Block::Text(
        "The tables of Etiene, Kirby and Silva (2013) beside what the same methods show here."
            .into(),
    ));
    section.blocks.push(Block::Facts(vec![
        Fact::new(
            "tables",
            join(settings.tables.iter().map(ToString::to_string).collect()),
        ),
        Fact::new(
            "formats",
            join(settings.formats.iter().map(ToString::to_string).collect()),
        ),
        Fact::new(
            "levels n",
            join(settings.ladder.iter().map(ToString::to_string).collect()),
        ),
        Fact::new("seed", settings.seed.to_string()),
        Fact::new("replicas of Monte Carlo", REPLICAS.to_string()),
    ]));
    section
}

/// Orders, with the paper's figures below them.
fn matrix(group: &Group<'_>) -> Table {
    let (row_axis, column_axis) = group.table.axes();
    let columns = group.columns();
    let heads = columns.iter().map(|column| Column::number(*column));
    let first = Column::text(format!("{row_axis} \\ {column_axis}"));
    let caption = format!("Order, and the paper's: {row_axis} against {column_axis}");
    let mut table = Table::new(caption, std::iter::once(first).chain(heads));
    for row in &group.rows {
        let of = |column: &&str| row.entries.iter().find(|entry| entry.column == *column);
        let cells = columns
            .iter()
            .map(|column| of(column).map(|entry| cell(entry)).unwrap_or_default());
        table
            .rows
            .push(std::iter::once(Cell::text(row.name)).chain(cells).collect());
    }
    table
}

/// The order, the paper's below it, and the verdict where it is not a pass.
fn cell(entry: &Entry) -> Cell {
    let mut lines = vec![legend::order(entry)];
    if entry.paper.is_some() {
        lines.push(format!("paper {}", legend::paper(entry)));
    }
    if !entry.verdict.passes(Some(entry.expected)) {
        lines.push(entry.verdict.to_string());
    }
    Cell::number(lines.join("\n"), entry.asymptotic_order).toned(tone(style(entry)))
}

fn list(group: &Group<'_>) -> Table {
    let (row_axis, column_axis) = group.table.axes();
    let mut table = Table::new(
        "All entries",
        [
            Column::text(format!("{row_axis} × {column_axis}")),
            Column::number("paper"),
            Column::number("protocol"),
            Column::number("order"),
            Column::number("levels n"),
            Column::verdict("verdict"),
        ],
    );
    for entry in group.entries() {
        let replicas = match entry.replicas {
            Some(replicas) => format!(" ({replicas} replicas in {})", entry.format),
            None => String::new(),
        };
        table.rows.push(vec![
            Cell::text(legend::name(entry) + &replicas),
            Cell::number(legend::paper(entry), entry.paper),
            Cell::number(legend::protocol(entry), entry.protocol_order),
            Cell::number(legend::order(entry), entry.asymptotic_order),
            Cell::number(
                legend::window(entry),
                entry.window.map(|(first, _)| first as f64),
            ),
            Cell::verdict(entry.verdict.name(), tone(style(entry))),
        ]);
    }
    table
}

fn words(entries: &[Entry]) -> Section {
    let mut section = Section::new("words", "Words");
    let mut facts: Vec<Fact> = legend::WORDS
        .iter()
        .map(|(word, meaning)| Fact::new(*word, *meaning))
        .collect();
    for (verdict, count) in legend::counts(entries) {
        facts.push(Fact::new(
            format!("{verdict} ({count})"),
            legend::meaning(verdict),
        ));
    }
    section.blocks.push(Block::Facts(facts));
    section
}
