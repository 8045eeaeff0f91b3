//! The transmittance along a ray, from an inner rule and an exponential.

use super::{Exponential, Inner, MethodError, OpticalDepth, Scope};
use crate::case::Nodes;
use crate::real::{Format, Real, row};
use rug::Rational;

/// The transmittance along a ray of n segments: what outer rules of one inner rule share.
#[derive(Debug)]
pub struct Attenuation<R: Real> {
    inner: Inner,
    exponential: Exponential,
    scope: Scope,
    format: R::Format,
    n: u64,
    depth: OpticalDepth<R>,
    boundaries: Vec<R>,
}

impl<R: Real> Attenuation<R> {
    /// The transmittance by that inner rule and exponential.
    ///
    /// # Errors
    /// [`MethodError::Segments`] where n does not suit the inner rule.
    pub fn new<N: Nodes<Format = R::Format>>(
        inner: Inner,
        exponential: Exponential,
        scope: Scope,
        nodes: &N,
        n: u64,
    ) -> Result<Self, MethodError> {
        let depth = inner.depth(nodes, n)?;
        let format = nodes.format();
        Ok(Self::of_depth(inner, exponential, scope, format, n, depth))
    }

    fn of_depth(
        inner: Inner,
        exponential: Exponential,
        scope: Scope,
        format: R::Format,
        n: u64,
        depth: OpticalDepth<R>,
    ) -> Self {
        let boundaries = match scope {
            Scope::Whole => {
                let depths = depth.boundaries.iter();
                row(depths.map(|t| exponential.of_negative(t)))
            }
            Scope::PerSegment => {
                let mut transmittance = format.int(1);
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
            format,
            n,
            depth,
            boundaries,
        }
    }

    /// The same optical depth under another exponential.
    #[must_use]
    pub fn with_exponential(&self, exponential: Exponential, scope: Scope) -> Self {
        let depth = self.depth.clone();
        Self::of_depth(self.inner, exponential, scope, self.format, self.n, depth)
    }

    /// n.
    #[must_use]
    pub fn segments(&self) -> u64 {
        self.n
    }

    /// T at the n + 1 boundaries.
    #[must_use]
    pub fn at_boundaries(&self) -> &[R] {
        &self.boundaries
    }

    /// T at `offset` of each of the n segments, 0 < offset < 1; `nodes` are those it was computed from.
    ///
    /// # Errors
    /// As [`Attenuation::new`].
    pub fn inside<N: Nodes<Format = R::Format>>(
        &self,
        nodes: &N,
        offset: &Rational,
    ) -> Result<Vec<R>, MethodError> {
        let partial = self
            .inner
            .partial_depths(nodes, self.n, offset, &self.depth)?;
        Ok(match self.scope {
            Scope::Whole => row(partial
                .into_iter()
                .zip(&self.depth.boundaries)
                .map(|(part, front)| self.exponential.of_negative(&(part + front)))),
            Scope::PerSegment => row(partial
                .iter()
                .zip(&self.boundaries)
                .map(|(part, front)| self.exponential.of_negative(part) * front)),
        })
    }
}
