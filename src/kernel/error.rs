//! Why no radiance came of a task.

use super::{FormKind, MAX_TASK_SEGMENTS, Quantity};
use std::time::Duration;

/// A kernel that did not answer, or answered what is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum KernelError {
    /// The program cannot be started.
    #[error("'{program}' does not start: {reason} (allowed: a program that can be run)")]
    Start {
        /// The program.
        program: String,
        /// What the system says.
        reason: String,
    },
    /// A descriptor by which no kernel can be talked to.
    #[error(
        "descriptor {descriptor}: {problem} (allowed: an end of a pipe that the caller hands down)"
    )]
    Descriptor {
        /// Its number.
        descriptor: u16,
        /// What is wrong with it.
        problem: String,
    },
    /// The process ended.
    #[error("the kernel {}{}", how, last_words(stderr))]
    Exited {
        /// How: `exited with code 3`, `was killed by signal 11`.
        how: String,
        /// The last lines of its standard error.
        stderr: String,
    },
    /// No answer in time.
    #[error("no {what} in {} s (allowed: up to {}){}", after.as_secs_f64(), time_out(what), last_words(stderr))]
    TimedOut {
        /// What was waited for: `greeting`, `answer`.
        what: &'static str,
        /// How long was waited.
        after: Duration,
        /// The last lines of its standard error.
        stderr: String,
    },
    /// An answer that cannot be read.
    #[error("{problem} in the answer '{}' (allowed: see docs/protocol.md){}", excerpt.escape_debug(), last_words(stderr))]
    Garbage {
        /// What is wrong.
        problem: String,
        /// The beginning of what it said.
        excerpt: String,
        /// The last lines of its standard error.
        stderr: String,
    },
    /// A greeting that is no kernel's.
    #[error("the kernel's greeting: {problem}{}", last_words(stderr))]
    Greeting {
        /// What is wrong, and what is allowed.
        problem: String,
        /// The last lines of its standard error.
        stderr: String,
    },
    /// Another greeting than at the first start.
    #[error("started anew, the kernel declares other values of: {keys} (allowed: the same always)")]
    Changed {
        /// What differs.
        keys: String,
    },
    /// A request that cannot be written down.
    #[error(
        "the request cannot be written: {reason} (allowed: a directory for temporary files with room)"
    )]
    Message {
        /// What the system says.
        reason: String,
    },
    /// What is said cannot be kept.
    #[error("{reason} (allowed: a place with room)")]
    Log {
        /// What the system says.
        reason: String,
    },
    /// An answer to another request.
    #[error(
        "an answer to request {got} (allowed: to {wanted}, the one asked){}",
        last_words(stderr)
    )]
    WrongId {
        /// The request answered.
        got: String,
        /// The request that was to be answered.
        wanted: u64,
        /// The last lines of its standard error.
        stderr: String,
    },
    /// Another number of radiances than channels.
    #[error("{got} radiances (allowed: {wanted}, one a channel)")]
    Channels {
        /// How many came.
        got: usize,
        /// How many there are.
        wanted: usize,
    },
    /// Another number of standard errors than channels.
    #[error("{got} standard errors (allowed: {wanted}, one a channel)")]
    StandardErrors {
        /// How many came.
        got: usize,
        /// How many there are.
        wanted: usize,
    },
    /// A quantity that was declared is not in the result, or one is that was not.
    #[error("{} '{}' (allowed: what the greeting declares, and all of it)", if *given { "an undeclared" } else { "no" }, quantity.name())]
    Answers {
        /// Which.
        quantity: Quantity,
        /// Whether it is there.
        given: bool,
    },
    /// An array of another type or shape than it has to have.
    #[error("a block '{name}' of {got} (allowed: {wanted})")]
    Block {
        /// Of what.
        name: &'static str,
        /// Its type and shape.
        got: String,
        /// Those that it has to have.
        wanted: String,
    },
    /// More rays than go into one request.
    #[error("{rays} rays in one request (allowed: up to {most}, as the kernel declares)")]
    Together {
        /// How many.
        rays: usize,
        /// How many it takes.
        most: usize,
    },
    /// It does not differentiate.
    #[error(
        "no gradient is declared (allowed: \"gradient\": \"middles\" or \"edges\" in the greeting)"
    )]
    NoGradient,
    /// A gradient of another shape than the values.
    #[error("a gradient with {got} numbers of {what} (allowed: {wanted})")]
    Gradient {
        /// `extinction`, `emission`, `channels of emission`.
        what: &'static str,
        /// How many came.
        got: usize,
        /// How many values there are.
        wanted: usize,
    },
    /// A gradient that was asked for is missing, or one that was not is there.
    #[error("{} 'gradient' (allowed: where the task has cotangents)", if *given { "an unasked" } else { "no" })]
    GradientAsked {
        /// Whether it is there.
        given: bool,
    },
    /// What it says it used is not possible.
    #[error(
        "a {what} of {value} really used (allowed: above 0, whole for a number, and up to {MAX_TASK_SEGMENTS} segments)"
    )]
    Used {
        /// `step` or `number of segments`.
        what: &'static str,
        /// What it says.
        value: f64,
    },
    /// Ends of segments that cannot be.
    #[error(
        "edges really used: {problem} (allowed: 2 to {} that ascend, from 0 to the length of the ray)", MAX_TASK_SEGMENTS + 1
    )]
    Edges {
        /// What is wrong with them.
        problem: String,
    },
    /// Ends of segments, and how many these are.
    #[error("edges beside a step or a number of segments (allowed: one of them)")]
    EdgesBeside,
    /// The kernel says that it cannot do it.
    #[error("the kernel refuses: {}", one_line(reason))]
    Refused {
        /// In its own words.
        reason: String,
    },
    /// A ray in a form that the kernel did not ask for.
    #[error("a task as {given} (allowed: {wanted}, as declared)")]
    Form {
        /// The form of the task.
        given: FormKind,
        /// The form declared.
        wanted: FormKind,
    },
    /// Started anew too often: it is not tried again.
    #[error("given up after {failures} failures one after the other; the last: {last}")]
    GivenUp {
        /// How many.
        failures: u32,
        /// The last of them.
        last: Box<KernelError>,
    },
    /// A shared library that cannot be used.
    #[error("{path}: {problem} (allowed: a shared library as include/volver.h describes it)")]
    Library {
        /// The library.
        path: String,
        /// What is wrong.
        problem: String,
    },
    /// What went wrong when the answer was kept, in the words of then.
    #[error("{words}")]
    Kept {
        /// These.
        words: String,
    },
    /// A ray that was not asked when answers were kept.
    #[error("no answer to {case} was kept (allowed: what was asked then)")]
    NotKept {
        /// The case.
        case: String,
    },
    /// A method of this crate that cannot be run so.
    #[error(transparent)]
    Method(#[from] crate::method::MethodError),
}

impl KernelError {
    /// The request cannot be written down.
    pub(super) fn message(error: &std::io::Error) -> Self {
        KernelError::Message {
            reason: error.to_string(),
        }
    }
}

/// The option of the command line that says how long is waited.
fn time_out(what: &str) -> &'static str {
    match what {
        "greeting" => "--start-timeout",
        _ => "--timeout",
    }
}

/// Characters of a kernel's own words that are shown.
const WORDS: usize = 400;

/// A kernel's own words in one line of a terminal, whatever they are.
fn one_line(words: &str) -> String {
    let shown = |c: char| if is_plain(c) { c } else { ' ' };
    let plain: String = words.chars().map(shown).collect();
    let words: Vec<&str> = plain.split_whitespace().collect();
    let line = words.join(" ");
    match line.char_indices().nth(WORDS) {
        Some((end, _)) => format!("{}…", &line[..end]),
        None => line,
    }
}

/// Neither a control character nor one that turns the direction of a line.
fn is_plain(c: char) -> bool {
    !c.is_control()
        && !matches!(c, '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// The end of what a child said on standard error, as a clause.
fn last_words(stderr: &str) -> String {
    let stderr = stderr.trim();
    if stderr.is_empty() {
        return String::new();
    }
    let lines: Vec<&str> = stderr.lines().map(str::trim).collect();
    format!("; its standard error ends: {}", lines.join(" | "))
}
