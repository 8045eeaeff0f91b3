//! A document with a plot a channel.

use super::words::{
    axis, conclusion, failure, failures, fingerprint, floor, label, order, theory, window,
};
use super::{is_drawn, plot_name};
use crate::study::verify::Verification;
use std::fmt::{self, Write};

/// The verification as GitHub Markdown; plots are linked as files beside it ([`write`](super::write()) puts them there).
#[must_use]
pub fn markdown(verification: &Verification) -> String {
    let mut text = String::new();
    // Writing to a String does not fail.
    let _ = document(verification, &mut text);
    text
}

fn document(verification: &Verification, text: &mut String) -> fmt::Result {
    let declaration = &verification.declaration;
    writeln!(text, "# {}\n", escape(&declaration.name))?;
    writeln!(text, "**{}**\n", escape(&conclusion(verification)))?;
    for sentence in fingerprint(verification) {
        writeln!(text, "- {}", escape(&sentence))?;
    }
    for finding in &verification.findings {
        let channels = finding.channels.join(", ");
        writeln!(
            text,
            "- **{}**{} ({})",
            label(verification),
            escape(&finding.defect),
            escape(&channels)
        )?;
    }
    writeln!(text, "\n| run | |\n|---|---|")?;
    let declared = declaration.method.map_or("none".into(), |m| m.name());
    let claimed = declaration.order.map_or("none".into(), |o| o.to_string());
    for (what, value) in [
        ("volver", env!("CARGO_PKG_VERSION").to_string()),
        ("levels", axis(verification)),
        ("declared method", declared),
        ("declared order", claimed),
        ("format", declaration.format.to_string()),
        ("given", declaration.form.to_string()),
    ] {
        writeln!(text, "| {what} | {} |", escape(&value))?;
    }
    writeln!(
        text,
        "\n| case | order | measured | window | floor | verdict | says |\n|---|---|---|---|---|---|---|"
    )?;
    for line in &verification.lines {
        let name = if is_drawn(line) {
            format!("[{}]({})", escape(&line.name), plot_name(line))
        } else {
            escape(&line.name)
        };
        writeln!(
            text,
            "| {name} | {} | {} | {} | {} | {} | {} |",
            theory(line.expected),
            order(line),
            window(line),
            floor(line),
            line.measured.verdict(),
            line.standing
        )?;
    }
    let failed = verification.lines.iter().filter(|line| !line.is_complete());
    for line in failed {
        for group in &failures(line) {
            let words = format!("{}, {}", line.name, failure(group));
            writeln!(text, "\n{}", escape(&words))?;
        }
    }
    Ok(())
}

/// Text that stays text in a table.
fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '|' | '*' | '_' | '`' | '<' | '>' | '[' | ']' | '\\' => {
                escaped.push('\\');
                escaped.push(character);
            }
            control if control.is_control() => escaped.push(' '),
            other => escaped.push(other),
        }
    }
    escaped
}
