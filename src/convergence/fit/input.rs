//! Input that no verdict covers.

use super::Sample;
use crate::method::Expected;

/// Samples or an expectation that no fit can take.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FitError {
    /// A step is not a positive number.
    #[error("step {step} of level {level} is not allowed (allowed: finite, above 0)")]
    Step {
        /// Index of the level.
        level: usize,
        /// The step.
        step: f64,
    },
    /// A step does not lie below the one before it.
    #[error(
        "step {step} of level {level} does not lie below the step {previous} before it (allowed: strictly decreasing steps)"
    )]
    NotDecreasing {
        /// Index of the level.
        level: usize,
        /// The step.
        step: f64,
        /// The step of the level before.
        previous: f64,
    },
    /// A floor is negative.
    #[error("floor {floor} of level {level} is negative (allowed: 0 where unknown, or above)")]
    NegativeFloor {
        /// Index of the level.
        level: usize,
        /// The floor, rounded to binary64.
        floor: f64,
    },
    /// There are not as many standard errors as levels.
    #[error("{given} standard errors of {levels} levels (allowed: one a level)")]
    StandardErrors {
        /// How many were given.
        given: usize,
        /// How many levels there are.
        levels: usize,
    },
    /// A standard error is not above 0.
    #[error("standard error {size} of level {level} is not allowed (allowed: finite, above 0)")]
    StandardError {
        /// Index of the level.
        level: usize,
        /// The standard error, rounded to binary64.
        size: f64,
    },
    /// The expected order is no number.
    #[error("expected order {order} is not allowed (allowed: finite numbers)")]
    Expectation {
        /// The order.
        order: f64,
    },
}

/// Refuses what no verdict covers.
pub(super) fn check(samples: &[Sample], expected: Option<Expected>) -> Result<(), FitError> {
    check_steps(samples.iter().map(|s| s.step))?;
    for (level, sample) in samples.iter().enumerate() {
        if sample.floor < 0 {
            let floor = sample.floor.to_f64();
            return Err(FitError::NegativeFloor { level, floor });
        }
    }
    match expected {
        Some(Expected::Order(order)) if !order.is_finite() => Err(FitError::Expectation { order }),
        _ => Ok(()),
    }
}

/// Steps must be finite, above 0 and strictly decreasing.
pub(in crate::convergence) fn check_steps(
    steps: impl Iterator<Item = f64>,
) -> Result<(), FitError> {
    let mut previous = f64::INFINITY;
    for (level, step) in steps.enumerate() {
        if !step.is_finite() || step <= 0.0 {
            return Err(FitError::Step { level, step });
        }
        if step >= previous {
            return Err(FitError::NotDecreasing {
                level,
                step,
                previous,
            });
        }
        previous = step;
    }
    Ok(())
}
