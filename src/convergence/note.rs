//! What a verdict alone does not tell.

use serde::Serialize;
use std::fmt;

/// A remark on a fit, beside its verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "note", rename_all = "kebab-case")]
pub enum Note {
    /// The error changes sign before the window: the levels coarser than that do not show the order.
    SignChange {
        /// Index of the coarser level of the pair.
        level: usize,
        /// Its step.
        step: f64,
    },
    /// Beyond the level where the floor cut the ladder, an error exceeds 30 floors again: the floor is
    /// larger than stated there, or the error only passed through 0. The window before it proves nothing.
    RisesBeyondCut {
        /// Index of the first such level.
        level: usize,
        /// Its step.
        step: f64,
    },
    /// No floor was given, so that roundoff cannot be told from discretization.
    FloorUnknown,
    /// The order came from differences of values alone: the limit itself may be wrong.
    FromDifferences,
    /// The order that the differences imply did not settle.
    Unsettled,
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Note::SignChange { level, step } => {
                write!(
                    f,
                    "the error changes sign after level {level} (step {step:.4e})"
                )
            }
            Note::RisesBeyondCut { level, .. } => write!(
                f,
                "level {level} exceeds 30 floors again: floor too small, or a sign change"
            ),
            Note::FloorUnknown => {
                f.write_str("no roundoff floor given: roundoff cannot be told from discretization")
            }
            Note::FromDifferences => {
                f.write_str("from differences alone: the limit itself may be wrong")
            }
            Note::Unsettled => f.write_str("the order implied by the differences does not settle"),
        }
    }
}
