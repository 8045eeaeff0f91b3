//! The report as a page.

use super::names::{Figure, figures};
use super::text::style;
use super::words::{LEGEND, best, crossing, exponent, order, theory, warnings};
use crate::convergence::Fit;
use crate::document::{self, About, Block, Cell, Column, Document, Fact, Section, Table, Tone};
use crate::report::plots;
use crate::report::tone::{counts, tone};
use crate::study::sweep::{Line, Results, TOLERANCES};
use std::f64::consts::LOG10_2;

/// What [`markdown`](super::markdown()) says, with tables that sort and plots that answer.
#[must_use]
pub fn page(results: &Results, about: &About) -> Document {
    let mut page = Document::new("study", "A study of errors", about.clone());
    let lines = || results.lines.iter().filter(|line| !line.swept);
    page.summary = counts(lines().map(|line| {
        let verdict = line.summary.discretization.verdict;
        (verdict.name().to_string(), judged(line))
    }));
    page.summary
        .push(Fact::new("lines", lines().count().to_string()));
    page.sections.push(run(results));
    for figure in figures(results) {
        page.sections.push(section(&figure));
    }
    let mut words = Section::new("words", "Words");
    let legend = LEGEND
        .iter()
        .map(|(word, meaning)| Fact::new(*word, *meaning));
    words.blocks.push(Block::Facts(legend.collect()));
    page.sections.push(words);
    page
}

fn judged(line: &Line) -> Tone {
    let verdict = line.summary.discretization.verdict;
    tone(style(verdict, line.contradicts_theory()))
}

fn run(results: &Results) -> Section {
    let header = &results.header;
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
    let mut facts = vec![
        Fact::new("cases", names.join(", ")),
        Fact::new("methods", header.methods.join("; ")),
        Fact::new("formats", formats.join("; ")),
        Fact::new("levels n", levels.join(", ")),
    ];
    if let Some(bits) = &results.sweep_bits {
        let range = format!("{} … {}", bits.start(), bits.end());
        facts.push(Fact::new("swept bits", range));
    }
    let mut section = Section::new("run", "What was run");
    section.blocks.push(Block::Text(
        "The verdicts above are on the order of the discretization error, a line a case, method and format.".into(),
    ));
    section.blocks.push(Block::Facts(facts));
    section
}

fn section(figure: &Figure<'_>) -> Section {
    let Figure {
        file,
        case,
        method,
        lines,
        is_map,
    } = figure;
    let id = file.trim_end_matches(".svg");
    if *is_map {
        let mut section = Section::new(id, format!("{case}, {method}: correct digits"));
        section.blocks.push(Block::Table(map(lines).named(id)));
        return section;
    }
    let mut section = Section::new(id, format!("{case}, {method}"));
    if let Some(line) = lines.first() {
        let words = format!("Order that theory expects: {}.", theory(line.row.expected));
        section.blocks.push(Block::Text(words));
    }
    section.blocks.push(Block::Table(table(lines)));
    section.blocks.extend([Block::Figure(document::Figure::new(
        id,
        format!("{case}, {method}"),
        plots::of_split(lines),
    ))]);
    let remarks = lines.iter().flat_map(|line| {
        let remark = |warning| Fact::new(&line.format, warning).toned(Tone::Open);
        warnings(line).into_iter().map(remark)
    });
    let remarks: Vec<Fact> = remarks.collect();
    if !remarks.is_empty() {
        section.blocks.push(Block::Facts(remarks));
    }
    section
}

fn table(lines: &[&Line]) -> Table {
    let mut columns = vec![
        Column::text("format"),
        Column::number("discretization"),
        Column::verdict("verdict"),
        Column::number("total"),
        Column::verdict("verdict of total"),
        Column::number("q arithmetic"),
        Column::number("q input"),
        Column::number("n*"),
        Column::logarithm("best"),
    ];
    columns.extend(TOLERANCES.map(|t| Column::number(format!("bits for {t:e}"))));
    let mut table = Table::new("Orders and roundoff, a row a format", columns);
    table.rows = lines.iter().map(|line| row(line)).collect();
    table
}

fn row(line: &Line) -> Vec<Cell> {
    let summary = &line.summary;
    let number = |fit: &Fit| Cell::number(order(fit), fit.order);
    let total = &summary.total;
    let laws = &summary.laws;
    let mut cells = vec![
        Cell::text(&line.format),
        number(&summary.discretization),
        Cell::verdict(summary.discretization.verdict.name(), judged(line)),
        number(total),
        Cell::verdict(total.verdict.name(), tone(style(total.verdict, false))),
        Cell::number(
            exponent(laws.arithmetic),
            laws.arithmetic.map(|law| law.exponent),
        ),
        Cell::number(exponent(laws.input), laws.input.map(|law| law.exponent)),
        Cell::number(crossing(line), summary.crossing),
        Cell::number(
            best(line),
            summary.best.as_ref().map(|best| best.log2_error * LOG10_2),
        ),
    ];
    cells.extend(summary.bits_needed.iter().map(|needed| match needed.bits {
        Some(bits) => Cell::number(bits.to_string(), f64::from(bits)),
        None => Cell::number("-", None),
    }));
    cells
}

/// Correct digits over n and bits, coloured.
fn map(lines: &[&Line]) -> Table {
    let levels = lines.first().map_or(&[][..], |line| &line.row.levels);
    let heads = levels
        .iter()
        .map(|level| Column::number(format!("n = {}", level.n)));
    let first = Column::number("bits");
    let mut table = Table::new(
        "Correct decimal digits over significant bits and segments n",
        std::iter::once(first).chain(heads),
    );
    let digits = |line: &Line| -> Vec<Option<f64>> {
        line.row
            .levels
            .iter()
            .map(|level| line.digits(level))
            .collect()
    };
    let all = lines.iter().flat_map(|line| digits(line)).flatten();
    let most = all.fold(1.0, f64::max);
    for line in lines {
        let cells = digits(line).into_iter().map(|digits| match digits {
            Some(digits) => Cell::number(format!("{digits:.1}"), digits).shaded(digits / most),
            None => Cell::number("–", None),
        });
        let bits = Cell::number(line.bits.to_string(), f64::from(line.bits));
        table
            .rows
            .push(std::iter::once(bits).chain(cells).collect());
    }
    table
}
