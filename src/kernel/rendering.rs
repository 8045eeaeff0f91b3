//! What a kernel returns.

use super::{Gradient, Quantity};
use rug::Float;

/// The answer to a task.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rendering {
    /// The radiance of every channel, in the task's order; NaN and infinities are answers too. Empty of a kernel that
    /// answers none.
    pub radiance: Vec<Float>,
    /// 1 − T, where the kernel tells.
    pub opacity: Option<Float>,
    /// t of the whole ray, where the kernel tells.
    pub optical_depth: Option<Float>,
    /// The mean of λ with the weights of the samples, where the kernel tells; divided as its declaration says.
    pub expected_depth: Option<Float>,
    /// The radiance of the same ray where nothing absorbs, lit by a source per length that is τ: what is asked beside a ray
    /// of a kernel whose source is per length, and no answer to it.
    pub emission: Option<Float>,
    /// Of Σₖ aₖ Iₖ, where the task has cotangents a.
    pub gradient: Option<Gradient>,
    /// The step d really used, where it is not the one asked for.
    pub step: Option<f64>,
    /// The number of segments really used, where it is not the one asked for.
    pub segments: Option<u64>,
    /// Of every channel, where the kernel is stochastic and estimates it.
    pub standard_error: Option<Vec<f64>>,
}

impl Rendering {
    /// What was answered of that quantity, of a radiance for that channel.
    #[must_use]
    pub fn of(&self, quantity: Quantity, channel: usize) -> Option<&Float> {
        match quantity {
            Quantity::Radiance => self.radiance.get(channel),
            Quantity::Opacity => self.opacity.as_ref(),
            Quantity::OpticalDepth => self.optical_depth.as_ref(),
            Quantity::ExpectedDepth => self.expected_depth.as_ref(),
            Quantity::Emission => self.emission.as_ref(),
        }
    }
}
