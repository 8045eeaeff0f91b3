//! From a line to renderings.

use super::VERSION;
use super::bare::quoted;
use super::greeting::Greeting;
use super::message::{Answer, AnswerTag, Outcome};
use super::number::Number;
use super::trouble::{Trouble, said};
use crate::kernel::{Gradient, KernelError, Quantity, Rendering, Task};
use crate::real::{Format, Native};
use serde_json::error::Category;

/// One result a task.
type Results = Vec<Result<Rendering, KernelError>>;

/// The results of the tasks, whose request has that id, of a kernel that greeted so; with a `gradient` each, or without.
///
/// # Errors
/// [`Trouble`] where the line is no answer to that request.
pub fn read(
    line: &[u8],
    id: u64,
    tasks: &[&Task<'_>],
    greeting: &Greeting,
    gradient: bool,
) -> Result<Results, Trouble> {
    let answer: Answer = serde_json::from_slice(line)
        .or_else(|error| match quoted(line) {
            Some(line) => serde_json::from_slice(&line),
            None => Err(error),
        })
        .map_err(|error| {
            let problem = match error.classify() {
                Category::Data => said(&error),
                _ => format!("no JSON object: {}", said(&error)),
            };
            Trouble::garbage(problem, line)
        })?;
    let (tag, name) = match greeting.version {
        VERSION => (AnswerTag::Radiance, "radiance"),
        _ => (AnswerTag::Answer, "answer"),
    };
    if answer.tag != tag {
        let problem = format!(
            "another type of answer (allowed in protocol {}: '{name}')",
            greeting.version
        );
        return Err(Trouble::garbage(problem, line));
    }
    if answer.id.as_u64() != Some(id) {
        return Err(Trouble::WrongId {
            got: answer.id.to_string(),
            wanted: id,
        });
    }
    let (got, wanted) = (answer.results.len(), tasks.len());
    if got != wanted {
        let problem = format!("{got} results (allowed: {wanted}, one a task)");
        return Err(Trouble::garbage(problem, line));
    }
    let results = answer.results.into_iter().zip(tasks);
    results
        .map(|(outcome, task)| {
            rendering(outcome, task, greeting, gradient)
                .map_err(|problem| Trouble::garbage(problem, line))
        })
        .collect()
}

/// An answer that is one, or what is wrong with it.
fn rendering(
    outcome: Outcome,
    task: &Task<'_>,
    greeting: &Greeting,
    gradient: bool,
) -> Result<Result<Rendering, KernelError>, &'static str> {
    let there = [
        (Quantity::Radiance, outcome.radiance.is_some()),
        (Quantity::Opacity, outcome.opacity.is_some()),
        (Quantity::OpticalDepth, outcome.optical_depth.is_some()),
        (Quantity::ExpectedDepth, outcome.expected_depth.is_some()),
    ];
    let is_first = greeting.version == VERSION;
    if is_first && (outcome.optical_depth.is_some() || outcome.expected_depth.is_some()) {
        return Err("a result with a depth (allowed: in protocol 2)");
    }
    if is_first && outcome.edges.is_some() {
        return Err("a result with edges (allowed: in protocol 2)");
    }
    let is_answered = if is_first {
        outcome.radiance.is_some()
    } else {
        there.iter().any(|(_, there)| *there)
    };
    match (is_answered, outcome.error) {
        (true, None) => {}
        (false, Some(reason)) => return Ok(Err(KernelError::Refused { reason })),
        (false, None) if is_first => return Err("a result without 'radiance' and 'error'"),
        (true, Some(_)) if is_first => return Err("a result with 'radiance' and 'error'"),
        (false, None) => return Err("a result without an answer and 'error'"),
        (true, Some(_)) => return Err("a result with an answer and 'error'"),
    }
    let declaration = &greeting.declaration;
    // No fewer than binary64 has.
    let bits = declaration.format.bits().max(f64::MANTISSA_DIGITS);
    let checked = || {
        for (quantity, given) in there {
            // The first version has an opacity without a word before.
            let may_be = is_first && quantity == Quantity::Opacity;
            if given != declaration.has(quantity) && !may_be {
                return Err(KernelError::Answers { quantity, given });
            }
        }
        let wanted = task.subject.channels().len();
        let got = outcome.radiance.as_ref().map_or(wanted, Vec::len);
        if got != wanted {
            return Err(KernelError::Channels { got, wanted });
        }
        let got = outcome.standard_error.as_ref().map_or(wanted, Vec::len);
        if got != wanted {
            return Err(KernelError::StandardErrors { got, wanted });
        }
        let float = |number: Number| number.to_float(bits);
        let given = outcome.gradient.is_some();
        if given != gradient {
            return Err(KernelError::GradientAsked { given });
        }
        let floats = |numbers: Vec<Number>| numbers.into_iter().map(float).collect();
        let gradient = outcome.gradient.map(|given| Gradient {
            extinction: floats(given.extinction),
            emission: given.emission.into_iter().map(floats).collect(),
        });
        let gradient = match (gradient, declaration.gradient, task.cut()) {
            (Some(gradient), Some(at), Some(segments)) => {
                // A projector knows no emission.
                let is_projector = declaration.adjoint.is_some();
                let channels = if is_projector { 0 } else { wanted };
                Some(gradient.checked(at, segments, channels)?)
            }
            _ => None,
        };
        let radiance = outcome.radiance.unwrap_or_default();
        let edges = outcome.edges.as_ref();
        let length = Native::<f64>::new().ratio(task.subject.length());
        let rendering = Rendering {
            radiance: radiance.into_iter().map(float).collect(),
            opacity: outcome.opacity.map(float),
            optical_depth: outcome.optical_depth.map(float),
            expected_depth: outcome.expected_depth.map(float),
            emission: None,
            gradient,
            step: outcome
                .step
                .as_ref()
                .map(Number::to_f64)
                .map(used_step)
                .transpose()?,
            segments: outcome.segments.as_ref().map(used_segments).transpose()?,
            edges: edges.map(|edges| edges.iter().map(Number::to_f64).collect()),
            standard_error: outcome
                .standard_error
                .map(|errors| errors.iter().map(Number::to_f64).collect()),
        };
        rendering.with_edges_on(length)
    };
    Ok(checked())
}

/// A step that a ray can have been cut by.
pub(super) fn used_step(value: f64) -> Result<f64, KernelError> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    let what = "step";
    Err(KernelError::Used { what, value })
}

fn used_segments(number: &Number) -> Result<u64, KernelError> {
    let exact = number.to_float(f64::MANTISSA_DIGITS);
    let count = exact.to_integer().filter(|_| exact.is_integer());
    let count = count.and_then(|count| count.to_u64());
    count.filter(|count| *count > 0).ok_or(KernelError::Used {
        what: "number of segments",
        value: exact.to_f64(),
    })
}
