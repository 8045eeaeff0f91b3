//! An examination as one JSON document.

use super::Other;
use crate::identify::{self, Deviation, Examined, Kind, NotIdentified, Witness, parts};
use crate::method::Method;
use crate::render::ReportError;
use crate::report::schema::written;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Identification")]
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
#[derive(Serialize, JsonSchema)]
pub(in crate::report) struct Found<'a> {
    verdict: &'static str,
    /// Only where it is named.
    rule: Option<Rule<'a>>,
    /// The method that states no rule and has all the answers.
    #[serde(skip_serializing_if = "Option::is_none")]
    method: Option<String>,
    /// Of a kernel that draws random numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    scattered: Option<Scattered<'a>>,
    /// What is read of a volume.
    #[serde(skip_serializing_if = "Option::is_none")]
    volume: Option<String>,
    /// The digits that all answers held out make do with.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<Value>")]
    precision: Option<identify::Precision>,
    /// In what order contributions are added.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<Value>")]
    accumulation: Option<identify::Accumulation>,
    /// How transmittances are kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<Value>")]
    transmittance: Option<identify::Transmittance>,
    /// By how many units of 2^(−24) exponentials are off.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(with = "Option<Value>")]
    exponential: Option<identify::Exponential>,
    /// Transmittances are 1 less the opacity so far.
    transmittance_by_subtraction: bool,
    validated: Vec<Held<'a>>,
    deviations: Vec<Deviating<'a>>,
    not_identified: Vec<Open<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    witness: Option<Seen>,
    opacity: Opacity,
}

#[derive(Serialize, JsonSchema)]
pub(super) struct Rule<'a> {
    text: String,
    latex: String,
    python: String,
    c: String,
    parts: Vec<Part>,
    /// Every parameter, as `Rule` has them.
    #[schemars(with = "Value")]
    formula: &'a identify::Rule,
}

impl<'a> Rule<'a> {
    pub(super) fn of(rule: &'a identify::Rule) -> Self {
        Rule {
            text: rule.to_string(),
            latex: rule.latex(),
            python: rule.python(),
            c: rule.c(),
            parts: parts(rule).into_iter().map(part).collect(),
            formula: rule,
        }
    }
}

#[derive(Serialize, JsonSchema)]
struct Scattered<'a> {
    text: String,
    #[schemars(with = "Value")]
    law: &'a identify::rule::Law,
    /// Whether all samples of a ray lie at the same part of their segments.
    one_shift: bool,
    seeds: usize,
    #[schemars(with = "Option<f64>")]
    standard_errors: f64,
}

#[derive(Serialize, JsonSchema)]
struct Opacity {
    answered: usize,
    agree: usize,
    /// Null where it is not finite.
    #[schemars(with = "Option<f64>")]
    largest_difference: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    witness: Option<OpacityShown>,
}

#[derive(Serialize, JsonSchema)]
struct OpacityShown {
    text: String,
    #[schemars(with = "Option<f64>")]
    got: f64,
    #[schemars(with = "Option<f64>")]
    want: f64,
    task: Value,
}

#[derive(Serialize, JsonSchema)]
struct Part {
    #[serde(rename = "part")]
    name: &'static str,
    value: Option<f64>,
    words: String,
}

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Validated")]
struct Held<'a> {
    rays: &'a str,
    asked: usize,
    agree: usize,
    unanswered: usize,
    #[schemars(with = "Option<f64>")]
    digits: f64,
}

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Deviation")]
struct Deviating<'a> {
    name: &'a str,
    value: Option<f64>,
    bracket: Option<(f64, f64)>,
    /// A count, or an answer as it came.
    exact: bool,
    probe: &'a str,
    /// Kinds of rays.
    validated: &'a [String],
    does: &'a str,
    instead_of: Option<&'a str>,
}

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "NotIdentified")]
struct Open<'a> {
    reason: &'a str,
    columns: &'a [String],
    rows: &'a [Vec<f64>],
}

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Witness")]
struct Seen {
    text: String,
    channel: usize,
    /// Null where it is not finite.
    #[schemars(with = "Option<f64>")]
    got: f64,
    #[schemars(with = "Option<f64>")]
    want: f64,
    #[schemars(with = "Option<f64>")]
    tolerance: f64,
    /// As it is asked, for `--replay`.
    task: Value,
}

#[derive(Serialize, JsonSchema)]
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

#[derive(Serialize, JsonSchema)]
struct Differing<'a> {
    part: &'a str,
    one: Option<&'a str>,
    other: Option<&'a str>,
}

/// What was asked.
#[derive(Serialize, JsonSchema)]
pub(in crate::report) struct Cost {
    rays: u64,
    segments: u64,
    longest: u64,
    unanswered: u64,
    rays_for_witness: u64,
}

/// The JSON Schema of [`json`].
#[must_use]
pub fn schema() -> Value {
    written::<Document<'_>>()
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
        rule: found.named().map(Rule::of),
        method: found.method.as_ref().map(Method::name),
        scattered: found.scattered.as_ref().map(|scattered| Scattered {
            text: scattered.to_string(),
            law: &scattered.law,
            one_shift: scattered.one_shift,
            seeds: scattered.seeds,
            standard_errors: scattered.farthest,
        }),
        volume: found.optics.map(|optics| optics.to_string()),
        precision: found.hold_out.precision,
        accumulation: found.accumulation,
        transmittance: found.transmittance,
        exponential: found.exponential,
        transmittance_by_subtraction: found.parts.subtracts,
        validated: found.hold_out.kinds.iter().map(held).collect(),
        deviations: examined.deviations.iter().map(deviating).collect(),
        not_identified: found.not_identified.iter().map(open).collect(),
        witness: examined.witness.as_ref().map(seen).transpose()?,
        opacity: opacity(examined)?,
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
        exact: deviation.exact,
        probe: deviation.probe,
        validated: &deviation.validated,
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

fn opacity(examined: &Examined) -> Result<Opacity, serde_json::Error> {
    let check = &examined.found.hold_out.opacity;
    let shown = examined.opacity.as_ref().map(|shown| {
        Ok::<_, serde_json::Error>(OpacityShown {
            text: shown.to_string(),
            got: shown.got,
            want: shown.want,
            task: serde_json::from_str(&shown.ray.to_json()?)?,
        })
    });
    Ok(Opacity {
        answered: check.answered,
        agree: check.agree,
        largest_difference: check.largest,
        witness: shown.transpose()?,
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
