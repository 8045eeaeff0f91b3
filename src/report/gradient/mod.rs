//! Gradients of a kernel: beside theory.

mod bias;
mod json;
mod own;
mod words;

pub use json::json;

use crate::document::{
    self, About, Block, Cell, Column, Document, Fact, Finding, Section, Table, Tone,
};
use crate::identify::{GradientFound, NotIdentified};
use crate::render::{ReportError, write_document};
use crate::study::gradient::{Conclusion, Gradients, Line, OfCase, Standing};
use std::path::{Path, PathBuf};
use words::{by, expected, left_out, order, places, trouble, verdict};

/// What came of the comparison with the kernel's own values, or why there is none.
pub type Own = Result<GradientFound, NotIdentified>;

/// Whether derivatives are not those of the kernel's own values.
#[must_use]
pub fn is_other(own: &Own) -> bool {
    own.as_ref().is_ok_and(|found| !found.is_right())
}

/// Failures of a case that are shown.
const FAILURES: usize = 2;

/// A table of cases, derivatives and norms, the comparison with the kernel's own values, what is wrong whatever the order is,
/// and what was left out.
#[must_use]
pub fn document(gradients: &Gradients, own: &Own, about: &About) -> Document {
    let name = &gradients.declaration.name;
    let mut document = Document::new("gradient", name, about.clone());
    let is_other = is_other(own);
    let tone = match gradients.conclusion() {
        Conclusion::Confirmed if !is_other => Tone::Good,
        _ => Tone::Bad,
    };
    document.summary =
        vec![Fact::new("the gradient is", gradients.conclusion().name()).toned(tone)];
    document.summary.extend(counts(gradients));
    document.conclusion = Some(document::Conclusion::new(words::whole(gradients, own)).toned(tone));
    document.sections = vec![
        Section::of(
            "theory",
            "Beside theory",
            [Block::Table(beside_theory(gradients))],
        ),
        Section::of("own", "Beside the kernel's own values", own::blocks(own)),
        Section::of("findings", "What is wrong", findings(gradients)),
        Section::of("run", "What was run", [run(gradients)]),
        Section::of("words", "Words", [Block::Text(words::meaning())]).aside(),
    ];
    document
}

/// Writes `gradient.md`, `gradient.json` and a page, `index.html`, into `dir`; see [`write_document`]. Returns the paths
/// written.
///
/// # Errors
/// [`ReportError::Directory`] or [`ReportError::File`] with the path and the system's reason.
pub fn write(
    dir: &Path,
    gradients: &Gradients,
    own: &Own,
    about: &About,
) -> Result<Vec<PathBuf>, ReportError> {
    let data = [("gradient.json".to_string(), json(gradients, own)?)];
    write_document(dir, &document(gradients, own, about), "gradient", data)
}

fn counts(gradients: &Gradients) -> Vec<Fact> {
    let all = [
        (Standing::Confirmed, Tone::Good),
        (Standing::Contradicted, Tone::Bad),
        (Standing::Inconclusive, Tone::Open),
        (Standing::Failed, Tone::Bad),
    ];
    let counted = all.map(|(standing, tone)| (standing, gradients.count(standing), tone));
    let shown = counted.into_iter().filter(|(_, count, _)| *count > 0);
    shown
        .map(|(standing, count, tone)| Fact::new(standing.name(), count.to_string()).toned(tone))
        .collect()
}

/// Means over seeds where there are seeds, orders where not.
fn beside_theory(gradients: &Gradients) -> Table {
    if gradients.declaration.stochastic {
        bias::table(gradients)
    } else {
        table(gradients)
    }
}

fn table(gradients: &Gradients) -> Table {
    let columns = [
        Column::text("case").grouping(),
        Column::text("derivative, error"),
        Column::number("expected"),
        Column::number("order"),
        Column::logarithm("finest error"),
        Column::verdict("verdict"),
    ];
    let cases = gradients.cases.iter();
    let rows = cases.flat_map(|case| case.lines.iter().map(move |line| row(case, line)));
    let caption = "Orders of the derivatives by τ and C; errors are parts of the largest Σ |a C| and of the largest τ T";
    Table::new(caption, columns).with(rows)
}

fn row(case: &OfCase, line: &Line) -> Vec<Cell> {
    let finest = line.finest();
    let shown = finest.map_or("-".into(), |error| format!("{error:.1e}"));
    let tone = match line.standing {
        Standing::Confirmed => Tone::Good,
        Standing::Contradicted | Standing::Failed => Tone::Bad,
        Standing::Inconclusive => Tone::Open,
    };
    vec![
        Cell::text(&case.name),
        Cell::text(by(line)),
        Cell::text(expected(line)),
        Cell::number(order(line), line.order().map(|(order, _)| order)),
        Cell::number(shown, finest.map(f64::log10)),
        Cell::verdict(verdict(case, line), tone),
    ]
}

/// What is wrong whatever the order is, and levels that were not answered.
fn findings(gradients: &Gradients) -> Vec<Block> {
    let mut blocks = Vec::new();
    for case in &gradients.cases {
        for one in &case.troubles {
            let words = format!("{}: {}", case.name, trouble(*one, gradients));
            blocks.push(Block::Finding(Finding::new("", words).toned(Tone::Bad)));
        }
        for failure in case.failures.iter().take(FAILURES) {
            let words = format!("{}, n = {}: {}", case.name, failure.segments, failure.error);
            blocks.push(Block::Finding(
                Finding::new("failed", words).toned(Tone::Bad),
            ));
        }
    }
    blocks
}

fn run(gradients: &Gradients) -> Block {
    let ladder: Vec<String> = gradients
        .settings
        .ladder
        .iter()
        .map(u64::to_string)
        .collect();
    let mut facts = vec![
        Fact::new("samples", places(gradients)),
        Fact::new("segments", ladder.join(", ")),
    ];
    if gradients.declaration.stochastic {
        facts.extend(bias::facts(gradients));
    }
    let all = gradients.cases.iter().filter_map(left_out);
    facts.extend(all.map(|said| Fact::new("left out", said)));
    for case in &gradients.cases {
        if let Some(error) = case.integrated {
            let said = format!("{}: by quadrature, to {error:.0e} (an estimate)", case.name);
            facts.push(Fact::new("theory", said));
        }
        let unproved = case.unproved.iter();
        facts.extend(unproved.map(|one| {
            Fact::new(
                "not proved",
                format!("{}: {} ({})", case.name, one.claim, one.reason),
            )
        }));
    }
    Block::Facts(facts)
}
