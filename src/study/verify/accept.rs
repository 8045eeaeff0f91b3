//! Deviations that are known, and pass as long as they stay what they are.

use crate::identify::Deviation;
use std::fmt;
use std::str::FromStr;

/// A value moves by more than this part of it.
const MOVES: f64 = 0.01;

/// A deviation that is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Accepted {
    /// Its name.
    pub name: String,
    /// Its parameter; `None` for whatever it is.
    pub value: Option<f64>,
}

/// Whether a deviation passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Acceptance {
    /// It is not known.
    Unknown,
    /// It is what was accepted.
    Accepted,
    /// It is known by name, and has another value.
    Moved {
        /// The value that was accepted.
        from: f64,
    },
}

/// How a deviation stands to those that are known.
pub(super) fn acceptance(accepted: &[Accepted], deviation: &Deviation) -> Acceptance {
    let known = accepted.iter().filter(|one| one.name == deviation.name);
    let mut moved = Acceptance::Unknown;
    for one in known {
        match one.value {
            Some(from) if !is_same(from, deviation.value) => moved = Acceptance::Moved { from },
            _ => return Acceptance::Accepted,
        }
    }
    moved
}

/// Whether a value is another but for a hundredth of it.
pub(super) fn is_same(from: f64, now: Option<f64>) -> bool {
    now.is_some_and(|now| (now - from).abs() <= MOVES * from.abs())
}

/// Text that is no deviation.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no deviation '{}' (allowed: a name as of 'volver identify', or NAME=VALUE)", text.escape_debug())]
pub struct AcceptedError {
    /// The text.
    pub text: String,
}

impl FromStr for Accepted {
    type Err = AcceptedError;

    fn from_str(text: &str) -> Result<Self, AcceptedError> {
        let wrong = || AcceptedError { text: text.into() };
        let (name, value) = match text.split_once('=') {
            Some((name, value)) => (name, Some(value)),
            None => (text, None),
        };
        let is_name = |c: char| c.is_ascii_lowercase() || c == '-';
        if name.is_empty() || !name.chars().all(is_name) {
            return Err(wrong());
        }
        let value = value.map(str::parse::<f64>).transpose();
        let value = value.ok().filter(|value| value.is_none_or(f64::is_finite));
        Ok(Accepted {
            name: name.into(),
            value: value.ok_or_else(wrong)?,
        })
    }
}

impl fmt::Display for Accepted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.value {
            Some(value) => write!(f, "{}={value}", self.name),
            None => f.write_str(&self.name),
        }
    }
}
