//! Rays without an answer.

use crate::kernel::KernelError;

/// Why there is no answer to a ray.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Silence {
    /// The budget is spent.
    #[error("the budget of {0} is spent")]
    Budget(String),
    /// The kernel gave none.
    #[error("no answer to a ray of {segments} segments: {error}")]
    Kernel {
        /// Of how many segments.
        segments: usize,
        /// Why.
        error: KernelError,
    },
    /// It is not a number.
    #[error("an answer to a ray of {segments} segments is not finite")]
    NotFinite {
        /// Of how many segments.
        segments: usize,
    },
    /// It takes no rays of so many samples.
    #[error("it takes fewer than {segments} samples")]
    TooMany {
        /// How many were wanted.
        segments: usize,
    },
}
