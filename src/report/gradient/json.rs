//! Everything, for programs.

use super::bias::Mean;
use super::own::OwnValues;
use super::{Own, is_other};
use crate::case::Unproved;
use crate::convergence::{Fit, Sample};
use crate::method::Expected;
use crate::report::ReportError;
use crate::study::gradient::{Conclusion, Gradients, Line, OfCase, Standing};
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    volver: &'static str,
    kernel: &'a str,
    at: &'static str,
    sampling: String,
    sampling_declared: bool,
    format: String,
    far_wall: bool,
    steps: String,
    ladder: &'a [u64],
    /// Of a kernel that draws random numbers.
    #[serde(skip_serializing_if = "Option::is_none")]
    replicas: Option<usize>,
    orders: Orders,
    conclusion: &'static str,
    counts: Counts,
    cases: Vec<Case<'a>>,
    own_values: OwnValues<'a>,
}

#[derive(Serialize)]
struct Orders {
    extinction: f64,
    emission: f64,
}

#[derive(Serialize)]
struct Counts {
    confirmed: usize,
    contradicted: usize,
    inconclusive: usize,
    failed: usize,
}

#[derive(Serialize)]
struct Case<'a> {
    name: &'a str,
    channels: &'a [String],
    cotangents: &'a [f64],
    samples: usize,
    left_out: LeftOut,
    integrated: Option<f64>,
    unproved: &'a [Unproved],
    troubles: Vec<&'static str>,
    failures: Vec<Failure>,
    lines: Vec<Row<'a>>,
    /// Of a kernel that draws random numbers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    means: Vec<Mean<'a>>,
}

#[derive(Serialize)]
struct LeftOut {
    kinks: usize,
    flat: usize,
    wall: usize,
    uneven: usize,
}

#[derive(Serialize)]
struct Failure {
    segments: u64,
    error: String,
}

#[derive(Serialize)]
struct Row<'a> {
    derivative: &'static str,
    norm: &'static str,
    expected: Option<f64>,
    standing: &'static str,
    verdict: &'static str,
    order: Option<f64>,
    half_width: Option<f64>,
    fit: &'a Fit,
    samples: &'a [Sample],
}

/// `{"volver": version, "kernel": …, "conclusion": …, "cases": […]}`, indented, with a newline at the end.
///
/// # Errors
/// [`ReportError::Json`], which no result is known to cause.
pub fn json(gradients: &Gradients, own: &Own) -> Result<String, ReportError> {
    let declaration = &gradients.declaration;
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        kernel: &declaration.name,
        at: gradients.places.at.name(),
        sampling: gradients.places.sampling.to_string(),
        sampling_declared: gradients.places.is_declared,
        format: declaration.format.to_string(),
        far_wall: declaration.far_wall,
        steps: gradients.settings.steps.to_string(),
        ladder: &gradients.settings.ladder,
        replicas: declaration
            .stochastic
            .then_some(gradients.settings.replicas),
        orders: Orders {
            extinction: gradients.orders[0],
            emission: gradients.orders[1],
        },
        conclusion: if is_other(own) {
            Conclusion::NotConfirmed.name()
        } else {
            gradients.conclusion().name()
        },
        counts: Counts {
            confirmed: gradients.count(Standing::Confirmed),
            contradicted: gradients.count(Standing::Contradicted),
            inconclusive: gradients.count(Standing::Inconclusive),
            failed: gradients.count(Standing::Failed),
        },
        cases: gradients.cases.iter().map(case).collect(),
        own_values: OwnValues::of(own),
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}

fn case(case: &OfCase) -> Case<'_> {
    let failures = case.failures.iter().map(|failure| Failure {
        segments: failure.segments,
        error: failure.error.to_string(),
    });
    Case {
        name: &case.name,
        channels: &case.channels,
        cotangents: &case.cotangents,
        samples: case.samples,
        left_out: LeftOut {
            kinks: case.left_out.kinks,
            flat: case.left_out.flat,
            wall: case.left_out.wall,
            uneven: case.left_out.uneven,
        },
        integrated: case.integrated,
        unproved: &case.unproved,
        troubles: case.troubles.iter().map(|trouble| trouble.name()).collect(),
        failures: failures.collect(),
        lines: case.lines.iter().map(row).collect(),
        means: case.biases.iter().map(Mean::of).collect(),
    }
}

fn row(line: &Line) -> Row<'_> {
    let order = line.order();
    Row {
        derivative: line.derivative.name(),
        norm: line.norm.name(),
        expected: match line.expected {
            Some(Expected::Order(order)) => Some(order),
            _ => None,
        },
        standing: line.standing.name(),
        verdict: line.fit.verdict.name(),
        order: order.map(|(order, _)| order),
        half_width: order.map(|(_, half_width)| half_width),
        fit: &line.fit,
        samples: &line.samples,
    }
}
