//! Nested rules: an inner rule for the optical depth, an outer rule for the radiance, and an
//! exponential between them.

use super::breaks::Meeting;
use super::limit::{Limit, Part, euler_maclaurin};
use super::{Attenuation, Exponential, Inner, MethodError, Outer, Scope, march};
use crate::case::{Break, Nodes, Number, Structure};
use crate::quadrature::Sampling;
use std::fmt;

/// Any inner rule under any outer rule with any exponential.
///
/// I ≈ Σ Wᵢ Cᵢ τᵢ E(t̃(λᵢ)), with error O(d^min(p, q)) for an inner rule of order p and an outer one of
/// order q (Etiene, Kirby and Silva 2013, equation 22; proved in `proofs/theory/Nested.v`), further limited by
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
        if let Some(radiance) = march::radiance(
            self.inner,
            self.outer,
            self.exponential,
            self.scope,
            nodes,
            n,
        ) {
            return radiance;
        }
        let attenuation = Attenuation::new(self.inner, self.exponential, self.scope, nodes, n)?;
        self.outer.radiance(nodes, &attenuation)
    }

    /// What limits the order on a case of that structure: p, q and the exponential's, where an inner
    /// rule that integrates the extinction exactly does not count, and what breaks leave that lie off
    /// the nodes. Where C τ e^(−t) hides the outer rule's error, the next order stands beside it.
    #[must_use]
    pub fn limits(&self, structure: &Structure) -> Vec<Limit> {
        self.limits_at(structure, None)
    }

    /// What limits the order on these numbers of segments, where each break has its known place.
    #[must_use]
    pub fn limits_on(&self, structure: &Structure, ladder: &[u64]) -> Vec<Limit> {
        self.limits_at(structure, Some(ladder))
    }

    fn limits_at(&self, structure: &Structure, ladder: Option<&[u64]>) -> Vec<Limit> {
        if structure.source_is_zero() {
            return Vec::new();
        }
        let inner = self.inner.order(structure.extinction_degree());
        let exponential = self.exponential_order();
        let inner = inner.map(|order| Limit::new(Part::InnerRule, order));
        let outer = euler_maclaurin(Part::OuterRule, self.outer.0, structure);
        let exponential = exponential.map(|order| Limit::new(Part::Exponential, order));
        let smooth = inner.into_iter().chain(outer).chain(exponential);
        let breaks = structure.breaks.iter();
        let broken = breaks.flat_map(|place| self.limits_of(place, ladder));
        smooth.chain(broken).collect()
    }

    /// What one break leaves to the rules: to the inner one that of τ, to the outer one that of C·τ and
    /// that of the transmittance, whose power is higher by one.
    fn limits_of(&self, place: &Break, ladder: Option<&[u64]>) -> impl Iterator<Item = Limit> {
        let outer_is_open = self.outer.0.intervals().is_none();
        let inner = place.extinction.as_ref().map(|power| {
            let allowed = self
                .inner
                .allowed_by(&Meeting::of(place, power, ladder), outer_is_open);
            (Part::ExtinctionBreak, allowed)
        });
        let outer = place.under_transmittance().map(|power| {
            let group = self.outer.segments_multiple();
            let allowed =
                Meeting::of(place, &power, ladder).allows(Some(self.outer.0), group, false);
            (Part::SourceBreak, allowed)
        });
        let both = inner.into_iter().chain(outer);
        both.filter_map(|(part, allowed)| allowed.limit(part))
    }
}

impl Nested {
    /// The exponential's order by itself, except that a linear one per segment does not converge over
    /// independent samples: the difference of two independent estimates of the depth scatters by
    /// O(√d), not O(d), and what a linear exponential neglects of n such segments is a constant.
    fn exponential_order(&self) -> Option<f64> {
        let independent = matches!(
            self.inner,
            Inner::MonteCarlo {
                sampling: Sampling::Independent,
                ..
            }
        );
        if independent && self.exponential == Exponential::Linear {
            return Some(0.0);
        }
        self.exponential.order(self.scope)
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
