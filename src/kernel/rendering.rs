//! What a kernel returns.

use super::{Gradient, KernelError, MAX_TASK_SEGMENTS, Quantity};
use rug::Float;

/// So large a part of a ray is rounding of a place on it.
const EDGE: f64 = 1e-6;

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
    /// The ends of the segments really used, n + 1 of them from the eye on, where they are not those asked for.
    pub edges: Option<Vec<f64>>,
    /// Of every channel, where the kernel is stochastic and estimates it.
    pub standard_error: Option<Vec<f64>>,
}

impl Rendering {
    /// With ends of segments that can be, if there are any, on a ray of that length.
    ///
    /// # Errors
    /// [`KernelError::Edges`] where they are too few or too many, do not ascend, or leave the ray by more than rounding;
    /// [`KernelError::EdgesBeside`] where a step or a number of segments stands beside them.
    pub fn with_edges_on(self, length: f64) -> Result<Rendering, KernelError> {
        let Some(edges) = &self.edges else {
            return Ok(self);
        };
        if self.step.is_some() || self.segments.is_some() {
            return Err(KernelError::EdgesBeside);
        }
        let wrong = |problem: String| Err(KernelError::Edges { problem });
        let counts = 2..=MAX_TASK_SEGMENTS + 1;
        if !counts.contains(&(edges.len() as u64)) {
            return wrong(format!("{} of them", edges.len()));
        }
        let beyond = EDGE * length;
        let is_within = |edge: &&f64| (-beyond..=length + beyond).contains(*edge);
        if let Some((i, edge)) = edges.iter().enumerate().find(|(_, edge)| !is_within(edge)) {
            return wrong(format!("{edge} at {i}, on a ray of {length}"));
        }
        let mut pairs = edges.windows(2).enumerate();
        match pairs.find(|(_, ends)| ends[0] >= ends[1]) {
            Some((i, ends)) => wrong(format!("{} at {i}, then {}", ends[0], ends[1])),
            None => Ok(self),
        }
    }

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
