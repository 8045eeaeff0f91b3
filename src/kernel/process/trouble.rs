//! What goes wrong between two processes.

use crate::kernel::KernelError;
use std::io;
use std::time::Duration;

/// How many characters of a bad answer are shown.
const SHOWN: usize = 80;

/// Why a conversation cannot go on.
#[derive(Debug)]
pub enum Trouble {
    /// Nothing came in time.
    TimedOut,
    /// A line came in time, and not all that it says stands behind it.
    HalfFrame,
    /// It closed a pipe: `request` or `answer`.
    Closed(&'static str),
    /// The system refuses to read or write.
    System(io::Error),
    /// What came is no message.
    Garbage {
        /// Why not.
        problem: String,
        /// How it begins.
        excerpt: String,
    },
    /// It greets as no kernel does.
    Greeting {
        /// What is wrong with the greeting.
        problem: String,
    },
    /// It answers something else.
    WrongId {
        /// The id of the answer.
        got: String,
        /// That of the request.
        wanted: u64,
    },
}

impl Trouble {
    /// What is said of it: it was met while `what` was waited for, for so long. `ended` is how the process ended, where it
    /// has, and `stderr` its last words.
    pub(super) fn said(
        self,
        what: &'static str,
        after: Duration,
        ended: Option<String>,
        stderr: String,
    ) -> KernelError {
        match self {
            Trouble::TimedOut => KernelError::TimedOut {
                what,
                after,
                stderr,
            },
            Trouble::HalfFrame => KernelError::TimedOut {
                what: "whole frame",
                after,
                stderr,
            },
            Trouble::Closed(pipe) => KernelError::Exited {
                how: ended.unwrap_or_else(|| format!("closed its {pipe} pipe")),
                stderr,
            },
            Trouble::System(error) => KernelError::Exited {
                how: format!("cannot be talked to: {error}"),
                stderr,
            },
            Trouble::Garbage { problem, excerpt } => KernelError::Garbage {
                problem,
                excerpt,
                stderr,
            },
            Trouble::Greeting { problem } => KernelError::Greeting { problem, stderr },
            Trouble::WrongId { got, wanted } => KernelError::WrongId {
                got,
                wanted,
                stderr,
            },
        }
    }

    pub(super) fn garbage(problem: impl Into<String>, line: &[u8]) -> Self {
        // Four bytes a character at most.
        let start = line.get(..4 * SHOWN).unwrap_or(line);
        Trouble::Garbage {
            problem: problem.into(),
            excerpt: String::from_utf8_lossy(start)
                .trim_end()
                .chars()
                .take(SHOWN)
                .collect(),
        }
    }
}

/// What the reader of JSON says, in the words of this program and without places: a message is one line.
pub(super) fn said(error: &serde_json::Error) -> String {
    let message = error.to_string();
    let message = match message.rsplit_once(" at line ") {
        Some((message, _)) => message,
        None => &message,
    };
    let message = message.replace('`', "'").replace(" field '", " key '");
    match message.split_once(", expected ") {
        Some((what, allowed)) => {
            let allowed = allowed.strip_prefix("one of ").unwrap_or(allowed);
            format!("{what} (allowed: {allowed})")
        }
        None => message,
    }
}
