//! A study of so many cases and methods that nobody reads a section of each.

use super::words::{NONE, judged, order, theory};
use crate::document::{Block, Cell, Column, Finding, Section, Table, Tone};
use crate::study::sweep::{Line, Results};
use std::collections::BTreeMap;

/// Pairs of a case and a method up to which each has a section and a figure of its own.
pub(super) const PAIRS: usize = 200;
/// Lines that contradict theory up to which all are shown.
const CONTRADICTING: usize = 500;

/// How many pairs of a case and a method there are.
pub(super) fn pairs(results: &Results) -> usize {
    results.header.cases.len() * results.header.methods.len()
}

/// What methods do in formats over all cases, and which lines contradict theory.
pub(super) fn sections(results: &Results) -> Vec<Section> {
    let lines: Vec<&Line> = results.lines.iter().filter(|line| !line.swept).collect();
    let finest = results.header.levels.last().copied().unwrap_or(0);
    let said = format!(
        "{} pairs of a case and a method, more than {PAIRS}, have no sections of their own: the same study with --cases NAME has those of that case, and every line is in the files of tables. Good are orders as in theory, bad those against it; then correct digits of I at n = {finest}, the median over the cases, and the fewest with their case.",
        pairs(results)
    );
    let blocks = [
        Block::Finding(Finding::new("many", said)),
        Block::Table(by_method(results, &lines)),
    ];
    let overview = Section::of("overview", "Methods and formats, over all cases", blocks);
    std::iter::once(overview)
        .chain(contradicting(&lines))
        .collect()
}

/// Lines of a method in a format.
#[derive(Default)]
struct Group<'l> {
    lines: usize,
    good: usize,
    bad: usize,
    /// Correct digits at the finest level, and the case.
    digits: Vec<(f64, &'l str)>,
}

fn by_method(results: &Results, lines: &[&Line]) -> Table {
    let mut groups: BTreeMap<(usize, usize), Group<'_>> = BTreeMap::new();
    let place = |names: &[String], name: &str| names.iter().position(|other| other == name);
    let places = |line: &Line| {
        let method = place(&results.header.methods, &line.row.method)?;
        Some((method, place(&results.header.formats, &line.format)?))
    };
    for line in lines {
        let Some(places) = places(line) else { continue };
        let group = groups.entry(places).or_default();
        group.lines += 1;
        match judged(line) {
            Tone::Good => group.good += 1,
            Tone::Bad => group.bad += 1,
            Tone::Open => {}
        }
        let finest = line.row.levels.last();
        let digits = finest.and_then(|level| line.digits(level));
        group
            .digits
            .extend(digits.map(|digits| (digits, line.case.as_str())));
    }
    let columns = vec![
        Column::text("method"),
        Column::text("format"),
        Column::number("lines"),
        Column::number("good"),
        Column::number("bad"),
        Column::number("median"),
        Column::number("fewest"),
        Column::text("case"),
    ];
    let name = |names: &[String], place: usize| names.get(place).cloned().unwrap_or_default();
    let rows = groups.into_iter().map(|((method, format), mut group)| {
        group.digits.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        let median = group.digits.get(group.digits.len() / 2);
        let count = |count: usize| Cell::number(count.to_string(), count as f64);
        let digits = |found: Option<&(f64, &str)>| match found {
            Some((digits, _)) => Cell::number(format!("{digits:.1}"), *digits),
            None => Cell::text(NONE),
        };
        let fewest = group.digits.first();
        vec![
            Cell::text(name(&results.header.methods, method)),
            Cell::text(name(&results.header.formats, format)),
            count(group.lines),
            count(group.good),
            count(group.bad),
            digits(median),
            digits(fewest),
            Cell::text(fewest.map_or(NONE, |(_, case)| case)),
        ]
    });
    Table::new(
        "Orders and correct digits, a row a method and format",
        columns,
    )
    .with(rows)
}

fn contradicting(lines: &[&Line]) -> Option<Section> {
    let all: Vec<&&Line> = lines
        .iter()
        .filter(|line| line.contradicts_theory())
        .collect();
    let columns = vec![
        Column::text("case"),
        Column::text("method"),
        Column::text("format"),
        Column::text("theory"),
        Column::number("order"),
        Column::verdict("verdict"),
    ];
    let rows = all.iter().take(CONTRADICTING).map(|line| {
        let found = line.summary.order();
        vec![
            Cell::text(&line.case),
            Cell::text(&line.row.method),
            Cell::text(&line.format),
            Cell::text(theory(line.row.expected)),
            Cell::number(order(found), found.order),
            Cell::verdict(found.verdict.name(), judged(line)),
        ]
    });
    let shown = all.len().min(CONTRADICTING);
    let title = format!("Against theory, {shown} of {}", all.len());
    let table = Table::new("Lines against theory", columns).with(rows);
    (!all.is_empty()).then(|| Section::of("against", title, [Block::Table(table)]))
}
