//! Input that no verdict covers.

use super::Replicas;
use crate::method::Expected;

/// Fewest replicas a level may have.
pub const MIN_REPLICAS: usize = 8;
/// Fewest levels a stochastic order is fitted to.
pub(super) const MIN_LEVELS: usize = 3;

/// Replicas that no fit can take.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ReplicasError {
    /// Too few levels.
    #[error("{levels} levels are too few for a stochastic fit (allowed: {MIN_LEVELS} or more)")]
    TooFewLevels {
        /// Levels given.
        levels: usize,
    },
    /// Too few replicas at a level.
    #[error("{replicas} replicas at level {level} are too few (allowed: {MIN_REPLICAS} or more)")]
    TooFewReplicas {
        /// Index of the level.
        level: usize,
        /// Replicas given.
        replicas: usize,
    },
    /// Levels have different numbers of replicas.
    #[error("{replicas} replicas at level {level} (allowed: {allowed}, as at level 0)")]
    Unequal {
        /// Index of the level.
        level: usize,
        /// Replicas given.
        replicas: usize,
        /// Replicas at level 0.
        allowed: usize,
    },
    /// A step is not positive, or does not lie below the one before it.
    #[error(
        "step {step} of level {level} is not allowed (allowed: finite, above 0, strictly decreasing)"
    )]
    Step {
        /// Index of the level.
        level: usize,
        /// The step.
        step: f64,
    },
    /// A floor is negative or not finite.
    #[error(
        "floor {floor} of level {level} is not allowed (allowed: finite, 0 where unknown, or above)"
    )]
    Floor {
        /// Index of the level.
        level: usize,
        /// The floor.
        floor: f64,
    },
    /// The expected order is no number.
    #[error("expected order {order} is not allowed (allowed: finite numbers)")]
    Expectation {
        /// The order.
        order: f64,
    },
}

/// Refuses what no verdict covers; the number of replicas.
pub(super) fn check(
    levels: &[Replicas],
    expected: Option<Expected>,
) -> Result<usize, ReplicasError> {
    let allowed = levels.first().map_or(0, |l| l.errors.len());
    if levels.len() < MIN_LEVELS {
        return Err(ReplicasError::TooFewLevels {
            levels: levels.len(),
        });
    }
    let mut previous = f64::INFINITY;
    for (level, l) in levels.iter().enumerate() {
        let replicas = l.errors.len();
        if replicas < MIN_REPLICAS {
            return Err(ReplicasError::TooFewReplicas { level, replicas });
        }
        if replicas != allowed {
            return Err(ReplicasError::Unequal {
                level,
                replicas,
                allowed,
            });
        }
        let step = l.step;
        if !step.is_finite() || step <= 0.0 || step >= previous {
            return Err(ReplicasError::Step { level, step });
        }
        previous = step;
        let floor = l.floor;
        if !floor.is_finite() || floor < 0.0 {
            return Err(ReplicasError::Floor { level, floor });
        }
    }
    match expected {
        Some(Expected::Order(order)) if !order.is_finite() => {
            Err(ReplicasError::Expectation { order })
        }
        _ => Ok(allowed),
    }
}
