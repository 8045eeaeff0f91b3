//! An examination as one JSON document.

use super::Other;
use super::words::formula;
use crate::identify::{Deviation, Examined, Kind, NotIdentified, Witness, parts, rule};
use crate::render::ReportError;
use serde::Serialize;
use serde_json::Value;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    kernel: &'a str,
    #[serde(flatten)]
    found: Found<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    against: Option<Compared<'a>>,
    cost: Cost,
}

/// What was found out of one kernel.
#[derive(Serialize)]
pub(in crate::report) struct Found<'a> {
    verdict: &'static str,
    /// Only where it is named.
    rule: Option<Rule<'a>>,
    validated: Vec<Held<'a>>,
    deviations: Vec<Deviating<'a>>,
    not_identified: Vec<Open<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    witness: Option<Seen>,
}

#[derive(Serialize)]
struct Rule<'a> {
    text: String,
    parts: Vec<Part>,
    formula: &'a rule::Rule,
}

#[derive(Serialize)]
struct Part {
    #[serde(rename = "part")]
    name: &'static str,
    value: Option<f64>,
    words: String,
}

#[derive(Serialize)]
struct Held<'a> {
    rays: &'a str,
    asked: usize,
    agree: usize,
    unanswered: usize,
    digits: f64,
}

#[derive(Serialize)]
struct Deviating<'a> {
    name: &'a str,
    value: Option<f64>,
    bracket: Option<(f64, f64)>,
    does: &'a str,
    instead_of: Option<&'a str>,
}

#[derive(Serialize)]
struct Open<'a> {
    reason: &'a str,
    columns: &'a [String],
    rows: &'a [Vec<f64>],
}

#[derive(Serialize)]
struct Seen {
    text: String,
    channel: usize,
    /// Null where it is not finite.
    got: f64,
    want: f64,
    tolerance: f64,
    /// As it is asked, for `--replay`.
    task: Value,
}

#[derive(Serialize)]
struct Compared<'a> {
    kernel: &'a str,
    agree: bool,
    rays: usize,
    same_bits: usize,
    differ: usize,
    unanswered: usize,
    differences: Vec<Differing<'a>>,
    witness: Option<Seen>,
}

#[derive(Serialize)]
struct Differing<'a> {
    part: &'a str,
    one: Option<&'a str>,
    other: Option<&'a str>,
}

/// What was asked.
#[derive(Serialize)]
pub(in crate::report) struct Cost {
    rays: u64,
    segments: u64,
    longest: u64,
    unanswered: u64,
    rays_for_witness: u64,
}

/// `{"volver": version, "kernel": …, "verdict": …, "rule": …, "deviations": […], "witness": …}`, indented, with a newline
/// at the end.
///
/// # Errors
/// [`ReportError::Json`] where a value of a witness's ray is not finite, which none is.
pub fn json(examined: &Examined, other: Option<&Other>) -> Result<String, ReportError> {
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        kernel: &examined.declaration.name,
        found: found(examined)?,
        against: other.map(compared).transpose()?,
        cost: cost(examined),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

/// What was found out of one kernel.
pub(in crate::report) fn found(examined: &Examined) -> Result<Found<'_>, ReportError> {
    let found = &examined.found;
    Ok(Found {
        verdict: examined.verdict().name(),
        rule: found.named().map(|rule| Rule {
            text: formula(rule),
            parts: parts(rule).into_iter().map(part).collect(),
            formula: rule,
        }),
        validated: found.hold_out.kinds.iter().map(held).collect(),
        deviations: examined.deviations.iter().map(deviating).collect(),
        not_identified: found.not_identified.iter().map(open).collect(),
        witness: examined.witness.as_ref().map(seen).transpose()?,
    })
}

/// What was asked.
pub(in crate::report) fn cost(examined: &Examined) -> Cost {
    let spent = examined.found.spent;
    Cost {
        rays: spent.rays,
        segments: spent.segments,
        longest: spent.longest,
        unanswered: spent.unanswered,
        rays_for_witness: examined.searched.rays,
    }
}

fn part(stated: crate::identify::Stated) -> Part {
    Part {
        name: stated.part.name(),
        value: stated.value,
        words: stated.words,
    }
}

fn held(kind: &Kind) -> Held<'_> {
    Held {
        rays: &kind.name,
        asked: kind.rays,
        agree: kind.agree,
        unanswered: kind.unanswered,
        digits: kind.digits,
    }
}

fn deviating(deviation: &Deviation) -> Deviating<'_> {
    Deviating {
        name: deviation.name,
        value: deviation.value,
        bracket: deviation.bracket,
        does: &deviation.does,
        instead_of: deviation.instead_of.as_deref(),
    }
}

fn open(reason: &NotIdentified) -> Open<'_> {
    Open {
        reason: &reason.reason,
        columns: &reason.columns,
        rows: &reason.rows,
    }
}

fn seen(witness: &Witness) -> Result<Seen, serde_json::Error> {
    Ok(Seen {
        text: witness.to_string(),
        channel: witness.channel,
        got: witness.got,
        want: witness.want,
        tolerance: witness.tolerance,
        task: serde_json::from_str(&witness.ray.to_json()?)?,
    })
}

fn compared(other: &Other) -> Result<Compared<'_>, serde_json::Error> {
    let against = &other.against;
    Ok(Compared {
        kernel: &other.name,
        agree: against.agree(),
        rays: against.rays,
        same_bits: against.same,
        differ: against.differ,
        unanswered: against.unanswered,
        differences: against
            .differences
            .iter()
            .map(|difference| Differing {
                part: difference.part,
                one: difference.one.as_deref(),
                other: difference.other.as_deref(),
            })
            .collect(),
        witness: against.witness.as_ref().map(seen).transpose()?,
    })
}
