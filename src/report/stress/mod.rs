//! The extremes: digits and verdicts, a map a method.

mod grid;
mod json;
mod words;

pub use json::json;

use crate::document::{
    self, About, Block, Column, Conclusion, Document, Fact, Finding, Medium, Section, Table, Tone,
};
use crate::render::{ReportError, write_document};
use crate::study::stress::{Cell, Digits, GROUPS, Verdict};
use grid::Grid;
use std::path::{Path, PathBuf};
pub(super) use words::whole;
use words::{FIGURES, accusation, figure, occurring, omissions, short, summary};

/// The name of the file with the maps of all methods.
const MAPS: &str = "stress";
/// Digits of the darkest colour.
const MOST: f64 = 16.0;

/// A table a method, what is silently wrong, and what figures and codes mean.
#[must_use]
pub fn document(cells: &[Cell], about: &About) -> Document {
    let grid = Grid::new(cells);
    let mut document = Document::new("stress", "The extremes", about.clone());
    let judged = cells.iter().filter(|cell| cell.verdict.is_some()).count();
    let wrong: Vec<&Cell> = cells.iter().filter(|c| c.is_silently_wrong()).collect();
    let tone = if wrong.is_empty() {
        Tone::Good
    } else {
        Tone::Bad
    };
    let kept = cells.len() - judged - wrong.len();
    document.summary = vec![
        Fact::new("silently wrong", wrong.len().to_string()).toned(tone),
        Fact::new("have the digits promised", kept.to_string()).toned(Tone::Good),
        Fact::new("have a verdict", judged.to_string()).toned(Tone::Open),
        Fact::new("cells", cells.len().to_string()),
    ];
    document.conclusion = Some(Conclusion::new(summary(cells)).toned(tone));
    let methods = grid.methods.iter().map(|method| {
        let tables = [Medium::Terminal, Medium::Written].map(|to| table(&grid, method, to));
        Section::of(*method, *method, tables)
    });
    document.sections = methods.collect();
    let accused = wrong
        .into_iter()
        .map(|cell| Block::Finding(Finding::new("", accusation(cell)).toned(Tone::Bad)));
    let accused = Section::of("wrong", "Silently wrong", accused);
    document.sections.extend([accused, words(cells)]);
    document
}

/// Writes `stress.json`, `stress.md`, `stress.svg` with a map a method, and a page, `index.html`, into `dir`; see
/// [`write_document`]. Returns the paths written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, cells: &[Cell], about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let data = [("stress.json".to_string(), json(cells)?)];
    write_document(dir, &document(cells, about), "stress", data)
}

/// Scenarios against formats: a terminal has formats by short names, others have colours by digits.
fn table(grid: &Grid<'_>, method: &str, to: Medium) -> Block {
    let formats = grid.formats.iter().map(|format| {
        let is_short = to == Medium::Terminal;
        Column::number(if is_short {
            short(format)
        } else {
            (*format).into()
        })
    });
    let columns = [Column::text("scenario")].into_iter().chain(formats);
    let caption = format!(
        "{method}: digits of its own value and of the exact radiance, or what befell the run"
    );
    let rows = grid.scenarios.iter().map(|scenario| {
        let cells = grid.formats.iter().map(|format| {
            let cell = grid.cell(scenario, method, format);
            cell.map(|cell| shown(cell, to)).unwrap_or_default()
        });
        let name = document::Cell::text(*scenario);
        std::iter::once(name).chain(cells).collect()
    });
    let table = Table::new(caption, columns).with(rows);
    Block::Table(if to == Medium::Terminal {
        table
    } else {
        table.named(MAPS)
    })
    .only(to)
}

fn shown(cell: &Cell, to: Medium) -> document::Cell {
    let digits = match cell.digits {
        _ if cell.verdict.is_some() => None,
        Some(Digits::Exact) => Some(MOST),
        Some(Digits::Of(digits)) => Some(digits),
        None => None,
    };
    let shown = document::Cell::number(figure(cell), digits);
    match digits {
        _ if cell.is_silently_wrong() => shown.toned(Tone::Bad),
        _ if cell.verdict.is_some() => shown.toned(Tone::Open),
        _ if to == Medium::Terminal => shown.toned(Tone::Good),
        Some(digits) => shown.shaded(digits / MOST),
        None => shown,
    }
}

fn words(cells: &[Cell]) -> Section {
    let meaning =
        |verdict: Verdict| Fact::new(verdict.code(), format!("{verdict}: {}", verdict.meaning()));
    let groups = GROUPS.map(|(group, meaning)| Fact::new(group, meaning));
    let mut blocks = vec![
        Block::Text(format!("{FIGURES}.")),
        Block::Facts(occurring(cells).map(meaning).collect()),
    ];
    blocks.extend(omissions(cells).into_iter().map(Block::Text));
    let scenarios = [
        Block::Text("Scenarios:".into()),
        Block::Facts(groups.into()),
    ];
    blocks.extend(scenarios.map(|block| block.only(Medium::Written)));
    Section::of("words", "Words", blocks).aside()
}
