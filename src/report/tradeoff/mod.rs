//! Error against cost.

mod json;
mod plot;
mod runs;
mod tables;
mod words;

pub use json::json;

use super::names::FileNames;
use super::unproved::not_proved;
use crate::document::{
    About, Block, Cell, Column, Document, Fact, Figure, Finding, Medium, Section, Table, Tone,
};
use crate::render::{ReportError, write_document};
use crate::study::tradeoff::{CaseResults, Cost, Results, standings};
use std::path::{Path, PathBuf};
use tables::{cheapest, front, goals, paper};
use words::{model, relative, states, unreached};

/// Methods and formats on fronts that a terminal shows.
const NAMED: usize = 12;

const WORDS: [(&str, &str); 2] = [
    (
        "usual",
        "left Riemann sums with opacity 1 − e^(−τd) in binary32, front-to-back/front/subtraction",
    ),
    ("cannot", "at no n that was run"),
];

/// For every case its plot, the cheapest way to each error and the front; then how often methods are on one. All runs are a
/// table for CSV, the cheapest ways one for LaTeX.
#[must_use]
pub fn document(results: &Results, about: &About) -> Document {
    let mut document = Document::new("tradeoff", "Error against cost", about.clone());
    let header = &results.header;
    let count = |name: &str, count: usize| Fact::new(name, count.to_string());
    document.summary = vec![
        count("cases", results.cases.len()),
        count("methods", header.methods.len()),
        count("formats", header.formats.len()),
        count("levels", header.levels.len()),
    ];
    document.sections.push(run(results));
    let mut names = FileNames::default();
    for case in &results.cases {
        let file = names.next("tradeoff", &[&case.name]);
        document.sections.push(section(case, results.cost, file));
    }
    document.sections.extend(fronts(results));
    let words = WORDS.iter();
    let words = words.map(|(word, meaning)| Fact::new(*word, *meaning));
    let mut words = Section::of("words", "Words", [Block::Facts(words.collect())]).aside();
    words.blocks.extend(said(results, Medium::Terminal));
    document.sections.push(words);
    document
}

/// Writes one figure a case, `tradeoff.csv`, `tradeoff.json`, `tradeoff.tex`, `tradeoff.md`, which shows them, and a page,
/// `index.html`, into `dir`; see [`write_document`]. Returns the paths written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, results: &Results, about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let data = [("tradeoff.json".to_string(), json(results)?)];
    write_document(dir, &document(results, about), "tradeoff", data)
}

fn run(results: &Results) -> Section {
    let header = &results.header;
    let levels: Vec<String> = header.levels.iter().map(ToString::to_string).collect();
    let facts = vec![
        Fact::new("cost", results.cost.to_string()),
        Fact::new("methods", header.methods.join("; ")),
        Fact::new("formats", header.formats.join("; ")),
        Fact::new("levels n", levels.join(", ")),
    ];
    let mut section = Section::of(
        "run",
        "What was run",
        [
            Block::Facts(facts).only(Medium::Written),
            Block::Table(runs::table(results)).only(Medium::Csv),
            Block::Table(paper(results)).only(Medium::Latex),
        ],
    );
    section.blocks.extend(said(results, Medium::Written));
    section
}

/// How far times can be believed: what was run, to those with room, and after all results on a terminal.
fn said(results: &Results, medium: Medium) -> impl Iterator<Item = Block> {
    let lines = model(results).into_iter();
    lines.map(move |line| Block::Text(line).only(medium))
}

fn section(case: &CaseResults, cost: Cost, file: String) -> Section {
    let title = format!("{}: {}", case.name, relative(case));
    let plot = plot::plot(case, cost);
    let figure = Figure::new(file, &plot.title, [plot.clone()]);
    let mut section = Section::of(
        &case.name,
        title,
        [
            Block::Text(format!("{}.", states(case))),
            Block::Figure(figure),
            Block::Table(goals(case, cost)).only(Medium::Written),
            Block::Table(cheapest(case, cost)).only(Medium::Terminal),
        ],
    );
    if let Some(unreached) = unreached(&case.goals(cost)) {
        let finding = Finding::new("", unreached).toned(Tone::Open);
        section.blocks.push(Block::Finding(finding));
    }
    let open = case.unproved.iter();
    let open = open.map(|open| not_proved(&case.name, open));
    section.blocks.extend(open);
    section
        .blocks
        .push(Block::Text("The front:".into()).only(Medium::Markdown));
    let front = Block::Table(front(case, cost)).only(Medium::Written);
    section.blocks.push(front);
    section
}

/// How often methods are on a front; nothing where there is none.
fn fronts(results: &Results) -> Option<Section> {
    let columns = [
        Column::text("method"),
        Column::text("format"),
        Column::number("cases"),
        Column::number("points"),
    ];
    let number = |count: usize| Cell::number(count.to_string(), count as f64);
    let standings = standings(results, results.cost).into_iter();
    let rows = standings.map(|standing| {
        vec![
            Cell::text(standing.method),
            Cell::text(standing.format),
            number(standing.cases),
            number(standing.points),
        ]
    });
    let caption = "How often a method is on a Pareto front";
    let table = Table::new(caption, columns).at_most(NAMED).with(rows);
    let (cost, of) = (results.cost, results.cases.len());
    let title = format!("Pareto fronts by {cost}: on how many of {of}");
    let is_bare = table.rows.is_empty();
    (!is_bare).then(|| Section::of("fronts", title, [Block::Table(table)]))
}
