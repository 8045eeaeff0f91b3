//! From a line to renderings.

use super::bare::quoted;
use super::message::{Outcome, Radiance};
use super::number::Number;
use super::trouble::{Trouble, said};
use crate::kernel::{KernelError, Rendering, Task};
use serde_json::error::Category;

/// One result a task.
type Results = Vec<Result<Rendering, KernelError>>;

/// The results of the tasks, whose request has that id; radiances have at least that many bits.
///
/// # Errors
/// [`Trouble`] where the line is no answer to that request.
pub fn read(line: &[u8], id: u64, tasks: &[&Task<'_>], bits: u32) -> Result<Results, Trouble> {
    let answer: Radiance = serde_json::from_slice(line)
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
            let channels = task.subject.channels().len();
            rendering(outcome, channels, bits).map_err(|problem| Trouble::garbage(problem, line))
        })
        .collect()
}

/// An answer that is one, or what is wrong with it.
fn rendering(
    outcome: Outcome,
    channels: usize,
    bits: u32,
) -> Result<Result<Rendering, KernelError>, &'static str> {
    let radiance = match (outcome.radiance, outcome.error) {
        (Some(radiance), None) => radiance,
        (None, Some(reason)) => return Ok(Err(KernelError::Refused { reason })),
        (None, None) => return Err("a result without 'radiance' and 'error'"),
        (Some(_), Some(_)) => return Err("a result with 'radiance' and 'error'"),
    };
    let checked = || {
        let wanted = channels;
        let got = radiance.len();
        if got != wanted {
            return Err(KernelError::Channels { got, wanted });
        }
        let got = outcome.standard_error.as_ref().map_or(wanted, Vec::len);
        if got != wanted {
            return Err(KernelError::StandardErrors { got, wanted });
        }
        Ok(Rendering {
            radiance: radiance.iter().map(|x| x.to_float(bits)).collect(),
            opacity: outcome.opacity.map(|x| x.to_float(bits)),
            step: outcome.step.as_ref().map(used_step).transpose()?,
            segments: outcome.segments.as_ref().map(used_segments).transpose()?,
            standard_error: outcome
                .standard_error
                .map(|errors| errors.iter().map(Number::to_f64).collect()),
        })
    };
    Ok(checked())
}

fn used_step(number: &Number) -> Result<f64, KernelError> {
    let value = number.to_f64();
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
