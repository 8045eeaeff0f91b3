//! What a kernel returns.

use rug::Float;

/// The answer to a task.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rendering {
    /// The radiance of every channel, in the task's order; NaN and infinities are answers too.
    pub radiance: Vec<Float>,
    /// 1 − T, where the kernel tells.
    pub opacity: Option<Float>,
    /// The step d really used, where it is not the one asked for.
    pub step: Option<f64>,
    /// The number of segments really used, where it is not the one asked for.
    pub segments: Option<u64>,
    /// Of every channel, where the kernel is stochastic and estimates it.
    pub standard_error: Option<Vec<f64>>,
}
