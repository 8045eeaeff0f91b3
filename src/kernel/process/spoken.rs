//! Messages as they go over the pipes, for whoever wants to see them.

use super::greeting::hello;
use super::request::Writer;
use super::trouble::Trouble;
use super::written::{Numbers, Written};
use crate::kernel::{Declaration, KernelError, Rendering, Task};
use rug::Float;
use serde::{Serialize, Serializer};

/// What volver says first, as a line without its end.
///
/// # Errors
/// None: a greeting can be written.
pub fn greeting() -> Result<String, KernelError> {
    serde_json::to_string(&hello()).map_err(|error| KernelError::message(&error.into()))
}

/// What a program declares that said this line.
///
/// # Errors
/// [`KernelError::Greeting`] where it is no kernel's greeting.
pub fn declared(line: &str) -> Result<Declaration, KernelError> {
    let greeting = super::greeting::read(line.as_bytes());
    let greeting = greeting.map_err(|trouble| KernelError::Greeting {
        problem: match trouble {
            Trouble::Greeting { problem } => problem,
            _ => "none of a kernel".into(),
        },
        stderr: String::new(),
    })?;
    Ok(greeting.declaration)
}

/// The request of that id for tasks, as a line without its end; arrays stand in the message.
///
/// # Errors
/// [`KernelError::Message`] where a task is a function, which cannot be written.
pub fn request(id: u64, tasks: &[Task<'_>], numbers: Numbers) -> Result<String, KernelError> {
    let tasks: Vec<&Task<'_>> = tasks.iter().collect();
    let mut writer = Writer {
        numbers,
        background: tasks
            .iter()
            .any(|task| !task.subject.background().is_empty()),
        cotangents: None,
        files: None,
    };
    let line = writer.line(id, &tasks);
    let line = line.map_err(|error| KernelError::message(&error))?;
    Ok(String::from_utf8_lossy(line.trim_ascii_end()).into_owned())
}

/// What a kernel says that has these results, as a line without its end.
///
/// # Errors
/// None: numbers can be written.
pub fn answer(id: u64, results: &[Rendering]) -> Result<String, KernelError> {
    let answer = Answer {
        tag: "radiance",
        id,
        results: results.iter().map(Answered::new).collect(),
    };
    serde_json::to_string(&answer).map_err(|error| KernelError::message(&error.into()))
}

/// [`super::message::Radiance`], which volver reads and does not write.
#[derive(Serialize)]
struct Answer<'r> {
    #[serde(rename = "type")]
    tag: &'static str,
    id: u64,
    results: Vec<Answered<'r>>,
}

#[derive(Serialize)]
struct Answered<'r> {
    radiance: Vec<Precise<'r>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    opacity: Option<Precise<'r>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    step: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    segments: Option<u64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    standard_error: Option<Vec<Written>>,
}

impl<'r> Answered<'r> {
    fn new(rendering: &'r Rendering) -> Self {
        let errors = rendering.standard_error.as_ref();
        Answered {
            radiance: rendering.radiance.iter().map(Precise).collect(),
            opacity: rendering.opacity.as_ref().map(Precise),
            step: rendering.step,
            segments: rendering.segments,
            standard_error: errors.map(|errors| errors.iter().copied().map(decimal).collect()),
        }
    }
}

/// A number of as many digits as it has bits for.
struct Precise<'r>(&'r Float);

impl Serialize for Precise<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Precise(value) = self;
        if value.is_finite() && value.prec() > f64::MANTISSA_DIGITS {
            return serializer.serialize_str(&value.to_string_radix(10, None));
        }
        decimal(value.to_f64()).serialize(serializer)
    }
}

fn decimal(value: f64) -> Written {
    Written {
        value,
        numbers: Numbers::Decimal,
    }
}
