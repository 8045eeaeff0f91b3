//! The tables as a document: GitHub Markdown.

use super::Grid;
use super::words::{FIGURES, accusation, figure, occurring, omissions, summary};
use crate::study::stress::{Cell, GROUPS};
use std::fmt::{self, Write};

/// A section a method, beside `stress.svg`.
#[must_use]
pub fn markdown(cells: &[Cell]) -> String {
    let mut text = String::new();
    // Writing to a String does not fail.
    let _ = document(cells, &mut text);
    text
}

fn document(cells: &[Cell], text: &mut String) -> fmt::Result {
    let grid = Grid::new(cells);
    let version = env!("CARGO_PKG_VERSION");
    writeln!(text, "# The extremes\n")?;
    writeln!(text, "volver {version}. {}.\n", summary(cells))?;
    writeln!(text, "![Digits and verdicts](stress.svg)\n")?;
    for cell in cells.iter().filter(|cell| cell.is_silently_wrong()) {
        writeln!(text, "- **{}**", accusation(cell))?;
    }
    writeln!(text, "{FIGURES}.\n")?;
    for verdict in occurring(cells) {
        writeln!(
            text,
            "- `{}` **{verdict}**: {}",
            verdict.code(),
            verdict.meaning()
        )?;
    }
    for line in omissions(cells) {
        writeln!(text, "- {line}")?;
    }
    writeln!(text, "\nScenarios:\n")?;
    for (group, meaning) in GROUPS {
        writeln!(text, "- **{group}**: {meaning}")?;
    }
    for method in &grid.methods {
        writeln!(text, "\n## {method}\n")?;
        writeln!(text, "| scenario | {} |", grid.formats.join(" | "))?;
        writeln!(text, "|---|{}", "---:|".repeat(grid.formats.len()))?;
        for scenario in &grid.scenarios {
            let figures = grid.formats.iter().map(|format| {
                let cell = grid.cell(scenario, method, format);
                cell.map(figure).unwrap_or_default()
            });
            let figures: Vec<String> = figures.collect();
            writeln!(text, "| {scenario} | {} |", figures.join(" | "))?;
        }
    }
    Ok(())
}
