//! Tables for a terminal.

use super::Grid;
use super::words::{FIGURES, accusation, figure, occurring, omissions, summary};
use crate::report::text::{MIN_WIDTH, Style, paint, wrap};
use crate::study::stress::Cell;
use std::fmt::Write;

/// The columns: a scenario's name, and a format's figures where its name is no longer.
const NAME: usize = 21;
const FIGURE: usize = 7;

/// "fix15", "e4m3": formats by short names.
fn short(format: &str) -> String {
    format.replace("fixed:", "fix").replace("fp8-", "")
}

/// A table a method, scenarios against formats, in at most `width` columns, with ANSI colour where `color`
/// says so. The last line counts the cells.
#[must_use]
pub fn text(cells: &[Cell], width: usize, color: bool) -> String {
    let width = width.max(MIN_WIDTH);
    let grid = Grid::new(cells);
    let mut text = String::new();
    let longest = grid
        .formats
        .iter()
        .map(|format| short(format).len() + 1)
        .max();
    let figure = longest.unwrap_or(0).max(FIGURE);
    let columns = width.saturating_sub(NAME) / figure;
    // Writing to a String does not fail.
    for method in &grid.methods {
        let _ = writeln!(text, "{}", paint(method, Style::Bold, color));
        for formats in grid.formats.chunks(columns.max(1)) {
            table(&grid, method, formats, (figure, color), &mut text);
        }
        text.push('\n');
    }
    for cell in cells.iter().filter(|cell| cell.is_silently_wrong()) {
        for line in wrap(&accusation(cell), width, "! ", "  ") {
            let _ = writeln!(text, "{}", paint(&line, Style::Bad, color));
        }
    }
    let mut faint = |line: &str, first: &str, later: &str| {
        for line in wrap(line, width, first, later) {
            let _ = writeln!(text, "{}", paint(&line, Style::Faint, color));
        }
    };
    faint(FIGURES, "", "  ");
    for verdict in occurring(cells) {
        let code = format!("{:<6}", verdict.code());
        faint(
            &format!("{verdict}: {}", verdict.meaning()),
            &code,
            "      ",
        );
    }
    for line in omissions(cells) {
        faint(&line, "", "  ");
    }
    let _ = writeln!(text, "\n{}", summary(cells));
    text
}

fn table(
    grid: &Grid<'_>,
    method: &str,
    formats: &[&str],
    (figure_width, color): (usize, bool),
    text: &mut String,
) {
    let head = |format: &&str| format!("{:>figure_width$}", short(format));
    let heads: Vec<String> = formats.iter().map(head).collect();
    let head = format!("{:<NAME$}{}", "", heads.concat());
    let _ = writeln!(text, "{}", paint(&head, Style::Faint, color));
    for scenario in &grid.scenarios {
        let _ = write!(text, "{scenario:<NAME$}");
        for format in formats {
            let cell = grid.cell(scenario, method, format);
            let shown = cell.map(figure).unwrap_or_default();
            let style = match cell {
                Some(cell) if cell.is_silently_wrong() => Style::Bad,
                Some(cell) if cell.verdict.is_some() => Style::Open,
                _ => Style::Good,
            };
            let padding = " ".repeat(figure_width.saturating_sub(shown.chars().count()));
            let _ = write!(text, "{padding}{}", paint(&shown, style, color));
        }
        text.push('\n');
    }
}
