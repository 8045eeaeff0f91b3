//! Cases as one JSON document.

use super::orders::orders;
use super::{Derived, value};
use crate::case::Case;
use crate::case::manufacture::{Check, Manufactured, Outcome, Statement};
use crate::convergence::serialize_float;
use crate::render::ReportError;
use crate::symbolic::Expr;
use rug::float::Round;
use rug::{Float, Rational};
use serde::{Serialize, Serializer};

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    cases: Vec<Object<'a>>,
}

#[derive(Serialize)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "answers of the document, independent"
)]
struct Object<'a> {
    name: &'a str,
    channel: Option<&'a str>,
    title: &'a str,
    tags: &'a [String],
    length: String,
    formulas: Formulas,
    #[serde(serialize_with = "serialize_optional")]
    optical_depth: Option<Float>,
    #[serde(serialize_with = "serialize_optional")]
    radiance: Option<Float>,
    checks: Vec<Checked>,
    /// Whether there are formulas of t and I.
    closed_form: bool,
    /// The closed form is.
    proved: bool,
    suits_kernels: bool,
    /// For pre-integration: C·τ is constant.
    degenerate: bool,
    breaks: Vec<BreakObject>,
    orders: Vec<OrderObject>,
}

/// What theory expects of a method on the case.
#[derive(Serialize)]
struct OrderObject {
    method: &'static str,
    order: String,
    theorem: Option<&'static str>,
}

#[derive(Serialize)]
struct Formulas {
    field: String,
    extinction: String,
    emission: String,
    optical_depth: Option<String>,
    radiance: Option<String>,
    extinction_along: String,
    emission_along: String,
}

#[derive(Serialize)]
struct Checked {
    statement: Statement,
    claim: String,
    outcome: &'static str,
    /// The witness, or a place that no proof got close to.
    at: Option<String>,
    /// Lower and upper bound of what a refuted claim is off by, or of the value that it is about.
    value: Option<[String; 2]>,
}

#[derive(Serialize)]
struct BreakObject {
    part: Option<String>,
    extinction: Option<String>,
    source: Option<String>,
}

/// All channels of all cases, indented, with a newline at the end.
///
/// # Errors
/// [`ReportError::Json`], which no case is known to cause.
pub fn json(derived: &[Derived]) -> Result<String, ReportError> {
    let objects = derived.iter().flat_map(|derived| {
        let cases = derived.cases.iter();
        cases.map(move |case| object(derived, case))
    });
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        cases: objects.collect(),
    };
    Ok(serde_json::to_string_pretty(&document)? + "\n")
}

fn object<'a>(derived: &'a Derived, case: &'a Manufactured) -> Object<'a> {
    let formulas = case.case.formulas();
    let exact = |q: &Option<Rational>| q.as_ref().map(Rational::to_string);
    let breaks = case.case.structure().breaks;
    Object {
        name: case.case.name(),
        channel: case.channel.as_deref(),
        title: &derived.description.title,
        tags: &derived.description.tags,
        length: case.case.length().to_string(),
        formulas: Formulas {
            field: formulas.field.to_string(),
            extinction: formulas.extinction.to_string(),
            emission: formulas.emission.to_string(),
            optical_depth: formulas.optical_depth.as_ref().map(Expr::to_string),
            radiance: formulas.radiance.as_ref().map(Expr::to_string),
            extinction_along: case.extinction.to_string(),
            emission_along: case.emission.to_string(),
        },
        optical_depth: value::total_depth(case).ok(),
        radiance: value::radiance(case).ok(),
        checks: case.checks.iter().map(checked).collect(),
        closed_form: case.has_closed_form(),
        proved: case.is_proved(),
        suits_kernels: case.suits_kernels(),
        degenerate: case.is_degenerate_for_preintegration(),
        breaks: breaks
            .iter()
            .map(|b| BreakObject {
                part: exact(&b.part),
                extinction: exact(&b.extinction),
                source: exact(&b.source),
            })
            .collect(),
        orders: orders(case)
            .into_iter()
            .map(|o| OrderObject {
                method: o.method,
                order: o.expected,
                theorem: o.theorem,
            })
            .collect(),
    }
}

#[expect(clippy::ref_option, reason = "serde passes the field")]
pub(in super::super) fn serialize_optional<S: Serializer>(
    x: &Option<Float>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match x {
        Some(x) => serialize_float(x, serializer),
        None => serializer.serialize_none(),
    }
}

fn checked(check: &Check) -> Checked {
    let (outcome, at, value) = match &check.outcome {
        Outcome::Proved => ("proved", None, None),
        Outcome::Refuted { witness, value } => ("refuted", Some(witness), value.as_ref()),
        Outcome::Undecided { near } => ("undecided", near.as_ref(), None),
    };
    Checked {
        statement: check.statement,
        claim: check.statement.to_string(),
        outcome,
        at: at.map(Rational::to_string),
        value: value.map(|value| {
            [(value.lower(), Round::Down), (value.upper(), Round::Up)]
                .map(|(bound, round)| bound.to_string_radix_round(10, Some(17), round))
        }),
    }
}
