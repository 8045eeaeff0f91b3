//! The report as a document: GitHub Markdown with a plot a case and method.

use super::names::{Figure, figures};
use super::words::{LEGEND, best, crossing, exponent, order, summary, theory, warnings};
use crate::study::sweep::{Line, Results};
use std::fmt::{self, Write};

/// What was run, then for every case and method its figures, format by format, and the plots.
#[must_use]
pub fn markdown(results: &Results) -> String {
    let mut text = String::new();
    // Writing to a String does not fail.
    let _ = document(results, &mut text);
    text
}

fn document(results: &Results, text: &mut String) -> fmt::Result {
    let header = &results.header;
    writeln!(
        text,
        "# A study of errors\n\n{}.\n",
        escape(&summary(results))
    )?;
    writeln!(text, "| run | |\n|---|---|")?;
    let names: Vec<&str> = header
        .cases
        .iter()
        .map(|[name, ..]| name.as_str())
        .collect();
    let levels: Vec<String> = header.levels.iter().map(ToString::to_string).collect();
    let mut formats: Vec<&str> = Vec::new();
    for line in results.lines.iter().filter(|line| !line.swept) {
        if !formats.contains(&line.format.as_str()) {
            formats.push(&line.format);
        }
    }
    for (what, value) in [
        ("volver", header.volver.clone()),
        ("cases", names.join(", ")),
        ("methods", header.methods.join("; ")),
        ("formats", formats.join("; ")),
        ("levels n", levels.join(", ")),
    ] {
        writeln!(text, "| {what} | {} |", escape(&value))?;
    }
    if let Some(bits) = &results.sweep_bits {
        writeln!(text, "| swept bits | {} … {} |", bits.start(), bits.end())?;
    }
    writeln!(text)?;
    for Figure {
        file,
        case,
        method,
        lines,
        is_map,
    } in figures(results)
    {
        if is_map {
            writeln!(
                text,
                "## {}, {}: correct digits\n",
                escape(case),
                escape(method)
            )?;
            writeln!(text, "![Correct digits over n and bits]({file})\n")?;
            continue;
        }
        writeln!(text, "## {}, {}\n", escape(case), escape(method))?;
        table(&lines, text)?;
        writeln!(text, "![The parts of the error against n]({file})\n")?;
        for line in lines {
            for warning in warnings(line) {
                writeln!(text, "- {}: {}", escape(&line.format), escape(&warning))?;
            }
        }
        text.truncate(text.trim_end().len());
        text.push_str("\n\n");
    }
    writeln!(text, "## Words\n")?;
    for (word, meaning) in LEGEND {
        writeln!(text, "- **{}**: {meaning}", escape(word))?;
    }
    Ok(())
}

fn table(lines: &[&Line], text: &mut String) -> fmt::Result {
    if let Some(line) = lines.first() {
        writeln!(
            text,
            "Order that theory expects: {}.\n",
            theory(line.row.expected)
        )?;
    }
    writeln!(
        text,
        "| format | discretization | total | q arithmetic | q input | n\\* | best | bits for {} |",
        crate::study::sweep::TOLERANCES
            .map(|t| format!("{t:e}"))
            .join(", ")
    )?;
    writeln!(text, "|---|---|---|---|---|---|---|---|")?;
    for line in lines {
        let summary = &line.summary;
        let bits = summary
            .bits_needed
            .map(|b| b.bits.map_or("-".into(), |bits| bits.to_string()));
        writeln!(
            text,
            "| {} | {} {} | {} {} | {} | {} | {} | {} | {} |",
            escape(&line.format),
            order(&summary.discretization),
            summary.discretization.verdict,
            order(&summary.total),
            summary.total.verdict,
            exponent(summary.laws.arithmetic),
            exponent(summary.laws.input),
            crossing(line),
            best(line),
            bits.join(", "),
        )?;
    }
    writeln!(text)
}

/// Text that Markdown shows as it stands, in a table too.
pub(in crate::report) fn escape(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        if matches!(
            c,
            '|' | '*' | '_' | '`' | '[' | ']' | '<' | '>' | '\\' | '#'
        ) {
            escaped.push('\\');
        }
        escaped.push(if c.is_control() { ' ' } else { c });
    }
    escaped
}
