//! The table for a terminal.

use super::super::text::{MIN_WIDTH, Style, paint, wrap};
use super::rows;
use super::words::{LEGEND, contradiction, order, summary, theory, usual};
use crate::study::nonsmooth::{Cell, Kind, Place};
use std::fmt::Write;

/// The columns: the rule's, and each place's.
const RULE: usize = 11;
const CELL: usize = 22;

/// The table in at most 80 columns, its legend in at most `width`, with ANSI colour where `color` says so.
/// The last line counts what agrees with theory.
#[must_use]
pub fn text(cells: &[Cell], width: usize, color: bool) -> String {
    let mut text = String::new();
    // Writing to a String does not fail.
    for kind in Kind::ALL {
        let _ = writeln!(text, "{}", paint(kind.title(), Style::Bold, color));
        let head = Place::ALL.map(|place| format!("{:<CELL$}", place.title()));
        let head = format!("{:<RULE$}{}", "rule", head.concat());
        let _ = writeln!(text, "{}", paint(head.trim_end(), Style::Faint, color));
        for (rule, row) in rows(cells, kind) {
            let _ = write!(text, "{rule:<RULE$}");
            for cell in &row {
                let figure = format!("{} [{}]", order(cell), theory(cell.theory));
                let style = if cell.contradicts_theory() {
                    Style::Bad
                } else {
                    Style::Good
                };
                let padding = " ".repeat(CELL.saturating_sub(figure.chars().count()));
                let _ = write!(text, "{}{padding}", paint(&figure, style, color));
            }
            trim(&mut text);
            let usual: Vec<String> = row.iter().map(|c| format!("{:<CELL$}", usual(c))).collect();
            let line = format!("{:<RULE$}{}", " doublings", usual.concat());
            let _ = writeln!(text, "{}", paint(line.trim_end(), Style::Faint, color));
        }
        text.push('\n');
    }
    let width = width.max(MIN_WIDTH);
    for cell in cells.iter().filter(|cell| cell.contradicts_theory()) {
        for line in wrap(&contradiction(cell), width, "! ", "  ") {
            let _ = writeln!(text, "{}", paint(&line, Style::Bad, color));
        }
    }
    for (word, meaning) in LEGEND {
        for line in wrap(meaning, width, &format!("{word:<15}"), &" ".repeat(15)) {
            let _ = writeln!(text, "{}", paint(&line, Style::Faint, color));
        }
    }
    let _ = writeln!(text, "\n{}", summary(cells));
    text
}

/// Ends a line without the blanks of its last column.
fn trim(text: &mut String) {
    text.truncate(text.trim_end_matches(' ').len());
    text.push('\n');
}
