//! The paper's tables, measured again.

mod group;
mod json;
mod plots;
mod proved;
mod words;

pub use group::{Group, Row, groups};
pub use json::json;
pub use plots::of_table;

use super::counts::counts;
use crate::convergence::Verdict;
use crate::document::{
    About, Block, Cell, Column, Conclusion, Document, Fact, Figure, Finding, Medium, Section,
    Table, Tone,
};
use crate::render::{ReportError, write_document};
use crate::study::reproduce::{Entry, REPLICAS, Settings};
use std::path::{Path, PathBuf};

/// For every table its orders beside the paper's figures, its plots, all entries, why they differ and what proves them.
#[must_use]
pub fn document(settings: &Settings, entries: &[Entry], about: &About) -> Document {
    let mut about = about.clone();
    about.seeds = vec![settings.seed];
    let mut document = Document::new("reproduce", "Orders of accuracy, measured again", about);
    let verdict = |entry: &Entry| (entry.verdict.name().to_string(), tone(entry));
    document.summary = counts(entries.iter().map(verdict));
    document
        .summary
        .push(Fact::new("entries", entries.len().to_string()));
    document.conclusion = Some(Conclusion::new(words::summary(entries)));
    document.sections.push(run(settings));
    document
        .sections
        .extend(groups(entries).iter().map(section));
    if !entries.is_empty() {
        document.sections.push(legend(entries));
    }
    document
}

/// Writes `report.md`, `report.json`, one figure a table (`table-1-exact.svg` …) and a page, `index.html`, into `dir`; see
/// [`write_document`]. Returns the paths written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(
    dir: &Path,
    settings: &Settings,
    entries: &[Entry],
    about: &About,
) -> Result<Vec<PathBuf>, ReportError> {
    let data = [("report.json".to_string(), json(settings, entries)?)];
    write_document(dir, &document(settings, entries, about), "report", data)
}

fn run(settings: &Settings) -> Section {
    let join = |items: Vec<String>| items.join(", ");
    let blocks = [
        Block::Text(
            "The tables of Etiene, Kirby and Silva (2013) beside what the same methods show here."
                .into(),
        ),
        Block::Facts(vec![
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
        ]),
    ];
    let blocks = blocks.map(|block| block.only(Medium::Written));
    Section::of("run", "What was run", blocks)
}

fn section(group: &Group<'_>) -> Section {
    let mut blocks = vec![
        Block::Table(matrix(group)).only(Medium::Written),
        Block::Figure(Figure::new(
            group.file_stem(),
            group.title(),
            of_table(group),
        )),
        Block::Table(list(group)),
    ];
    let noted = group
        .entries()
        .filter_map(|entry| Some((entry, entry.note.as_ref()?)));
    let notes = noted.map(|(entry, note)| Finding::new(words::name(entry), note));
    let mut notes = notes.map(Block::Finding).peekable();
    if notes.peek().is_some() {
        blocks.push(Block::Text("Why paper and order differ:".into()));
        blocks.extend(notes);
    }
    let theorems = proved::theorems(group.entries()).into_iter();
    let theorems = theorems.map(|(theorem, of)| Fact::new(proved::name(theorem), of));
    blocks.push(Block::Text("Proofs of the orders expected:".into()));
    blocks.push(Block::Facts(theorems.collect()));
    Section::of(group.file_stem(), group.title(), blocks)
}

/// Orders, with the paper's figures below them.
fn matrix(group: &Group<'_>) -> Table {
    let (row_axis, column_axis) = group.table.axes();
    let columns = group.columns();
    let heads = columns.iter().map(|column| Column::number(*column));
    let first = Column::text(format!("{row_axis} \\ {column_axis}"));
    let caption = format!("Order, and the paper's: {row_axis} against {column_axis}");
    let rows = group.rows.iter().map(|row| {
        let of = |column: &&str| row.entries.iter().find(|entry| entry.column == *column);
        let cells = columns
            .iter()
            .map(|column| of(column).map(|entry| cell(entry)).unwrap_or_default());
        std::iter::once(Cell::text(row.name)).chain(cells).collect()
    });
    Table::new(caption, std::iter::once(first).chain(heads)).with(rows)
}

/// The order, the paper's below it, and the verdict where it is not a pass.
fn cell(entry: &Entry) -> Cell {
    let mut lines = vec![words::order(entry)];
    if entry.paper.is_some() {
        lines.push(format!("paper {}", words::paper(entry)));
    }
    if !entry.verdict.passes(Some(entry.expected)) {
        lines.push(entry.verdict.to_string());
    }
    Cell::number(lines.join("\n"), entry.asymptotic_order).toned(tone(entry))
}

/// All entries, row by row.
fn list(group: &Group<'_>) -> Table {
    let (row_axis, column_axis) = group.table.axes();
    let columns = [
        Column::text(row_axis).grouping(),
        Column::text(column_axis),
        Column::number("paper"),
        Column::number("protocol"),
        Column::number("order"),
        Column::number("levels n"),
        Column::verdict("verdict"),
    ];
    let rows = group.entries().map(|entry| {
        let replicas = match entry.replicas {
            Some(replicas) => format!(" ({replicas} replicas in {})", entry.format),
            None => String::new(),
        };
        let first = entry.window.map(|(first, _)| first as f64);
        vec![
            Cell::text(format!("{}{replicas}", entry.row)),
            Cell::text(entry.column),
            Cell::number(words::paper(entry), entry.paper),
            Cell::number(words::protocol(entry), entry.protocol_order),
            Cell::number(words::order(entry), entry.asymptotic_order),
            Cell::number(words::window(entry), first),
            Cell::verdict(entry.verdict.name(), tone(entry)),
        ]
    });
    Table::new("All entries", columns).with(rows)
}

fn legend(entries: &[Entry]) -> Section {
    let words = words::WORDS
        .iter()
        .map(|(word, meaning)| Fact::new(*word, *meaning));
    let verdicts = words::counts(entries).into_iter();
    let verdicts = verdicts
        .map(|(verdict, count)| Fact::new(format!("{verdict} ({count})"), words::meaning(verdict)));
    Section::of(
        "words",
        "Words",
        [Block::Facts(words.chain(verdicts).collect())],
    )
    .aside()
}

/// How good or bad an entry's verdict is.
fn tone(entry: &Entry) -> Tone {
    match entry.verdict {
        verdict if verdict.passes(Some(entry.expected)) => Tone::Good,
        Verdict::TooLow
        | Verdict::TooHigh
        | Verdict::Stalled
        | Verdict::Diverged
        | Verdict::NotFinite => Tone::Bad,
        _ => Tone::Open,
    }
}
