//! A study of errors and their parts.

mod columns;
mod json;
mod levels;
mod overview;
mod paper;
mod parts;
mod whole;
pub(super) mod words;

pub use columns::parquet;
pub use json::{json, schema};
pub use parts::of_split;

use super::counts::counts;
use super::names::FileNames;
use super::unproved::not_proved;
use crate::convergence::Fit;
use crate::document::{
    About, Block, Cell, Column, Conclusion, Document, Fact, Figure, Finding, Medium, Section,
    Table, Tone,
};
use crate::render::{ReportError, make_directory, write_document, write_file};
use crate::study::sweep::{Errors, Line, Results, SplitSummary, TOLERANCES};
use std::f64::consts::LOG10_2;
use std::path::{Path, PathBuf};
use words::{
    LEGEND, NONE, best, crossing, exponent, judged, order, summary, theory, tone, warnings,
};

/// Cases that are named one by one.
const NAMES: usize = 100;

/// What verdicts are on.
const SAID: &str = "The verdicts above are on the order of the discretization error, a line a case, method and format.";

/// For every case and method its orders and roundoff, format by format, with what happened at some levels and the parts of the
/// error as plots; then maps of correct digits. All levels are a table for CSV, the orders one for LaTeX. Where errors are known as
/// a whole alone, what tells of their parts is left out. Of more than 200 cases times methods there is an overview
/// in place of sections and plots.
#[must_use]
pub fn document(results: &Results, about: &About) -> Document {
    let mut document = Document::new("study", "A study of errors", about.clone());
    let lines = || results.lines.iter().filter(|line| !line.swept);
    document.summary = counts(lines().map(|line| {
        let verdict = line.summary.order().verdict;
        (verdict.name().to_string(), judged(line))
    }));
    document
        .summary
        .push(Fact::new("lines", lines().count().to_string()));
    document.conclusion = Some(Conclusion::new(summary(results)));
    document.sections.push(run(results));
    document.sections.extend(unproved(results));
    if overview::pairs(results) > overview::PAIRS {
        document.sections.extend(overview::sections(results));
    } else {
        document.sections.extend(each(results));
    }
    if !results.lines.is_empty() {
        let legend = match results.header.errors {
            Errors::Split => LEGEND.iter(),
            Errors::Total => whole::LEGEND.iter(),
        };
        let legend = legend.map(|(word, meaning)| Fact::new(*word, *meaning));
        let legend = Block::Facts(legend.collect());
        document
            .sections
            .push(Section::of("words", "Words", [legend]).aside());
    }
    document
}

/// A section for every case and method, and maps of digits.
fn each(results: &Results) -> Vec<Section> {
    let mut sections = Vec::new();
    let mut names = FileNames::default();
    for (case, method, lines) in results.groups().filter(|(.., lines)| !lines.is_empty()) {
        sections.push(match results.header.errors {
            Errors::Split => parts(names.next("parts", &[case, method]), case, method, &lines),
            Errors::Total => errors(names.next("errors", &[case, method]), case, method, &lines),
        });
    }
    for (case, method, lines) in results.maps().filter(|(.., lines)| !lines.is_empty()) {
        let file = names.next("digits", &[case, method]);
        let title = format!("{case}, {method}: correct digits");
        let map = Block::Table(map(&lines, &title).named(&file)).only(Medium::Written);
        sections.push(Section::of(file, title, [map]));
    }
    sections
}

/// What the cases rest on and is not proved.
fn unproved(results: &Results) -> Option<Section> {
    let open = results.unproved.iter();
    let said: Vec<Block> = open.map(|(case, open)| not_proved(case, open)).collect();
    (!said.is_empty()).then(|| Section::of("not-proved", "Not proved", said))
}

/// Writes `study.csv`, `study.json`, `study.tex`, one figure a case and method, `study.md`, which shows them, and a page,
/// `index.html`, into `dir`; see [`write_document`]. Returns the paths written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(dir: &Path, results: &Results, about: &About) -> Result<Vec<PathBuf>, ReportError> {
    let table = dir.join("study.parquet");
    make_directory(dir)?;
    write_file(&table, parquet(results)?)?;
    let data = [("study.json".to_string(), json(results)?)];
    let mut files = write_document(dir, &document(results, about), "study", data)?;
    files.push(table);
    Ok(files)
}

fn run(results: &Results) -> Section {
    let header = &results.header;
    let names = header.cases.iter().map(|[name, ..]| name.as_str());
    let mut names: Vec<&str> = names.collect();
    let more = names.len().saturating_sub(NAMES);
    let more_names = format!("{more} more");
    if more > 0 {
        names.truncate(NAMES);
        names.push(&more_names);
    }
    let ladder: Vec<String> = header.levels.iter().map(ToString::to_string).collect();
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
        Fact::new("levels n", ladder.join(", ")),
    ];
    if let Some(bits) = &results.sweep_bits {
        let range = format!("{} … {}", bits.start(), bits.end());
        facts.push(Fact::new("swept bits", range));
    }
    let (said, levels, paper) = match header.errors {
        Errors::Split => (SAID, levels::table(results), paper::table(results)),
        Errors::Total => {
            facts.push(Fact::new("errors", header.errors.to_string()));
            (whole::SAID, whole::levels(results), whole::paper(results))
        }
    };
    let blocks = [
        Block::Text(said.into()).only(Medium::Written),
        Block::Facts(facts).only(Medium::Written),
        Block::Table(levels).only(Medium::Csv),
        Block::Table(paper).only(Medium::Latex),
    ];
    Section::of("run", "What was run", blocks)
}

fn parts(file: String, case: &str, method: &str, lines: &[&Line]) -> Section {
    let caption = format!("{case}, {method}: the parts of the error against n");
    let figure = Figure::new(&file, caption, of_split(lines));
    let blocks = [Block::Table(table(lines)), Block::Figure(figure)];
    section(file, case, method, lines, blocks)
}

fn errors(file: String, case: &str, method: &str, lines: &[&Line]) -> Section {
    let caption = format!("{case}, {method}: the error against n");
    let figure = Figure::new(&file, caption, whole::plots(lines));
    let blocks = [Block::Table(whole::table(lines)), Block::Figure(figure)];
    section(file, case, method, lines, blocks)
}

/// What a method did on a case, with remarks on the formats.
fn section(file: String, case: &str, method: &str, lines: &[&Line], blocks: [Block; 2]) -> Section {
    let expected = lines.first().map(|line| theory(line.row.expected));
    let title = format!("{case}, {method}: theory {}", expected.unwrap_or_default());
    let mut section = Section::of(file, title, blocks);
    for line in lines {
        let remark = |warning| Finding::new(&line.format, warning).toned(Tone::Open);
        let remarks = warnings(line).into_iter().map(remark).map(Block::Finding);
        section.blocks.extend(remarks);
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
    let bits = TOLERANCES.map(|t| Column::number(format!("bits for {t:e}")).detail());
    columns.extend(bits);
    let rows = lines
        .iter()
        .filter_map(|line| Some(row(line, line.summary.split.as_ref()?)));
    Table::new("Orders and roundoff, a row a format", columns).with(rows)
}

fn row(line: &Line, split: &SplitSummary) -> Vec<Cell> {
    let summary = &line.summary;
    let number = |fit: &Fit| Cell::number(order(fit), fit.order);
    let law = |law| Cell::number(exponent(law), law.map(|law| law.exponent));
    let total = summary.total.verdict;
    let least = split.best.map(|best| best.log2_error * LOG10_2);
    let mut cells = vec![
        Cell::text(&line.format),
        number(&split.discretization),
        Cell::verdict(split.discretization.verdict.name(), judged(line)),
        number(&summary.total),
        Cell::verdict(total.name(), tone(total)),
        law(split.laws.arithmetic),
        law(split.laws.input),
        Cell::number(crossing(line), split.crossing),
        Cell::number(best(line), least),
    ];
    cells.extend(split.bits_needed.iter().map(|needed| match needed.bits {
        Some(bits) => Cell::number(bits.to_string(), f64::from(bits)),
        None => Cell::text(NONE),
    }));
    cells
}

/// Correct digits over n and bits, coloured.
fn map(lines: &[&Line], title: &str) -> Table {
    let levels = lines.first().map_or(&[][..], |line| &line.row.levels);
    let heads = levels.iter().map(|level| format!("n = {}", level.n));
    let columns = std::iter::once("bits".to_string()).chain(heads);
    let digits = |line: &Line| -> Vec<Option<f64>> {
        let levels = line.row.levels.iter();
        levels.map(|level| line.digits(level)).collect()
    };
    let all = lines.iter().flat_map(|line| digits(line)).flatten();
    let most = all.fold(1.0, f64::max);
    let rows = lines.iter().map(|line| {
        let cells = digits(line).into_iter().map(|digits| match digits {
            Some(digits) => Cell::number(format!("{digits:.1}"), digits).shaded(digits / most),
            None => Cell::text("–"),
        });
        let bits = Cell::number(line.bits.to_string(), f64::from(line.bits));
        std::iter::once(bits).chain(cells).collect()
    });
    let caption = format!("{title}, over significant bits and segments n");
    Table::new(caption, columns.map(Column::number)).with(rows)
}
