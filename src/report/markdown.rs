//! The report as a document: GitHub Markdown with a plot a table.

use super::{Group, groups, legend, proved};
use crate::study::reproduce::{Entry, REPLICAS, Settings};
use std::fmt::{self, Write};

/// The report: what was run, then for every table its orders beside the paper's figures, its plot,
/// all entries and why they differ. Plots are linked as `table-1-exact.svg` and so on, next to
/// the document ([`write_directory`](super::write_directory) puts them there).
#[must_use]
pub fn reproduction(settings: &Settings, entries: &[Entry]) -> String {
    let mut text = String::new();
    // Writing to a String does not fail.
    let _ = document(settings, entries, &mut text);
    text
}

fn document(settings: &Settings, entries: &[Entry], text: &mut String) -> fmt::Result {
    writeln!(text, "# Orders of accuracy, measured again\n")?;
    writeln!(
        text,
        "The tables of Etiene, Kirby and Silva (2013) beside what the same methods show here: {}.\n",
        legend::summary(entries)
    )?;
    run(settings, text)?;
    for group in groups(entries) {
        writeln!(text, "## {}\n", escape(&group.title()))?;
        matrix(&group, text)?;
        let stem = group.file_stem();
        writeln!(
            text,
            "![Error against segments, one panel a row]({stem}.svg)\n"
        )?;
        list(&group, text)?;
        notes(&group, text)?;
        theorems(&group, text)?;
    }
    words(entries, text)
}

fn run(settings: &Settings, text: &mut String) -> fmt::Result {
    let join = |items: Vec<String>| items.join(", ");
    let tables = join(settings.tables.iter().map(ToString::to_string).collect());
    let formats = join(settings.formats.iter().map(ToString::to_string).collect());
    let ladder = join(settings.ladder.iter().map(ToString::to_string).collect());
    writeln!(text, "| run | |\n|---|---|")?;
    for (what, value) in [
        ("volver", env!("CARGO_PKG_VERSION").to_string()),
        ("tables", tables),
        ("formats", formats),
        ("levels n", ladder),
        ("seed", settings.seed.to_string()),
        ("replicas of Monte Carlo", REPLICAS.to_string()),
    ] {
        writeln!(text, "| {what} | {} |", escape(&value))?;
    }
    writeln!(text)
}

/// Orders, with the paper's figures below them.
fn matrix(group: &Group<'_>, text: &mut String) -> fmt::Result {
    let (row_axis, column_axis) = group.table.axes();
    let columns = group.columns();
    writeln!(
        text,
        "| {row_axis} \\\\ {column_axis} | {} |",
        columns.join(" | ")
    )?;
    writeln!(text, "|---|{}", "---|".repeat(columns.len()))?;
    for row in &group.rows {
        write!(text, "| **{}** |", escape(row.name))?;
        for column in &columns {
            let entry = row.entries.iter().find(|e| e.column == *column);
            write!(text, " {} |", entry.map_or(String::new(), |e| cell(e)))?;
        }
        writeln!(text)?;
    }
    writeln!(text)
}

/// "4.003 ± 0.009", "paper 4.80" below it, and the verdict where it is not a pass.
fn cell(entry: &Entry) -> String {
    let mut cell = escape(&legend::order(entry));
    if entry.paper.is_some() {
        let _ = write!(cell, "<br>paper {}", legend::paper(entry));
    }
    if !entry.verdict.passes(Some(entry.expected)) {
        let _ = write!(cell, "<br>*{}*", entry.verdict);
    }
    cell
}

fn list(group: &Group<'_>, text: &mut String) -> fmt::Result {
    let (row_axis, column_axis) = group.table.axes();
    writeln!(
        text,
        "| {row_axis} × {column_axis} | paper | protocol | order | levels n | verdict |"
    )?;
    writeln!(text, "|---|--:|--:|--:|--:|---|")?;
    for entry in group.entries() {
        let replicas = match entry.replicas {
            Some(replicas) => format!(" ({replicas} replicas in {})", entry.format),
            None => String::new(),
        };
        writeln!(
            text,
            "| {}{} | {} | {} | {} | {} | {} |",
            escape(&legend::name(entry)),
            escape(&replicas),
            legend::paper(entry),
            legend::protocol(entry),
            legend::order(entry),
            legend::window(entry),
            entry.verdict,
        )?;
    }
    writeln!(text)
}

fn notes(group: &Group<'_>, text: &mut String) -> fmt::Result {
    let mut any = false;
    for entry in group.entries() {
        let Some(note) = &entry.note else { continue };
        if !any {
            writeln!(text, "Why paper and order differ:\n")?;
            any = true;
        }
        let name = escape(&legend::name(entry));
        writeln!(text, "- **{name}**: {}", escape(note))?;
    }
    if any { writeln!(text) } else { Ok(()) }
}

fn theorems(group: &Group<'_>, text: &mut String) -> fmt::Result {
    writeln!(text, "Proofs of the orders expected:\n")?;
    for (theorem, entries) in proved::theorems(group.entries()) {
        let name = theorem.map_or("no theorem".into(), |t| format!("`{}`, {}", t.name, t.file));
        writeln!(text, "- {name}: {}", escape(&entries))?;
    }
    writeln!(text)
}

fn words(entries: &[Entry], text: &mut String) -> fmt::Result {
    writeln!(text, "## Words\n")?;
    for (word, meaning) in legend::WORDS {
        writeln!(text, "- **{word}**: {meaning}.")?;
    }
    for (verdict, count) in legend::counts(entries) {
        writeln!(
            text,
            "- verdict **{verdict}** ({count}): {}.",
            legend::meaning(verdict)
        )?;
    }
    Ok(())
}

/// Text in which nothing is markup, in a cell or elsewhere; lines become one.
fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '\n' | '\r' => escaped.push(' '),
            '\\' | '|' | '*' | '_' | '`' | '<' | '>' | '[' | ']' | '~' | '#' | '&' => {
                escaped.push('\\');
                escaped.push(c);
            }
            other => escaped.push(other),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::super::fixture::{entry, replicated};
    use super::*;
    use crate::convergence::Verdict;

    fn report() -> String {
        let mut stalled = replicated("monte-carlo", "boole");
        stalled.verdict = Verdict::Stalled;
        stalled.note = Some("a|b *c*\n<d>".into());
        let entries = [
            entry("simpson", "trapezoid"),
            entry("simpson", "boole"),
            stalled,
        ];
        reproduction(&Settings::default(), &entries)
    }

    #[test]
    fn the_run_is_stated() {
        let text = report();
        for line in [
            concat!("| volver | ", env!("CARGO_PKG_VERSION"), " |"),
            "| tables | 1, 2 |",
            "| formats | mpfr:128 |",
            "| levels n | 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096 |",
            "| seed | 1 |",
            "| replicas of Monte Carlo | 64 |",
        ] {
            assert!(text.lines().any(|l| l == line), "{line}\n{text}");
        }
    }

    #[test]
    fn the_matrix_has_a_cell_a_column_even_where_an_entry_is_missing() {
        let text = report();
        let rows = "\
| inner \\\\ outer | trapezoid | boole |
|---|---|---|
| **simpson** | 4.000 ± 0.009<br>paper 4.80 | 4.000 ± 0.009<br>paper 4.80 |
| **monte-carlo** |  | 0.500 ± 0.050<br>paper 0.42<br>*Stalled* |
";
        assert!(text.contains(rows), "{text}");
    }

    #[test]
    fn entries_and_notes_are_listed_and_escaped() {
        let text = report();
        assert!(text.contains(
            "| simpson × boole | 4.80 | 4.68 | 4.000 ± 0.009 | 16 … 256 | Confirmed |\n"
        ));
        assert!(text.contains("| monte-carlo × boole (64 replicas in f64) | 0.42 |"));
        assert!(text.contains("- **monte-carlo × boole**: a\\|b \\*c\\* \\<d\\>\n"));
        assert!(text.contains("](table-1-exact.svg)\n"));
        assert!(text.contains("- verdict **Confirmed** (2): "));
        assert!(!text.contains("Diverged"));
    }

    #[test]
    fn every_row_of_a_table_has_as_many_cells() {
        let mut cells = None;
        for line in report().lines() {
            if !line.starts_with('|') {
                cells = None;
                continue;
            }
            let here = line.replace("\\|", "").matches('|').count();
            assert_eq!(*cells.get_or_insert(here), here, "{line}");
        }
    }
}
