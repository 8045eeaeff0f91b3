//! What a kernel computes, in what it deviates, and a ray that shows it.

#[cfg(feature = "studies")]
mod json;
#[cfg(feature = "studies")]
mod plots;
#[cfg(feature = "studies")]
mod stated;
pub(super) mod words;

#[cfg(feature = "studies")]
pub(super) use json::{Cost, Found, cost, found};
#[cfg(feature = "studies")]
pub use json::{json, schema};
#[cfg(feature = "studies")]
pub use stated::Stated;

#[cfg(feature = "studies")]
use crate::document::Figure;
use crate::document::{
    About, Block, Cell, Column, Conclusion, Document, Fact, Finding, Medium, Section, Table, Tone,
};
use crate::identify::rule::Rule;
use crate::identify::{Against, Deviation, Examined, NotIdentified, Verdict};
#[cfg(feature = "studies")]
use crate::render::{ReportError, write_document};
#[cfg(feature = "studies")]
use std::path::{Path, PathBuf};
use words::{conclusion, kinds, means, sentence, spent};

/// Rows of a measured table that a terminal shows.
const SHOWN: usize = 12;

/// The second kernel, and how both compare.
#[derive(Debug)]
pub struct Other {
    /// Its name.
    pub name: String,
    /// What was found out about it.
    pub examined: Examined,
    /// The comparison.
    pub against: Against,
}

/// The verdict, the rule, where it was validated, in what it deviates, what could not be identified, a witness and what it
/// cost; then how the kernel compares with `other`.
#[must_use]
pub fn document(examined: &Examined, other: Option<&Other>, about: &About) -> Document {
    let name = &examined.declaration.name;
    let mut document = Document::new("identify", name, about.clone());
    let verdict = examined.verdict();
    let tone = tone(verdict);
    document.summary = vec![
        Fact::new("the rule is", words::word(verdict)).toned(tone),
        Fact::new("deviations", examined.deviations.len().to_string()),
        Fact::new("rays", examined.found.spent.rays.to_string()),
    ];
    document.conclusion = Some(Conclusion::new(conclusion(examined)).toned(tone));
    document.sections = [
        Section::of("rule", "What it computes", rule(examined)),
        Section::of("validated", "Where that was validated", validated(examined)),
        Section::of("deviations", "How it deviates", deviating(examined)),
        Section::of(
            "not-identified",
            "What could not be identified",
            examined.found.not_identified.iter().flat_map(open),
        ),
        Section::of(
            "witness",
            "The smallest ray that shows it",
            witness(examined),
        ),
        Section::of(
            "against",
            "Against the other kernel",
            other.into_iter().flat_map(compared),
        ),
        #[cfg(feature = "studies")]
        Section::of(
            "pictures",
            "Weights and opacities",
            examined.found.named().into_iter().flat_map(pictures),
        ),
        Section::of("cost", "What it cost", [Block::Facts(spent(examined))]),
    ]
    .into();
    document
}

/// Writes `identify.md`, `identify.json`, figures and a page, `index.html`, into `dir`; see [`write_document`]. Returns
/// the paths written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
#[cfg(feature = "studies")]
pub fn write(
    dir: &Path,
    examined: &Examined,
    other: Option<&Other>,
    about: &About,
) -> Result<Vec<PathBuf>, ReportError> {
    let data = [("identify.json".to_string(), json(examined, other)?)];
    write_document(dir, &document(examined, other, about), "identify", data)
}

fn rule(examined: &Examined) -> Vec<Block> {
    let found = &examined.found;
    let mut blocks = match (found.named(), &found.rule, &found.scattered) {
        (Some(rule), ..) => {
            let mut blocks = formula(rule);
            let rounding = words::rounding(found);
            blocks.extend((!rounding.is_empty()).then_some(Block::Text(rounding)));
            blocks
        }
        (None, Some(rule), _) => vec![
            Block::Text(
                "This rule was read off, and does not hold on all rays: it is not named.".into(),
            ),
            Block::Lines(rule.to_string()),
        ],
        (None, None, Some(scattered)) => vec![Block::Lines(scattered.to_string())],
        (None, None, None) => Vec::new(),
    };
    blocks.extend(
        found
            .method
            .iter()
            .map(|method| Block::Text(words::of_method(method))),
    );
    if let Some(optics) = &found.optics {
        blocks.push(Block::Text(format!("Of a volume it reads: {optics}.")));
    }
    blocks
}

/// The rule as text, and where it is written, in LaTeX.
fn formula(rule: &Rule) -> Vec<Block> {
    let heading = Block::Text("In LaTeX:".into());
    vec![
        Block::Lines(rule.to_string()),
        heading.only(Medium::Written),
        Block::Lines(rule.latex()).only(Medium::Written),
    ]
}

fn validated(examined: &Examined) -> Vec<Block> {
    if let Some(scattered) = &examined.found.scattered {
        return vec![Block::Text(means(scattered))];
    }
    let kinds_of = &examined.found.hold_out.kinds;
    if kinds_of.is_empty() {
        return Vec::new();
    }
    let columns = [
        Column::text("rays"),
        Column::number("asked"),
        Column::number("agree"),
        Column::number("digits"),
    ];
    let row = |kind: &crate::identify::Kind| {
        let (mark, tone) = if kind.holds() {
            (kind.agree, Tone::Good)
        } else {
            (kind.agree, Tone::Bad)
        };
        vec![
            Cell::text(&kind.name),
            Cell::number(kind.rays.to_string(), kind.rays as f64),
            Cell::number(mark.to_string(), mark as f64).toned(tone),
            Cell::number(format!("{:.1}", kind.digits), kind.digits),
        ]
    };
    let table = Table::new("The rule against rays that it was not found with", columns);
    let table = table.with(kinds_of.iter().map(row));
    vec![
        Block::Text(kinds(examined)).only(Medium::Terminal),
        Block::Table(table).only(Medium::Written),
    ]
}

fn deviating(examined: &Examined) -> Vec<Block> {
    let finding = |deviation: &Deviation| {
        Block::Finding(Finding::new(deviation.name, sentence(deviation)).toned(Tone::Bad))
    };
    examined.deviations.iter().map(finding).collect()
}

/// A reason, and what was measured.
fn open(reason: &NotIdentified) -> Vec<Block> {
    let said = Finding::new("not identified", &reason.reason).toned(Tone::Open);
    let mut blocks = vec![Block::Finding(said)];
    if !reason.rows.is_empty() {
        let columns = reason.columns.iter().map(Column::number);
        let row = |row: &Vec<f64>| {
            let cells = row.iter().map(|x| Cell::number(words::number(*x), *x));
            cells.collect()
        };
        let table = Table::new("What was measured", columns).with(reason.rows.iter().map(row));
        blocks.push(Block::Table(table.at_most(SHOWN)));
    }
    blocks
}

fn witness(examined: &Examined) -> Vec<Block> {
    let mut blocks = Vec::new();
    if let Some(shown) = &examined.opacity {
        blocks.push(Block::Lines(format!("opacity: {shown}")));
    }
    let Some(witness) = &examined.witness else {
        return blocks;
    };
    blocks.insert(0, Block::Lines(witness.to_string()));
    let is_declared = examined.declaration.method.is_some();
    if examined.found.named().is_none() && !is_declared {
        let against = "No rule is named: this is beside one sample a segment, in the place nearest to the answer.";
        blocks.push(Block::Text(against.into()));
    }
    if let Ok(task) = witness.ray.to_json() {
        blocks.push(Block::Lines(task).only(Medium::Written));
    }
    blocks
}

fn compared(other: &Other) -> Vec<Block> {
    let against = &other.against;
    let mut facts = vec![
        Fact::new("other", &other.name),
        Fact::new("rays", against.rays.to_string()),
        Fact::new("the same bits on", against.same.to_string()),
        Fact::new("different on", against.differ.to_string()).toned(if against.differ > 0 {
            Tone::Bad
        } else {
            Tone::Good
        }),
    ];
    if against.unanswered > 0 {
        facts.push(Fact::new("unanswered", against.unanswered.to_string()));
    }
    let mut blocks = vec![Block::Facts(facts)];
    for difference in &against.differences {
        let said = |words: &Option<String>| words.clone().unwrap_or_else(|| "plain".into());
        let words = format!(
            "{}; the other: {}",
            said(&difference.one),
            said(&difference.other)
        );
        blocks.push(Block::Finding(
            Finding::new(difference.part, words).toned(Tone::Bad),
        ));
    }
    if let Some(witness) = &against.witness {
        let words = witness.to_string();
        blocks.push(Block::Lines(
            words.replace("where the rule gives", "where the other gives"),
        ));
    }
    blocks
}

/// What values weigh, and opacities beside the true ones.
#[cfg(feature = "studies")]
pub(super) fn pictures(rule: &Rule) -> Vec<Block> {
    let mut blocks = vec![Block::Figure(Figure::new(
        "weights",
        "What values along an even ray weigh, and how much of their light reaches the eye",
        plots::along(rule),
    ))];
    let opacities = plots::opacities(rule);
    if !opacities.is_empty() {
        let caption = "Opacity of a segment, and its deviation from 1 − e^(−τd)";
        blocks.push(Block::Figure(Figure::new("opacity", caption, opacities)));
    }
    blocks
        .into_iter()
        .map(|block| block.only(Medium::Written))
        .collect()
}

fn tone(verdict: Verdict) -> Tone {
    match verdict {
        Verdict::Right => Tone::Good,
        Verdict::Deviates | Verdict::NoAnswer => Tone::Bad,
        Verdict::NotIdentified => Tone::Open,
    }
}
