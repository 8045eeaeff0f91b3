//! What a verdict alone does not tell.

use rug::Float;
use serde::Serialize;
use std::fmt;

/// A remark on a fit, beside its verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
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
    /// The order is one up to a logarithm: e = d^p·(c₁ − c₂·ln d) fits, and no second power does.
    Logarithm,
    /// Pairwise orders still move, and so slowly that where to is open: the next power lies less than 0.4 from
    /// the order, or it is a logarithm.
    SlowDrift {
        /// How far away the next power lies, as far as two drifts show; 0 for a drift that does not shrink.
        next: f64,
    },
    /// Pairwise orders move away faster and faster: the order that shows is not the last one.
    GrowingDrift,
    /// Two powers explain all levels, and the lower one takes over.
    GivesWay {
        /// The order at coarse levels.
        from: f64,
        /// The order at fine ones.
        to: f64,
        /// The step where both terms are as large.
        step: f64,
    },
    /// Levels of odd n follow another constant than those of even n, at one order.
    TwoSequences {
        /// The constant of odd n over that of even n.
        factor: f64,
    },
    /// Errors stop falling here, though no floor was given; the order is that of coarser levels.
    StopsFalling {
        /// Index of the level.
        level: usize,
        /// Its step.
        step: f64,
        /// log₂|e| there.
        log2_error: f64,
    },
    /// One level stands a hundred times above the two before it.
    StepsUp {
        /// Index of the level.
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
            Note::Logarithm => f.write_str("up to a logarithm: e = d^p (c1 - c2 ln d) fits"),
            Note::SlowDrift { next } => write!(
                f,
                "orders still drift, slowly: next power {next:.2} away, or a logarithm"
            ),
            Note::GrowingDrift => f.write_str("orders drift away, faster from level to level"),
            Note::GivesWay { from, to, step } => {
                write!(f, "order {from} gives way to order {to} at step {step:.4e}")
            }
            Note::TwoSequences { factor } => write!(
                f,
                "two sequences: errors of odd n are {factor:.3} times those of even n"
            ),
            Note::StopsFalling {
                level, log2_error, ..
            } => {
                let error = Float::with_val(53, *log2_error).exp2();
                let error = error.to_string_radix(10, Some(2));
                write!(f, "errors stop falling at {error} (level {level})")
            }
            Note::StepsUp { level, step } => write!(
                f,
                "level {level} (step {step:.4e}) stands far above the levels before"
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
