//! The ray of a witness, asked again.

use super::super::input;
use super::super::kernel::KernelArguments;
use super::super::{Failure, Outcome, write_out};
use serde_json::Value;
use std::fmt::Write as _;
use volver::identify::Ray;
use volver::input::COMPUTED;
use volver::kernel::Kernel;

/// A ray, and where the file says it, what is wanted.
pub(super) struct Asked {
    ray: Ray,
    wanted: Option<Wanted>,
}

struct Wanted {
    channel: usize,
    value: f64,
    tolerance: f64,
}

/// What stands in a file of `--json`, or of one task.
pub(super) fn read(path: &str) -> Result<Asked, Failure> {
    let text = input::read(path, COMPUTED)?;
    let content = |error: anyhow::Error| Failure::Content {
        path: path.into(),
        error,
    };
    let document: Value = serde_json::from_str(&text).map_err(|error| content(error.into()))?;
    let witness = document.get("witness");
    let task = witness.and_then(|witness| witness.get("task"));
    let task = task.unwrap_or(&document).to_string();
    let ray = Ray::from_json(&task).map_err(|error| content(error.into()))?;
    let number = |key: &str| witness.and_then(|witness| witness.get(key)?.as_f64());
    let channel = witness.and_then(|witness| witness.get("channel")?.as_u64());
    let wanted = match (channel, number("want"), number("tolerance")) {
        (Some(channel), Some(value), Some(tolerance)) => Some(Wanted {
            channel: usize::try_from(channel).unwrap_or(usize::MAX),
            value,
            tolerance,
        }),
        _ => None,
    };
    Ok(Asked { ray, wanted })
}

/// Asks, prints every channel's answer, and says whether it is the wanted one.
pub(super) fn run(
    asked: &Asked,
    kernel: &mut dyn Kernel,
    named: &KernelArguments,
) -> Result<Outcome, Failure> {
    let answer = kernel.render(&asked.ray.task());
    let answer = answer.map_err(|error| named.failed(error))?;
    let radiance: Vec<f64> = answer.radiance.iter().map(rug::Float::to_f64).collect();
    let task = asked.ray.task();
    let names = task.subject.channels();
    let mut text = String::new();
    let mut outcome = Outcome::Good;
    for (channel, got) in radiance.iter().enumerate() {
        let said = match &asked.wanted {
            Some(wanted) if wanted.channel == channel => {
                let is_near = (got - wanted.value).abs() <= wanted.tolerance;
                if !is_near {
                    outcome = Outcome::CheckFailed;
                }
                let verdict = if is_near { "as" } else { "where" };
                format!(", {verdict} the rule gives {:?}", wanted.value)
            }
            _ => String::new(),
        };
        // Writing to a String does not fail.
        let _ = writeln!(
            text,
            "{}: {got:?}{said}",
            names.get(channel).map_or("", String::as_str)
        );
    }
    write_out(&text)?;
    Ok(outcome)
}
