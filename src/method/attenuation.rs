//! The transmittance along a ray, from an inner rule and an exponential.

use super::exponential::{Alone, Depths, Exponentials, Row};
use super::{Exponential, Inner, MethodError, OpticalDepth, Scope};
use crate::case::Nodes;
use crate::real::{Format, Real};
use rug::Rational;
use std::sync::Arc;

/// The transmittance along a ray of n segments: what outer rules of one inner rule share.
#[derive(Debug)]
pub struct Attenuation<R: Real> {
    inner: Inner,
    exponential: Exponential,
    scope: Scope,
    format: R::Format,
    n: u64,
    depth: Arc<OpticalDepth<R>>,
    boundaries: Arc<Vec<R>>,
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
        Self::by(inner, exponential, scope, nodes, n, &Alone)
    }

    /// The same, exponentials being taken by `by`.
    pub(super) fn by<N: Nodes<Format = R::Format>>(
        inner: Inner,
        exponential: Exponential,
        scope: Scope,
        nodes: &N,
        n: u64,
        by: &dyn Exponentials<R>,
    ) -> Result<Self, MethodError> {
        let depth = Arc::new(inner.depth(nodes, n)?);
        let way = (inner, exponential, scope);
        Ok(Self::of_depth(way, nodes.format(), n, depth, by))
    }

    fn of_depth(
        (inner, exponential, scope): (Inner, Exponential, Scope),
        format: R::Format,
        n: u64,
        depth: Arc<OpticalDepth<R>>,
        by: &dyn Exponentials<R>,
    ) -> Self {
        let of = Row {
            inner,
            scope,
            offset: None,
        };
        let boundaries = match scope {
            Scope::Whole => {
                let depths = Depths::Boundaries(Arc::clone(&depth));
                by.of_negatives(exponential, of, depths)
            }
            Scope::PerSegment => {
                let depths = Depths::Segments(Arc::clone(&depth));
                let mut transmittance = format.int(1);
                let mut boundaries = Vec::with_capacity(depth.boundaries.len());
                boundaries.push(transmittance.clone());
                for segment in by.of_negatives(exponential, of, depths).iter() {
                    transmittance *= segment;
                    boundaries.push(transmittance.clone());
                }
                Arc::new(boundaries)
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
        self.with_exponential_by(exponential, scope, &Alone)
    }

    /// The same, exponentials being taken by `by`.
    pub(super) fn with_exponential_by(
        &self,
        exponential: Exponential,
        scope: Scope,
        by: &dyn Exponentials<R>,
    ) -> Self {
        let depth = Arc::clone(&self.depth);
        let way = (self.inner, exponential, scope);
        Self::of_depth(way, self.format, self.n, depth, by)
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
        self.inside_by(nodes, offset, &Alone)
    }

    /// The same, exponentials being taken by `by`.
    pub(super) fn inside_by<N: Nodes<Format = R::Format>>(
        &self,
        nodes: &N,
        offset: &Rational,
        by: &dyn Exponentials<R>,
    ) -> Result<Vec<R>, MethodError> {
        let mut partial = self
            .inner
            .partial_depths(nodes, self.n, offset, &self.depth)?;
        let of = Row {
            inner: self.inner,
            scope: self.scope,
            offset: Some(offset.clone()),
        };
        if self.scope == Scope::Whole {
            for (part, front) in partial.iter_mut().zip(&self.depth.boundaries) {
                *part += front;
            }
        }
        let inside = by.of_negatives(self.exponential, of, Depths::Inside(partial));
        let mut inside = Arc::unwrap_or_clone(inside);
        if self.scope == Scope::PerSegment {
            for (part, front) in inside.iter_mut().zip(self.boundaries.iter()) {
                *part *= front;
            }
        }
        Ok(inside)
    }
}
