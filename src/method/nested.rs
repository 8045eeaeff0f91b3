//! Nested rules: an inner rule for the optical depth, an outer rule for the radiance, and an
//! exponential between them.

use super::limit::{Limit, Part};
use super::{Exponential, Inner, MethodError, OpticalDepth, Outer, Scope, march};
use crate::case::{Nodes, Structure};
use crate::real::Format;
use rug::Rational;
use std::fmt;

pub(super) type Number<N> = <<N as Nodes>::Format as Format>::Real;

/// Any inner rule under any outer rule with any exponential.
///
/// I ≈ Σ Wᵢ Cᵢ τᵢ E(t̃(λᵢ)), with error O(d^min(p, q)) for an inner rule of order p and an outer one of
/// order q (Etiene, Kirby and Silva 2013, equation 22; proved in `proofs/Order.v`), further limited by
/// the order of a polynomial exponential.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Nested {
    /// The rule for the optical depth.
    pub inner: Inner,
    /// The rule for the radiance.
    pub outer: Outer,
    /// The exponential.
    pub exponential: Exponential,
    /// What the exponential is taken of.
    pub scope: Scope,
}

impl Nested {
    /// The radiance on n segments.
    ///
    /// # Errors
    /// [`MethodError::Segments`] where n does not suit one of the rules.
    pub fn radiance<N: Nodes>(&self, nodes: &N, n: u64) -> Result<Number<N>, MethodError> {
        if let Some(radiance) = march::radiance(self, nodes, n) {
            return radiance;
        }
        let attenuation = Attenuation::new(self.inner, self.exponential, self.scope, nodes, n)?;
        self.outer.radiance(&attenuation)
    }

    /// What limits the order on a case of that structure: p, q and the exponential's, where an inner
    /// rule that integrates the extinction exactly does not count.
    #[must_use]
    pub fn limits(&self, structure: &Structure) -> Vec<Limit> {
        let inner = self.inner.order(structure.extinction_degree());
        let exponential = self.exponential.order(self.scope);
        [
            (Part::InnerRule, inner),
            (Part::OuterRule, Some(self.outer.order())),
            (Part::Exponential, exponential),
        ]
        .into_iter()
        .filter_map(|(part, order)| Some(Limit::new(part, order?)))
        .collect()
    }
}

impl fmt::Display for Nested {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} × {}", self.inner, self.outer)?;
        match (self.exponential, self.scope) {
            (Exponential::Exact, _) => Ok(()),
            (exponential, Scope::PerSegment) => write!(f, ", {exponential} exponential"),
            (exponential, Scope::Whole) => {
                write!(f, ", {exponential} exponential of the whole depth")
            }
        }
    }
}

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
