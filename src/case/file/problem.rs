//! What can be wrong with a case file.

use super::excerpt::quoted;
use super::{MAX_CHANNELS, MAX_FILE, MAX_NAME, MAX_TITLE, expression, nesting, recipe};
use crate::symbolic::Problem;

/// What can be wrong with a case file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileProblem {
    /// Too many bytes.
    #[error("{bytes} bytes are too long a file (allowed: up to {MAX_FILE})")]
    TooLong {
        /// How many.
        bytes: usize,
    },
    /// Not TOML.
    #[error("{message} (allowed: TOML, as toml.io describes it)")]
    Syntax {
        /// What the TOML reader said.
        message: String,
    },
    /// Dotted keys of too many parts.
    #[error("too many parts of a key (allowed: up to {})", nesting::MAX_DOTS + 1)]
    TooDeep,
    /// A key that stands there already.
    #[error("key {} a second time (allowed: each key once)", quoted(key))]
    DuplicateKey {
        /// The key.
        key: String,
    },
    /// A key that means nothing there.
    #[error("unknown key {} (allowed: {})", quoted(key), allowed.join(", "))]
    UnknownKey {
        /// The key.
        key: String,
        /// What may stand there.
        allowed: Vec<&'static str>,
    },
    /// A key that has to be there always.
    #[error("no '{key}' (allowed: files with a name and a length)")]
    Missing {
        /// The key.
        key: &'static str,
    },
    /// Keys that others ask for.
    #[error(
        "{} missing{} (allowed: {})",
        list(missing),
        beside(given),
        recipe::ALLOWED
    )]
    Incomplete {
        /// The keys that are missing.
        missing: Vec<String>,
        /// The keys that ask for them.
        given: Vec<String>,
    },
    /// Keys that exclude each other.
    #[error("'{key}' does not go with '{other}' (allowed: {})", recipe::ALLOWED)]
    Excluded {
        /// The one that stands at the place.
        key: String,
        /// The other one.
        other: String,
    },
    /// No channels, or too many.
    #[error(
        "{count} channels (allowed: 1 to {MAX_CHANNELS} tables [channels.NAME], or no channels table)"
    )]
    ChannelCount {
        /// How many.
        count: usize,
    },
    /// A channel's key beside the channels.
    #[error("'{key}' outside the channels (allowed: in each [channels.NAME])")]
    OutsideChannels {
        /// The key.
        key: String,
    },
    /// Another type of TOML value.
    #[error("'{key}' is {found} (allowed: {allowed})")]
    Type {
        /// The key.
        key: String,
        /// What it is.
        found: &'static str,
        /// What it may be.
        allowed: &'static str,
    },
    /// A floating-point number where exact ones are wanted.
    #[error("'{key}' is a float, which is not exact (allowed: an integer, or in quotes: \"{}\")", quoted(text).trim_matches('\''))]
    Float {
        /// The key.
        key: String,
        /// The number as it is written.
        text: String,
    },
    /// An integer beyond 64 bits.
    #[error("'{key}' is too large an integer (allowed: 64 bits, or more in quotes)")]
    Integer {
        /// The key.
        key: String,
    },
    /// A number of too many digits.
    #[error(
        "'{key}' has too many digits (allowed: numerator and denominator of up to {} bits)",
        expression::MAX_BITS
    )]
    Digits {
        /// The key.
        key: String,
    },
    /// A name that is none.
    #[error(
        "{} is no name (allowed: a to z, 0 to 9 and -, a letter first, up to {MAX_NAME} characters)",
        quoted(text)
    )]
    Name {
        /// What stands there.
        text: String,
    },
    /// A title of several lines, or too long.
    #[error("no title (allowed: one line of up to {MAX_TITLE} characters)")]
    Title,
    /// A parameter's name that is none.
    #[error(
        "{} cannot name a parameter (allowed: letters, digits and _, no digit first, up to {MAX_NAME} characters; not lambda, s, t, pi or a function)",
        quoted(text)
    )]
    Parameter {
        /// What stands there.
        text: String,
    },
    /// A length that is not positive.
    #[error("a length of {} (allowed: above 0)", quoted(text))]
    Length {
        /// The length.
        text: String,
    },
    /// A background that no renderer is given.
    #[error("a background of {} (allowed: 0 to 1e12)", quoted(text))]
    Background {
        /// The background.
        text: String,
    },
    /// A text that is no expression, or has no value with the parameters.
    #[error("'{key}': {problem}")]
    Expression {
        /// The key.
        key: String,
        /// What is wrong.
        problem: Problem,
    },
    /// A symbol that is no variable of the key's.
    #[error("symbol {} in '{key}' (allowed: {})", quoted(symbol), some(allowed))]
    Symbol {
        /// The key.
        key: String,
        /// The symbol.
        symbol: String,
        /// Which may stand there, the variable first, then the parameters.
        allowed: Vec<String>,
    },
}

fn list(keys: &[String]) -> String {
    let keys: Vec<String> = keys.iter().map(|key| format!("'{key}'")).collect();
    keys.join(", ")
}

/// The names that a message has room for.
fn some(names: &[String]) -> String {
    match names.get(..8) {
        Some(first) if names.len() > 8 => format!("{}, …", first.join(", ")),
        _ => names.join(", "),
    }
}

fn beside(keys: &[String]) -> String {
    if keys.is_empty() {
        return String::new();
    }
    format!(" beside {}", list(keys))
}
