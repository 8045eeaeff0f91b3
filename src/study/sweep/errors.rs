//! How much a study asks about errors.

use super::between;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// How much a study asks about errors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Errors {
    /// Every error split into discretization, truncation, input and arithmetic rounding, with models of these.
    #[default]
    Split,
    /// `Q_f` − I alone, at a small part of the cost.
    Total,
}

/// A word that is none of [`Errors`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("unknown errors '{}' (allowed: split, total)", word.escape_debug())]
pub struct ErrorsError {
    /// The word.
    pub word: String,
}

impl Errors {
    /// Whether errors are split.
    #[must_use]
    pub fn is_split(&self) -> bool {
        *self == Errors::Split
    }

    /// Levels between these for models alone: none where nothing is split.
    #[must_use]
    pub fn between(self, levels: &[u64]) -> Vec<u64> {
        match self {
            Errors::Split => between(levels),
            Errors::Total => Vec::new(),
        }
    }
}

impl FromStr for Errors {
    type Err = ErrorsError;

    fn from_str(word: &str) -> Result<Self, ErrorsError> {
        match word {
            "split" => Ok(Errors::Split),
            "total" => Ok(Errors::Total),
            _ => Err(ErrorsError { word: word.into() }),
        }
    }
}

impl fmt::Display for Errors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Errors::Split => "split",
            Errors::Total => "total",
        })
    }
}
