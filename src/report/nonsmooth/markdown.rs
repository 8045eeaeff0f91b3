//! The table as a document: GitHub Markdown.

use super::rows;
use super::words::{LEGEND, contradiction, order, summary, theory, usual};
use crate::study::nonsmooth::{BITS, Cell, Kind, Place};
use std::fmt::{self, Write};

/// The table, a section a kind.
#[must_use]
pub fn markdown(cells: &[Cell]) -> String {
    let mut text = String::new();
    // Writing to a String does not fail.
    let _ = document(cells, &mut text);
    text
}

fn document(cells: &[Cell], text: &mut String) -> fmt::Result {
    writeln!(text, "# Orders at jumps and kinks\n")?;
    writeln!(
        text,
        "volver {}, mpfr:{BITS}. {}.\n",
        env!("CARGO_PKG_VERSION"),
        summary(cells)
    )?;
    for kind in Kind::ALL {
        writeln!(text, "## {}\n", kind.title())?;
        let heads = Place::ALL.map(Place::title);
        writeln!(text, "| rule | {} |", heads.join(" | "))?;
        writeln!(text, "|---|{}", "---|".repeat(heads.len()))?;
        for (rule, row) in rows(cells, kind) {
            let entries: Vec<String> = row.iter().map(|c| entry(c)).collect();
            writeln!(text, "| **{rule}** | {} |", entries.join(" | "))?;
        }
        writeln!(text)?;
    }
    for cell in cells.iter().filter(|cell| cell.contradicts_theory()) {
        writeln!(text, "- **{}**", contradiction(cell))?;
    }
    for (word, meaning) in LEGEND {
        writeln!(text, "- **{word}**: {meaning}.")?;
    }
    Ok(())
}

fn entry(cell: &Cell) -> String {
    format!(
        "{} \\[{}\\]<br>doublings: {}",
        order(cell),
        theory(cell.theory),
        usual(cell)
    )
}
