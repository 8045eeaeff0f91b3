//! The transmittance along a ray, from an inner rule and an exponential.

use super::{Exponential, Inner, MethodError, OpticalDepth, Scope};
use crate::case::{Nodes, Number};
use crate::real::Format;
use rug::Rational;

/// The transmittance along a ray of n segments: what outer rules of one inner rule share.
#[derive(Debug)]
pub struct Attenuation<'a, N: Nodes> {
    inner: Inner,
    exponential: Exponential,
    scope: Scope,
    nodes: &'a N,
    n: u64,
    depth: OpticalDepth<Number<N>>,
    boundaries: Vec<Number<N>>,
}

impl<'a, N: Nodes> Attenuation<'a, N> {
    /// The transmittance by that inner rule and exponential.
    ///
    /// # Errors
    /// [`MethodError::Segments`] where n does not suit the inner rule.
    pub fn new(
        inner: Inner,
        exponential: Exponential,
        scope: Scope,
        nodes: &'a N,
        n: u64,
    ) -> Result<Self, MethodError> {
        let depth = inner.depth(nodes, n)?;
        Ok(Self::of_depth(inner, exponential, scope, nodes, n, depth))
    }

    fn of_depth(
        inner: Inner,
        exponential: Exponential,
        scope: Scope,
        nodes: &'a N,
        n: u64,
        depth: OpticalDepth<Number<N>>,
    ) -> Self {
        let boundaries = match scope {
            Scope::Whole => depth
                .boundaries
                .iter()
                .map(|t| exponential.of_negative(t))
                .collect(),
            Scope::PerSegment => {
                let mut transmittance = nodes.format().int(1);
                let mut boundaries = Vec::with_capacity(depth.boundaries.len());
                boundaries.push(transmittance.clone());
                for segment in &depth.segments {
                    transmittance *= &exponential.of_negative(segment);
                    boundaries.push(transmittance.clone());
                }
                boundaries
            }
        };
        Attenuation {
            inner,
            exponential,
            scope,
            nodes,
            n,
            depth,
            boundaries,
        }
    }

    /// The same optical depth under another exponential.
    #[must_use]
    pub fn with_exponential(&self, exponential: Exponential, scope: Scope) -> Self {
        let depth = self.depth.clone();
        Self::of_depth(self.inner, exponential, scope, self.nodes, self.n, depth)
    }

    /// The nodes it was computed from.
    #[must_use]
    pub fn nodes(&self) -> &'a N {
        self.nodes
    }

    /// n.
    #[must_use]
    pub fn segments(&self) -> u64 {
        self.n
    }

    /// T at the n + 1 boundaries.
    #[must_use]
    pub fn at_boundaries(&self) -> &[Number<N>] {
        &self.boundaries
    }

    /// T at `offset` of each of the n segments, 0 < offset < 1.
    ///
    /// # Errors
    /// As [`Attenuation::new`].
    pub fn inside(&self, offset: &Rational) -> Result<Vec<Number<N>>, MethodError> {
        let partial = self
            .inner
            .partial_depths(self.nodes, self.n, offset, &self.depth)?;
        Ok(match self.scope {
            Scope::Whole => partial
                .into_iter()
                .zip(&self.depth.boundaries)
                .map(|(part, front)| self.exponential.of_negative(&(part + front)))
                .collect(),
            Scope::PerSegment => partial
                .iter()
                .zip(&self.boundaries)
                .map(|(part, front)| self.exponential.of_negative(part) * front)
                .collect(),
        })
    }
}
