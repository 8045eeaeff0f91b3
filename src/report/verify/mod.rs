//! A kernel put to the test: rows as they come, what they say in all, JSON, `JUnit` XML.

mod answers;
mod empty;
mod identified;
#[cfg(feature = "studies")]
mod json;
#[cfg(feature = "studies")]
mod junit;
mod rows;
mod scattered;
mod together;
mod words;

#[cfg(feature = "studies")]
pub use json::{json, schema};
#[cfg(feature = "studies")]
pub use junit::junit;
pub use rows::{heading, row, scattered_heading};

#[cfg(feature = "studies")]
use super::plots;
use super::unproved::not_proved;
use crate::case::Unproved;
use crate::document::{
    self, About, Block, Cell, Column, Document, Fact, Finding, Medium, Section, Table, Tone,
};
use crate::kernel::{Declaration, Quantum, Source, UlpBound};
use crate::method::Expected;
#[cfg(feature = "studies")]
use crate::render::{ReportError, write_document};
#[cfg(feature = "studies")]
use crate::study::verify::Identified;
use crate::study::verify::{Conclusion, Line, Measured, Remark, Standing, Verification};
#[cfg(feature = "studies")]
use std::path::{Path, PathBuf};
use words::{
    BLIND, SIGNS, axis, beyond, conclusion, failure, failures, findings, floor, largest,
    not_declared, order, theory, unresolved, window,
};

/// Channels that a terminal names of one finding.
const NAMED: usize = 6;

/// What the values say, and in writing every channel, with its plot, and what was run: a terminal has shown the channels by
/// [`row`].
#[must_use]
pub fn document(verification: &Verification, about: &About) -> Document {
    let name = &verification.declaration.name;
    let mut document = Document::new("verify", name, about.clone());
    let (word, tone) = match verification.conclusion() {
        Conclusion::Confirmed => ("confirmed", Tone::Good),
        Conclusion::NotConfirmed => ("not confirmed", Tone::Bad),
        Conclusion::CouldNotRun => ("could not run", Tone::Bad),
    };
    document.summary = vec![Fact::new("the kernel is", word).toned(tone)];
    document.summary.extend(counts(verification));
    let said = document::Conclusion::new(conclusion(verification));
    document.conclusion = Some(said.toned(tone));
    let lines = &verification.lines;
    document.sections = [
        Section::of("rule", "What it computes", identified::rule(verification)),
        Section::of(
            "deviations",
            "How it deviates",
            identified::deviations(verification),
        ),
        Section::of(
            "together",
            "Many rays in one request",
            together::said(verification).map(Block::Finding),
        ),
        Section::of(
            "witness",
            "The smallest ray that shows it",
            identified::witness(verification),
        ),
        Section::of(
            "answers",
            "What else it answers",
            answers::others(verification),
        ),
        Section::of(
            "findings",
            "What the values say",
            said_by_values(verification),
        ),
        Section::of("channels", "Channels", channels(lines)),
        // A terminal shows no plots.
        #[cfg(feature = "studies")]
        Section::of(
            "plots",
            "Errors against segments",
            lines.iter().filter_map(plot),
        ),
        #[cfg(feature = "studies")]
        Section::of("pictures", "Weights and opacities", pictures(verification)),
        Section::of(
            "run",
            "What was run",
            [run(verification).only(Medium::Written)],
        ),
        legend(verification),
    ]
    .into();
    document
}

/// Writes `verify.md`, `verify.json`, `verify.xml` (`JUnit`), one plot a channel (`sine-squared.svg`, `rgb-transfer-red.svg` …)
/// and a page, `index.html`, into `dir`; see [`write_document`]. Returns the paths written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
#[cfg(feature = "studies")]
pub fn write(
    dir: &Path,
    verification: &Verification,
    about: &About,
) -> Result<Vec<PathBuf>, ReportError> {
    let data = [
        ("verify.json".to_string(), json(verification)?),
        ("verify.xml".to_string(), junit(verification)),
    ];
    write_document(dir, &document(verification, about), "verify", data)
}

fn counts(verification: &Verification) -> Vec<Fact> {
    let counts = verification.counts();
    let all = [
        ("confirmed", counts.confirmed, Tone::Good),
        ("contradicted", counts.contradicted, Tone::Bad),
        ("inconclusive", counts.inconclusive, Tone::Open),
        ("not resolved", counts.unresolved, Tone::Open),
        ("blind", counts.blind, Tone::Open),
        ("failed", counts.failed, Tone::Bad),
    ];
    let shown = all
        .into_iter()
        .filter(|(name, count, _)| *count > 0 || *name == "contradicted");
    let fact = |(name, count, tone): (&str, usize, Tone)| Fact {
        tone: (count > 0 || tone != Tone::Bad).then_some(tone),
        ..Fact::new(name, count.to_string())
    };
    let of = Fact::new(
        answers::word(verification),
        verification.lines.len().to_string(),
    );
    shown.map(fact).chain([of]).collect()
}

/// Whether the values are the declared ones, and what else was found; where that is in many channels a terminal has their
/// number.
fn said_by_values(verification: &Verification) -> Vec<Block> {
    let said = not_declared(verification).into_iter().map(Block::Finding);
    let found = [(NAMED, Medium::Terminal), (usize::MAX, Medium::Written)].map(|(most, medium)| {
        let found = findings(verification, most).into_iter();
        let found = found.chain(beyond(verification, most));
        found.map(move |found| Block::Finding(found).only(medium))
    });
    said.chain(found.into_iter().flatten())
        .chain(visible(&verification.lines))
        .chain(unresolved(verification).into_iter().map(Block::Finding))
        .chain(unproved(verification))
        .collect()
}

/// What is visibly wrong, whatever orders are.
fn visible(lines: &[Line]) -> impl Iterator<Item = Block> {
    lines.iter().flat_map(|line| {
        let said = |remark: &Remark| {
            let words = remark.of(line.quantity);
            Finding::new("visible", format!("{} {words}", line.name))
        };
        let said = line.remarks.iter().map(said);
        said.map(|finding| Block::Finding(finding.toned(Tone::Bad)))
    })
}

/// What channels rest on and is not proved.
fn unproved(verification: &Verification) -> impl Iterator<Item = Block> {
    let first = verification.quantities().first().copied();
    verification.lines.iter().flat_map(move |line| {
        // What a case rests on is said once, of the first that is answered; what is an estimate, of each.
        let is_own = move |open: &&Unproved| Some(line.quantity) == first || open.is_of_value();
        let open = line.unproved.iter().filter(is_own);
        open.map(|open| not_proved(&line.name, open))
    })
}

fn channels(lines: &[Line]) -> Vec<Block> {
    let columns = [
        Column::text("case"),
        Column::number("order"),
        Column::number("measured"),
        Column::number("window"),
        Column::number("floor"),
        Column::number("largest"),
        Column::text("verdict"),
        Column::verdict("says"),
    ];
    let table = Table::new("Order and verdict, a row a channel", columns);
    let mut blocks = vec![Block::Table(table.with(lines.iter().map(written)))];
    let failed = lines.iter().filter(|line| !line.is_complete());
    let failed = failed.flat_map(|line| {
        let fact = |group| Fact::new(&line.name, failure(group)).toned(Tone::Bad);
        failures(line).iter().map(fact).collect::<Vec<Fact>>()
    });
    let failed: Vec<Fact> = failed.collect();
    if !failed.is_empty() {
        blocks.push(Block::Facts(failed));
    }
    blocks
        .into_iter()
        .map(|block| block.only(Medium::Written))
        .collect()
}

/// A channel where there is room.
fn written(line: &Line) -> Vec<Cell> {
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
        Cell::number(largest(line), line.largest_error()),
        Cell::text(line.measured.verdict().name()),
        Cell::verdict(line.standing.name(), tone(line.standing)),
    ]
}

/// The convergence of one channel, where there is any error that logarithmic axes can show.
#[cfg(feature = "studies")]
fn plot(line: &Line) -> Option<Block> {
    let Measured::Fitted { fit, samples } = &line.measured else {
        return None;
    };
    let mut errors = samples.iter().map(|sample| &sample.error);
    errors.find(|error| error.is_finite() && !error.is_zero())?;
    let plot = plots::of_convergence(samples, fit, &line.name);
    let file = line.name.replace(['/', ':'], "-");
    let figure = document::Figure::new(file, &line.name, [plot]);
    Some(Block::Figure(figure))
}

/// What values weigh by the rule, and its opacities.
#[cfg(feature = "studies")]
fn pictures(verification: &Verification) -> Vec<Block> {
    let identified = verification.identification.as_ref();
    let rule = identified.and_then(Identified::named);
    rule.map(super::identify::pictures).unwrap_or_default()
}

fn run(verification: &Verification) -> Block {
    let declaration = &verification.declaration;
    let declared = declaration.method.map_or("none".into(), |m| m.name());
    let claimed = declaration.order.map_or("none".into(), |o| o.to_string());
    let answers: Vec<String> = declaration
        .answers
        .iter()
        .map(ToString::to_string)
        .collect();
    let behind = if declaration.background {
        "the case's own, else 0.5 behind the first channel, 0.25 more behind each further one"
    } else {
        "none"
    };
    let mut facts = vec![
        Fact::new("levels", axis(verification)),
        Fact::new("declared method", declared),
        Fact::new("declared order", claimed),
        Fact::new("format", declaration.format.to_string()),
        Fact::new("given", declaration.form.to_string()),
        Fact::new("answers", answers.join(", ")),
        Fact::new("background", behind),
    ];
    facts.extend(arithmetic(declaration));
    Block::Facts(facts)
}

/// What is declared of arithmetic and of rays taken, where anything is.
fn arithmetic(declaration: &Declaration) -> impl Iterator<Item = Fact> {
    let quantum = declaration.quantum.map(|quantum| match quantum {
        Quantum::Absolute(quantum) => quantum.to_string(),
        Quantum::Relative(part) => format!("{part} of the ray's largest emission"),
    });
    let text = |bound: Option<UlpBound>| bound.map(|bound| bound.to_string());
    let output = declaration.output.map(|output| output.to_string());
    let lost = declaration.subnormals_lost.then(|| "lost".to_string());
    let noise = declaration.noise.map(|noise| noise.to_string());
    let channels = declaration.channels.map(|channels| channels.to_string());
    let positive = declaration.positive_emission;
    let per_length = declaration.source == Source::Length;
    let all = [
        ("stored as", output),
        ("quantum", quantum),
        ("units that exp is off", text(declaration.exp_ulp)),
        ("units that expm1 is off", text(declaration.expm1_ulp)),
        ("units that pow is off", text(declaration.pow_ulp)),
        ("subnormal numbers", lost),
        ("noise", noise),
        ("channels of a ray", channels),
        ("emission", positive.then(|| "not negative".into())),
        ("source", per_length.then(|| "per length".into())),
    ];
    let said = all
        .into_iter()
        .filter_map(|(name, value)| Some((name, value?)));
    said.map(|(name, value)| Fact::new(name, value))
}

/// The signs in front of rows.
fn legend(verification: &Verification) -> Section {
    let blind = (verification.counts().blind > 0).then_some(BLIND);
    let letters = (verification.declaration.stochastic).then_some(scattered::LETTERS);
    let lines = std::iter::once(SIGNS).chain(letters).chain(blind);
    let lines = lines.map(|line| Block::Text(line.into()).only(Medium::Terminal));
    Section::of("signs", "Signs", lines).aside()
}

/// Whether what it computes speaks against the kernel.
#[cfg(feature = "studies")]
fn deviates(verification: &Verification) -> bool {
    let contradicts = verification.contradicts_declaration() && !verification.is_explained();
    contradicts || verification.deviates()
}

/// How good or bad a standing is.
fn tone(standing: Standing) -> Tone {
    match standing {
        Standing::Confirmed => Tone::Good,
        Standing::Contradicted | Standing::Failed => Tone::Bad,
        Standing::Inconclusive | Standing::Unresolved | Standing::Blind => Tone::Open,
    }
}
