//! What a kernel computes, how that deviates, what it does to errors, and a ray that shows it.

use super::empty::NONE;
use crate::convergence::Verdict;
use crate::document::{Block, Finding, Medium, Tone};
use crate::identify::Deviation;
use crate::kernel::Quantity;
use crate::report::identify::words::{kinds, number, of_method, sentence};
use crate::study::verify::{
    Acceptance, Accepted, Conclusion, Identified, Line, Measured, Standing, Verification,
};

/// Reasons why there is no rule that are told.
const REASONS: usize = 3;

/// The rule, and where it was seen to hold; or that there is none.
pub(super) fn rule(verification: &Verification) -> Vec<Block> {
    let Some(identified) = &verification.identification else {
        return Vec::new();
    };
    let found = &identified.examined.found;
    let mut blocks = Vec::new();
    if let Some(rule) = identified.named() {
        blocks.push(Block::Lines(rule.to_string()));
        blocks.push(Block::Text(validated(identified)));
    } else if let Some(scattered) = &found.scattered {
        blocks.push(Block::Lines(scattered.to_string()));
    } else if let Some(method) = &found.method {
        blocks.push(Block::Text(of_method(method)));
        blocks.push(Block::Text(kinds(&identified.examined)));
    } else {
        blocks.push(Block::Finding(no_rule(verification).toned(Tone::Open)));
        let reasons = found.not_identified.iter().take(REASONS);
        blocks.extend(reasons.map(|open| {
            Block::Finding(Finding::new("not identified", &open.reason).toned(Tone::Open))
        }));
    }
    blocks.extend(differs(identified).map(|finding| Block::Finding(finding.toned(Tone::Bad))));
    blocks
}

fn no_rule(verification: &Verification) -> Finding {
    let is_confirmed = verification.conclusion() == Conclusion::Confirmed;
    Finding::new(
        "",
        if is_confirmed {
            "order confirmed, rule not identified"
        } else {
            "rule not identified"
        },
    )
}

/// In which kinds of rays, and in how many channels of the ladder.
fn validated(identified: &Identified) -> String {
    let kinds = kinds(&identified.examined);
    if identified.compared == 0 {
        return kinds;
    }
    let (agrees, of) = (identified.agrees(), identified.compared);
    format!("{kinds} On the ladder it agrees in {agrees} of {of} channels.")
}

/// Channels that the rule does not have.
fn differs(identified: &Identified) -> impl Iterator<Item = Finding> {
    let named = (!identified.differs.is_empty()).then(|| {
        Finding::new(
            "answers are not those of the rule in",
            identified.differs.join(", "),
        )
    });
    named.into_iter()
}

/// What deviates, what is accepted of it, and what it does to errors.
pub(super) fn deviations(verification: &Verification) -> Vec<Block> {
    let Some(identified) = &verification.identification else {
        return Vec::new();
    };
    let accepted = &verification.settings.accept;
    let mut blocks: Vec<Block> = said(identified, accepted).map(Block::Finding).collect();
    if !blocks.is_empty() {
        // What a rule does to opacities stands beside these.
        let lines: Vec<&Line> = verification.of(Quantity::Radiance).collect();
        blocks.push(Block::Text(effect(&lines)));
    }
    let all = &identified.examined.deviations;
    let gone = accepted
        .iter()
        .filter(|one| all.iter().all(|deviation| deviation.name != one.name));
    blocks.extend(gone.map(|one| {
        Block::Finding(Finding::new(
            "accepted, and not there any more",
            one.to_string(),
        ))
    }));
    blocks
}

fn said<'a>(
    identified: &'a Identified,
    accepted: &'a [Accepted],
) -> impl Iterator<Item = Finding> + 'a {
    let said = |(deviation, how): (&Deviation, Acceptance)| {
        let words = sentence(deviation);
        match how {
            Acceptance::Unknown => Finding::new(deviation.name, words).toned(Tone::Bad),
            Acceptance::Accepted => {
                Finding::new(deviation.name, format!("{words}; this is accepted")).toned(Tone::Open)
            }
            Acceptance::Moved { from } => {
                let from = number(from);
                Finding::new(deviation.name, format!("{words}; {from} was accepted"))
                    .toned(Tone::Bad)
            }
        }
    };
    identified.deviations(accepted).map(said)
}

/// All that is said of a kernel, as findings: for programs that show nothing else.
#[cfg(feature = "studies")]
pub(super) fn findings(verification: &Verification) -> Vec<Finding> {
    let Some(identified) = &verification.identification else {
        return Vec::new();
    };
    let method = identified.examined.found.method.as_ref();
    let mut all = match (identified.named(), method) {
        (None, Some(method)) => vec![Finding::new("the method is", method.name())],
        (Some(rule), _) => vec![Finding::new(
            "the rule is",
            rule.to_string().replace('\n', "; "),
        )],
        (None, None) => vec![no_rule(verification)],
    };
    all.extend(differs(identified));
    all.extend(said(identified, &verification.settings.accept));
    let witness = identified.examined.witness.as_ref();
    all.extend(witness.map(|witness| Finding::new("witness", witness.to_string())));
    all
}

/// The smallest ray that shows it.
pub(super) fn witness(verification: &Verification) -> Vec<Block> {
    let identified = verification.identification.as_ref();
    let witness = identified.and_then(|identified| identified.examined.witness.as_ref());
    let Some(witness) = witness else {
        return Vec::new();
    };
    let mut blocks = vec![Block::Text(witness.to_string())];
    if let Ok(task) = witness.ray.to_json() {
        blocks.push(Block::Lines(task).only(Medium::Written));
    }
    blocks
}

/// What the orders say of it: one sentence.
fn effect(lines: &[&Line]) -> String {
    let of = |verdict: Verdict| -> Vec<&Line> {
        let contradicted = lines
            .iter()
            .copied()
            .filter(|line| line.standing == Standing::Contradicted);
        contradicted
            .filter(|line| line.measured.verdict() == verdict)
            .collect()
    };
    let mut words = Vec::new();
    let stalled = of(Verdict::Stalled);
    if let Some(first) = stalled.first() {
        let (count, name) = (stalled.len(), &first.name);
        let at = left(first).map_or(String::new(), |left| {
            format!(" (in {name} at {left:.0e} of the radiance)")
        });
        words.push(format!("stop falling in {count}{at}"));
    }
    let lower = of(Verdict::TooLow);
    if let Some(first) = lower.first() {
        let order = first.measured.order();
        let order = order.map_or(NONE.into(), |(order, _)| format!("{order:.2}"));
        let (count, name) = (lower.len(), &first.name);
        words.push(format!(
            "fall with a lower order in {count} (in {name} with {order})"
        ));
    }
    let grow = of(Verdict::Diverged).len();
    if grow > 0 {
        words.push(format!("grow in {grow}"));
    }
    let contradicted = lines
        .iter()
        .filter(|line| line.standing == Standing::Contradicted)
        .count();
    let others = contradicted - stalled.len() - lower.len() - grow;
    if others > 0 {
        words.push(format!("show no order in {others}"));
    }
    if words.is_empty() {
        return "No channel that was run contradicts the order.".into();
    }
    format!(
        "Of {} channels errors {}.",
        lines.len(),
        words.join(", and ")
    )
}

/// The error at the finest level, as a part of the radiance, where there is any.
fn left(line: &Line) -> Option<f64> {
    let Measured::Fitted { samples, .. } = &line.measured else {
        return None;
    };
    let error = samples.last()?.error.to_f64().abs();
    let left = error / line.exact.to_f64().abs();
    Some(left).filter(|left| left.is_finite())
}
