//! Samples at the seams of blocks, as conditions.

use super::{Range, Statement, set, when};
use crate::identify::rule::{At, Blocks, Effect, Rule, Seam, Which};

/// The size of blocks, where it follows from n.
pub(super) fn sized(seam: &Seam) -> Vec<Statement> {
    let m = seam.blocks.count();
    let size = match seam.blocks {
        Blocks::Segments(_) | Blocks::Even(_) => return Vec::new(),
        Blocks::Floor(_) | Blocks::Rest(_) => format!("(n - n % {m}) / {m}"),
        Blocks::Ceiling(_) => {
            let up = format!("n + {}", m - 1);
            format!("({up} - ({up}) % {m}) / {m}")
        }
    };
    vec![set("size", size), when("size < 1", vec![set("size", "1")])]
}

/// Whether a block begins at that segment.
fn begins(blocks: Blocks, at: &str) -> String {
    let m = blocks.count();
    match blocks {
        Blocks::Segments(_) => format!("{at} % {m} == 0"),
        Blocks::Floor(_) | Blocks::Ceiling(_) => format!("{at} % size == 0"),
        Blocks::Rest(_) => format!("{at} % size == 0 and {at} < {m} * size"),
        Blocks::Even(_) => format!("({at} * {m} + {}) % n < {m}", m - 1),
    }
}

/// In parentheses, where it is no single comparison.
fn inner(condition: &str) -> String {
    if condition.contains(" and ") || condition.contains(" or ") {
        format!("({condition})")
    } else {
        condition.into()
    }
}

/// Whether sample i lies at a seam.
fn is_at(seam: &Seam) -> String {
    let first = || begins(seam.blocks, "i");
    let last = || begins(seam.blocks, "(i + 1)");
    let has_all = matches!(seam.blocks, Blocks::Rest(_) | Blocks::Even(_));
    match (seam.at, seam.of) {
        (At::First, Which::Inner) => format!("i > 0 and {}", first()),
        (At::First, _) => first(),
        (At::Last, Which::Inner) => format!("i < n - 1 and {}", last()),
        (At::Last, Which::Whole) if !has_all => last(),
        (At::Last, _) => format!("i == n - 1 or {}", inner(&last())),
        (At::Index(before), _) => format!("i % {} == {before}", seam.blocks.count()),
    }
}

/// What is done with sample i as often as it is taken; `is_sample` where something else may stand in its place.
pub(super) fn repeated(
    rule: &Rule,
    is_sample: Option<&str>,
    body: Vec<Statement>,
) -> Vec<Statement> {
    let Some(seam) = rule.sequence.seam else {
        return body;
    };
    // One sample too many, and what stands behind all, are at no seam; nor is any of few segments.
    let mut under: Vec<String> = Vec::new();
    under.extend((seam.fewest > 1).then(|| format!("n >= {}", seam.fewest)));
    under.extend(is_sample.map(String::from));
    under.extend(rule.sequence.extra.map(|_| "i >= 0 and i < n".into()));
    let at = is_at(&seam);
    let is_seam = if under.is_empty() {
        at.clone()
    } else {
        format!("{} and {}", under.join(" and "), inner(&at))
    };
    match seam.effect {
        Effect::Missing => vec![Statement::If(is_seam, Vec::new(), body)],
        Effect::Only if under.is_empty() => vec![when(at, body)],
        Effect::Only => {
            let of_seam = vec![set("times", "0"), when(at, vec![set("times", "1")])];
            vec![
                set("times", "1"),
                when(under.join(" and "), of_seam),
                when("times > 0", body),
            ]
        }
        Effect::Twice => {
            let range = Range {
                name: "copy",
                from: "0".into(),
                to: "times".into(),
                backwards: false,
            };
            let mut all = vec![
                set("times", "1"),
                when(is_seam, vec![set("times", "2")]),
                Statement::For(range, body),
            ];
            // The loop over copies has ended, and not the one over samples.
            if rule.stop.is_some() {
                all.push(when("ended", vec![Statement::Break]));
            }
            all
        }
    }
}
