//! Everything, for programs.

use super::words::theory;
use crate::case::Unproved;
use crate::convergence::{
    Fit, ReportedError, Sample, StochasticFit, float_schema, serialize_float,
};
use crate::identify::Together;
use crate::kernel::{Declaration, KernelError, Quantity, Quantum, Rendering, Source, UlpBound};
use crate::report::schema::written;
use crate::report::{ReportError, identify};
use crate::study::verify::{
    self as standing, Acceptance, Axis, Beyond, Identified, Line, Measured, Verification,
};
use rug::Float;
use schemars::JsonSchema;
use serde::Serialize;
use std::num::{NonZeroU64, NonZeroUsize};

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Verification")]
struct Document<'a> {
    volver: &'static str,
    kernel: Kernel<'a>,
    axis: &'static str,
    steps: String,
    ladder: &'a [u64],
    conclusion: &'static str,
    counts: Counts,
    /// Beside the first that it answers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    answers: Vec<Answers>,
    #[serde(skip_serializing_if = "Option::is_none")]
    as_declared: Option<Declared>,
    #[serde(skip_serializing_if = "Option::is_none")]
    identification: Option<Identification<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    batch: Option<Batch<'a>>,
    findings: Vec<Finding<'a>>,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    left_out: &'a [String],
    #[serde(skip_serializing_if = "Option::is_none")]
    different_seeds: Option<usize>,
    lines: Vec<Row<'a>>,
}

#[derive(Serialize, JsonSchema)]
// Facts that do not depend on each other.
#[allow(clippy::struct_excessive_bools)]
struct Kernel<'a> {
    name: &'a str,
    form: String,
    method: Option<String>,
    order: Option<f64>,
    format: String,
    quantum: Option<Stored>,
    #[serde(flatten)]
    arithmetic: Arithmetic,
    stochastic: bool,
    sampling: Option<String>,
    step_divides: bool,
    multiple_of: NonZeroU64,
    far_wall: bool,
    background: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    batch: Option<NonZeroUsize>,
    answers: Vec<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    expected_depth: Option<&'static str>,
}

/// What answers are multiples of: a number, or a part of the largest emission.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
#[schemars(rename = "Quantum")]
enum Stored {
    Absolute(f64),
    Relative { relative: f64 },
}

/// What is declared beside the format, where anything is.
#[derive(Serialize, JsonSchema)]
struct Arithmetic {
    #[serde(skip_serializing_if = "Option::is_none")]
    output: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exp_ulp: Option<UlpBound>,
    #[serde(skip_serializing_if = "Option::is_none")]
    expm1_ulp: Option<UlpBound>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pow_ulp: Option<UlpBound>,
    #[serde(skip_serializing_if = "Option::is_none")]
    subnormals: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    noise: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    channels: Option<NonZeroUsize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    emission: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    source: Option<&'static str>,
}

impl Arithmetic {
    fn of(declaration: &Declaration) -> Arithmetic {
        Arithmetic {
            output: declaration.output.map(|output| output.to_string()),
            exp_ulp: declaration.exp_ulp,
            expm1_ulp: declaration.expm1_ulp,
            pow_ulp: declaration.pow_ulp,
            subnormals: declaration.subnormals_lost.then_some("lost"),
            noise: declaration.noise,
            channels: declaration.channels,
            emission: declaration.positive_emission.then_some("positive"),
            source: Some(declaration.source)
                .filter(|source| *source != Source::Depth)
                .map(Source::name),
        }
    }
}

#[derive(Serialize, JsonSchema)]
struct Counts {
    confirmed: usize,
    contradicted: usize,
    inconclusive: usize,
    unresolved: usize,
    blind: usize,
    failed: usize,
}

/// A quantity that is answered beside the first.
#[derive(Serialize, JsonSchema)]
struct Answers {
    quantity: &'static str,
    shown: bool,
    counts: Counts,
}

/// In how many channels values are those of the declared method.
#[derive(Serialize, JsonSchema)]
struct Declared {
    agree: usize,
    of: usize,
}

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Identified")]
struct Identification<'a> {
    /// Whether the rule holds in most channels too.
    named: bool,
    #[serde(flatten)]
    found: identify::Found<'a>,
    channels: Agreement<'a>,
    accepted: Vec<String>,
    cost: identify::Cost,
}

/// Many rays in one request.
#[derive(Serialize, JsonSchema)]
struct Batch<'a> {
    rays: usize,
    /// Of the shortest and of the longest.
    segments: [usize; 2],
    /// How many have another answer than alone.
    differ: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    name: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    does: Option<&'a str>,
    accepted: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    first: Option<Apart>,
}

/// The first ray that differs.
#[derive(Serialize, JsonSchema)]
struct Apart {
    ray: usize,
    segments: usize,
    step: f64,
    /// The radiances; null where there is no answer.
    alone: Option<Vec<String>>,
    together: Option<Vec<String>>,
}

/// The rule against the values of the ladder.
#[derive(Serialize, JsonSchema)]
struct Agreement<'a> {
    compared: usize,
    agree: usize,
    differ: &'a [String],
}

#[derive(Serialize, JsonSchema)]
struct Finding<'a> {
    words: &'a str,
    channels: &'a [String],
}

#[derive(Serialize, JsonSchema)]
#[schemars(rename = "Line")]
struct Row<'a> {
    name: &'a str,
    quantity: &'static str,
    expected: String,
    standing: &'static str,
    verdict: &'static str,
    order: Option<f64>,
    half_width: Option<f64>,
    #[serde(serialize_with = "serialize_float")]
    #[schemars(schema_with = "float_schema")]
    exact: Float,
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    unproved: &'a [Unproved],
    /// The largest of all levels, as a part of the radiance.
    largest_error: Option<f64>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    remarks: Vec<String>,
    /// From where on levels do not show an order of three or more.
    #[serde(skip_serializing_if = "Option::is_none")]
    beyond: Option<Beyond>,
    steady: bool,
    failures: Vec<Failure>,
    #[serde(skip_serializing_if = "Option::is_none")]
    fit: Option<&'a Fit>,
    #[serde(skip_serializing_if = "Option::is_none")]
    samples: Option<&'a [Sample]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    stochastic: Option<&'a StochasticFit>,
    #[serde(skip_serializing_if = "Option::is_none")]
    reported_errors: Option<ReportedError>,
}

#[derive(Serialize, JsonSchema)]
struct Failure {
    segments: u64,
    error: String,
}

/// The JSON Schema of [`json`].
#[must_use]
pub fn schema() -> serde_json::Value {
    written::<Document<'_>>()
}

/// `{"volver": version, "kernel": …, "conclusion": …, "identification": …, "lines": […]}`, indented, with a newline at
/// the end.
///
/// # Errors
/// [`ReportError::Json`], which no verification is known to cause.
pub fn json(verification: &Verification) -> Result<String, ReportError> {
    let declaration = &verification.declaration;
    let settings = &verification.settings;
    let document = Document {
        volver: env!("CARGO_PKG_VERSION"),
        kernel: Kernel {
            name: &declaration.name,
            form: declaration.form.to_string(),
            method: declaration.method.map(|method| method.name()),
            order: declaration.order,
            format: declaration.format.to_string(),
            quantum: declaration.quantum.map(|quantum| match quantum {
                Quantum::Absolute(quantum) => Stored::Absolute(quantum),
                Quantum::Relative(relative) => Stored::Relative { relative },
            }),
            arithmetic: Arithmetic::of(declaration),
            stochastic: declaration.stochastic,
            sampling: declaration.claimed_sampling().map(|s| s.to_string()),
            step_divides: declaration.step_divides,
            multiple_of: declaration.multiple_of,
            far_wall: declaration.far_wall,
            background: declaration.background,
            batch: declaration.batch,
            answers: declaration.answers.iter().map(|one| one.name()).collect(),
            expected_depth: declaration
                .has(Quantity::ExpectedDepth)
                .then(|| declaration.expected_depth.name()),
        },
        axis: match settings.axis {
            Axis::Step => "step",
            Axis::Grid => "grid",
        },
        steps: settings.steps.to_string(),
        ladder: &settings.ladder,
        conclusion: verification.conclusion().name(),
        counts: counts_of(verification.counts()),
        answers: answers(verification),
        as_declared: verification
            .as_declared()
            .map(|(agree, of)| Declared { agree, of }),
        identification: verification
            .identification
            .as_ref()
            .map(|identified| identification(identified, verification))
            .transpose()?,
        batch: verification
            .together
            .as_ref()
            .map(|found| batch(found, verification)),
        findings: verification
            .findings
            .iter()
            .map(|finding| Finding {
                words: &finding.words,
                channels: &finding.channels,
            })
            .collect(),
        left_out: &verification.left_out,
        different_seeds: verification.different_seeds,
        lines: verification.lines.iter().map(row).collect(),
    };
    let mut text = serde_json::to_string_pretty(&document)?;
    text.push('\n');
    Ok(text)
}

fn batch<'a>(found: &'a Together, verification: &Verification) -> Batch<'a> {
    let deviation = found.deviation.as_ref();
    let radiance = |answer: &Result<Rendering, KernelError>| {
        let rendering = answer.as_ref().ok()?;
        // As text: NaN and infinities are answers too.
        let numbers = rendering.radiance.iter().map(Float::to_f64);
        Some(numbers.map(|number| format!("{number:?}")).collect())
    };
    Batch {
        rays: found.rays,
        segments: [found.segments.0, found.segments.1],
        differ: found.differ,
        name: deviation.map(|deviation| deviation.name),
        does: deviation.map(|deviation| deviation.does.as_str()),
        accepted: verification.acceptance_of_batch() == Some(Acceptance::Accepted),
        first: found.first.as_ref().map(|first| Apart {
            ray: first.ray,
            segments: first.segments,
            step: first.step,
            alone: radiance(&first.alone),
            together: radiance(&first.together),
        }),
    }
}

fn counts_of(counts: standing::Counts) -> Counts {
    Counts {
        confirmed: counts.confirmed,
        contradicted: counts.contradicted,
        inconclusive: counts.inconclusive,
        unresolved: counts.unresolved,
        blind: counts.blind,
        failed: counts.failed,
    }
}

fn answers(verification: &Verification) -> Vec<Answers> {
    let not_shown = verification.not_shown();
    let others = verification.quantities().into_iter().skip(1);
    let of = |quantity: Quantity| Answers {
        quantity: quantity.name(),
        shown: !not_shown.contains(&quantity),
        counts: counts_of(verification.counts_of(quantity)),
    };
    others.map(of).collect()
}

fn identification<'a>(
    identified: &'a Identified,
    verification: &'a Verification,
) -> Result<Identification<'a>, ReportError> {
    let accepted = verification.settings.accept.iter();
    Ok(Identification {
        named: identified.named().is_some(),
        found: identify::found(&identified.examined)?,
        channels: Agreement {
            compared: identified.compared,
            agree: identified.agrees(),
            differ: &identified.differs,
        },
        accepted: accepted.map(ToString::to_string).collect(),
        cost: identify::cost(&identified.examined),
    })
}

fn row(line: &Line) -> Row<'_> {
    let order = line.measured.order();
    let (fit, samples, stochastic) = match &line.measured {
        Measured::Fitted { fit, samples } => (Some(fit.as_ref()), Some(&samples[..]), None),
        Measured::Scattered(fit) => (None, None, Some(fit.as_ref())),
        Measured::Nothing => (None, None, None),
    };
    let failures = line.failures.iter().map(|failure| Failure {
        segments: failure.segments,
        error: failure.error.to_string(),
    });
    let said = line.remarks.iter().map(|remark| remark.of(line.quantity));
    Row {
        name: &line.name,
        quantity: line.quantity.name(),
        expected: theory(line.expected),
        standing: line.standing.name(),
        verdict: line.measured.verdict().name(),
        order: order.map(|(order, _)| order),
        half_width: order.map(|(_, half_width)| half_width),
        exact: line.exact.clone(),
        unproved: &line.unproved,
        largest_error: line.largest_error().filter(|error| error.is_finite()),
        remarks: said.collect(),
        beyond: line.beyond(),
        steady: line.steady,
        failures: failures.collect(),
        fit,
        samples,
        stochastic,
        reported_errors: line.reported,
    }
}
