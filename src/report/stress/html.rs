//! The tables as a page: their cells are coloured as the heat map's fields.

use super::Grid;
use super::words::{FIGURES, accusation, figure, occurring, omissions};
use crate::document::{self, About, Block, Column, Document, Fact, Section, Table, Tone};
use crate::study::stress::{Cell, Digits, GROUPS};

/// Digits of the darkest colour.
const MOST: f64 = 16.0;

/// What [`markdown`](super::markdown()) says, with tables that sort.
#[must_use]
pub fn page(cells: &[Cell], about: &About) -> Document {
    let grid = Grid::new(cells);
    let mut page = Document::new("stress", "The extremes", about.clone());
    let judged = cells.iter().filter(|cell| cell.verdict.is_some()).count();
    let wrong = cells.iter().filter(|cell| cell.is_silently_wrong()).count();
    let tone = if wrong == 0 { Tone::Good } else { Tone::Bad };
    page.summary = vec![
        Fact::new("silently wrong", wrong.to_string()).toned(tone),
        Fact::new(
            "have the digits promised",
            (cells.len() - judged - wrong).to_string(),
        )
        .toned(Tone::Good),
        Fact::new("have a verdict", judged.to_string()).toned(Tone::Open),
        Fact::new("cells", cells.len().to_string()),
    ];
    let accused = cells.iter().filter(|cell| cell.is_silently_wrong());
    let accused: Vec<Fact> = accused
        .map(|cell| Fact::new(&cell.scenario, accusation(cell)).toned(Tone::Bad))
        .collect();
    if !accused.is_empty() {
        let mut section = Section::new("wrong", "Silently wrong");
        section.blocks.push(Block::Facts(accused));
        page.sections.push(section);
    }
    for method in &grid.methods {
        let mut section = Section::new(*method, *method);
        section
            .blocks
            .push(Block::Table(table(&grid, method).named("stress")));
        page.sections.push(section);
    }
    page.sections.push(words(cells));
    page
}

fn table(grid: &Grid<'_>, method: &str) -> Table {
    let formats = grid.formats.iter().map(|format| Column::number(*format));
    let first = Column::text("scenario");
    let mut table = Table::new(
        format!(
            "{method}: digits of its own value and of the exact radiance, or what befell the run"
        ),
        std::iter::once(first).chain(formats),
    );
    for scenario in &grid.scenarios {
        let cells = grid.formats.iter().map(|format| {
            let cell = grid.cell(scenario, method, format);
            cell.map(shown).unwrap_or_default()
        });
        table.rows.push(
            std::iter::once(document::Cell::text(*scenario))
                .chain(cells)
                .collect(),
        );
    }
    table
}

fn shown(cell: &Cell) -> document::Cell {
    let digits = match cell.digits {
        Some(Digits::Exact) => Some(MOST),
        Some(Digits::Of(digits)) => Some(digits),
        None => None,
    };
    let shown = document::Cell::number(figure(cell), digits.filter(|_| cell.verdict.is_none()));
    match (cell.verdict, digits) {
        _ if cell.is_silently_wrong() => shown.toned(Tone::Bad),
        (Some(_), _) => shown.toned(Tone::Open),
        (None, Some(digits)) => shown.shaded(digits / MOST),
        (None, None) => shown,
    }
}

fn words(cells: &[Cell]) -> Section {
    let mut section = Section::new("words", "Words");
    section.blocks.push(Block::Text(format!("{FIGURES}.")));
    let meaning = |verdict: crate::study::stress::Verdict| {
        Fact::new(format!("{} {verdict}", verdict.code()), verdict.meaning())
    };
    section
        .blocks
        .push(Block::Facts(occurring(cells).map(meaning).collect()));
    section
        .blocks
        .extend(omissions(cells).into_iter().map(Block::Text));
    let groups = GROUPS
        .iter()
        .map(|(group, meaning)| Fact::new(*group, *meaning));
    section.blocks.push(Block::Text("Scenarios:".into()));
    section.blocks.push(Block::Facts(groups.collect()));
    section
}
