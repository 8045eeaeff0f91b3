//! The verification as a page.

use super::text::style;
use super::words::{
    axis, conclusion, failure, failures, fingerprint, floor, label, order, theory, window,
};
use super::{is_drawn, plot_name};
use crate::document::{self, About, Block, Cell, Column, Document, Fact, Section, Table, Tone};
use crate::method::Expected;
use crate::report::plots;
use crate::report::tone::tone;
use crate::study::verify::{Conclusion, Line, Measured, Verification};

/// What [`markdown`](super::markdown()) says, with a table that sorts and plots that answer.
#[must_use]
pub fn page(verification: &Verification, about: &About) -> Document {
    let mut page = Document::new("verify", &verification.declaration.name, about.clone());
    page.summary = summary(verification);
    page.sections.push(findings(verification));
    page.sections.push(channels(verification));
    let drawn = verification.lines.iter().filter(|line| is_drawn(line));
    let plots: Vec<Block> = drawn
        .filter_map(|line| match &line.measured {
            Measured::Fitted { fit, samples } => {
                Some((line, plots::of_convergence(samples, fit, &line.name)))
            }
            Measured::Scattered(_) | Measured::Nothing => None,
        })
        .map(|(line, plot)| {
            let file = plot_name(line);
            let file = file.trim_end_matches(".svg");
            Block::Figure(document::Figure::new(file, &line.name, [plot]))
        })
        .collect();
    if !plots.is_empty() {
        let mut section = Section::new("plots", "Errors against segments");
        section.blocks = plots;
        page.sections.push(section);
    }
    page.sections.push(run(verification));
    page
}

fn summary(verification: &Verification) -> Vec<Fact> {
    let counts = verification.counts();
    let (word, tone) = match verification.conclusion() {
        Conclusion::Confirmed => ("confirmed", Tone::Good),
        Conclusion::NotConfirmed => ("not confirmed", Tone::Bad),
        Conclusion::CouldNotRun => ("could not run", Tone::Bad),
    };
    let bad = |count: usize| if count == 0 { None } else { Some(Tone::Bad) };
    let mut facts = vec![Fact::new("the kernel is", word).toned(tone)];
    for (name, count, tone) in [
        ("confirmed", counts.confirmed, Some(Tone::Good)),
        (
            "contradicted",
            counts.contradicted,
            bad(counts.contradicted),
        ),
        ("inconclusive", counts.inconclusive, Some(Tone::Open)),
        ("blind", counts.blind, Some(Tone::Open)),
        ("failed", counts.failed, bad(counts.failed)),
    ] {
        if count > 0 || name == "contradicted" {
            facts.push(Fact {
                tone,
                ..Fact::new(name, count.to_string())
            });
        }
    }
    facts.push(Fact::new("channels", verification.lines.len().to_string()));
    facts
}

fn findings(verification: &Verification) -> Section {
    let mut section = Section::new("findings", "What the values say");
    section.blocks.push(Block::Text(conclusion(verification)));
    section
        .blocks
        .extend(fingerprint(verification).into_iter().map(Block::Text));
    let tone = if verification.declaration.stochastic {
        Tone::Open
    } else {
        Tone::Bad
    };
    let facts = verification.findings.iter().map(|finding| {
        let words = format!("{}{}", label(verification), finding.defect);
        Fact::new(words, finding.channels.join(", ")).toned(tone)
    });
    let facts: Vec<Fact> = facts.collect();
    if !facts.is_empty() {
        section.blocks.push(Block::Facts(facts));
    }
    section
}

fn channels(verification: &Verification) -> Section {
    let mut table = Table::new(
        "Order and verdict, a row a channel",
        [
            Column::text("case"),
            Column::number("order"),
            Column::number("measured"),
            Column::number("window"),
            Column::number("floor"),
            Column::text("verdict"),
            Column::verdict("says"),
        ],
    );
    table.rows = verification.lines.iter().map(row).collect();
    let mut section = Section::new("channels", "Channels");
    section.blocks.push(Block::Table(table));
    let without = verification.lines.iter().filter(|line| !line.is_complete());
    let failed = without.flat_map(|line| {
        let fact =
            |group: &(Vec<u64>, String)| Fact::new(&line.name, failure(group)).toned(Tone::Bad);
        failures(line).iter().map(fact).collect::<Vec<Fact>>()
    });
    let failed: Vec<Fact> = failed.collect();
    if !failed.is_empty() {
        section.blocks.push(Block::Facts(failed));
    }
    section
}

fn row(line: &Line) -> Vec<Cell> {
    let expected = match line.expected {
        Some(Expected::Order(order)) => Some(order),
        _ => None,
    };
    let (first, least) = match &line.measured {
        Measured::Fitted { fit, .. } => (
            fit.window.map(|window| window.first as f64),
            Some(fit.floor.to_f64()).filter(|floor| *floor > 0.0),
        ),
        Measured::Scattered(_) | Measured::Nothing => (None, None),
    };
    vec![
        Cell::text(&line.name),
        Cell::number(theory(line.expected), expected),
        Cell::number(order(line), line.measured.order().map(|(order, _)| order)),
        Cell::number(window(line), first),
        Cell::number(floor(line), least),
        Cell::text(line.measured.verdict().name()),
        Cell::verdict(line.standing.name(), tone(style(line.standing))),
    ]
}

fn run(verification: &Verification) -> Section {
    let declaration = &verification.declaration;
    let declared = declaration.method.map_or("none".into(), |m| m.name());
    let claimed = declaration.order.map_or("none".into(), |o| o.to_string());
    let mut section = Section::new("run", "What was run");
    section.blocks.push(Block::Facts(vec![
        Fact::new("levels", axis(verification)),
        Fact::new("declared method", declared),
        Fact::new("declared order", claimed),
        Fact::new("format", declaration.format.to_string()),
        Fact::new("given", declaration.form.to_string()),
    ]));
    section
}
