//! The orders of compositing.
//!
//! With exact opacities it gives the exact radiance of a medium whose C and τ are constant in each segment,
//! those of one sample: only that replacement makes an error. Expanding both about the sample, with
//! S = C τ and T = e^(−t), and summing over the segments what each errs by itself and what the depth errs
//! by in front of it,
//!
//! ```text
//! front:   I_d − I =  d/2  { S(0) − T(D) S(D) − τ(0) I }                                     + O(d²)
//! back:    I_d − I = −d/2  { the same }                                                      + O(d²)
//! middle:  I_d − I =  d²/24 { [T S′](0) − [T S′](D) + ∫ T τ² C′ dλ − τ′(0) I }               + O(d⁴)
//! ```
//!
//! Samples in the middle see each segment evenly: by the Euler–Maclaurin formula both the depth at the
//! middles and the sum over them have even powers of d alone. Where C is constant the radiance is
//! C (1 − e^(−t̃)), and exact where the one sample a segment gives the depth t̃ exactly.
//!
//! Linear opacities leave out τ² d²/2 of each segment: d/2 { ∫ S τ T − ∫ S T ∫₀^λ τ² } with the transmittance
//! made of them, d/2 ∫ S τ T with that from depths; order 1 wherever the samples are.
//!
//! With samples at the front, linear opacities are nothing else than left Riemann sums for both integrals, and have
//! their orders.
//!
//! A break of τ, or of C τ, inside a segment is met by the one sample as by the rule that it makes (see
//! `docs/nonsmooth.md`): it leaves O(d^(1+α)). Where C is constant and τ breaks, errors of the depth on either
//! side of the break may cancel at the far end, beyond which nothing is seen: the order is unknown.

use super::{Accumulation, Compositing, CompositingOrder, OpacityFormula, Position};
use crate::case::{Break, Structure};
use crate::method::breaks::Meeting;
use crate::method::limit::{Limit, Part};
use crate::method::{Exponential, Inner, Nested, Outer, Scope};

impl Compositing {
    /// What limits the order on a case of that structure, breaks lying off the nodes. Termination limits
    /// nothing: its truncation does not depend on d.
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
        if let Some(nested) = self.as_nested() {
            return match ladder {
                Some(ladder) => nested.limits_on(structure, ladder),
                None => nested.limits(structure),
            };
        }
        let mut limits = self.of_constant_segments(structure);
        if self.opacity == OpacityFormula::Linear {
            limits.push(Limit::new(Part::LinearOpacity, 1.0));
        }
        for place in &structure.breaks {
            limits.extend(self.of_break(place, ladder));
        }
        limits
    }

    /// The nested rules that are the same sums.
    fn as_nested(&self) -> Option<Nested> {
        if self.position != Position::Front || self.opacity != OpacityFormula::Linear {
            return None;
        }
        let (exponential, scope) = match self.order {
            CompositingOrder::FrontToBack {
                depth: Accumulation::Depths,
                ..
            } => (Exponential::Exact, Scope::Whole),
            _ => (Exponential::Linear, Scope::PerSegment),
        };
        let rule = self.position.rule();
        Some(Nested {
            inner: Inner::PerSegment(rule),
            outer: Outer(rule),
            exponential,
            scope,
        })
    }

    /// What the medium's replacement by one that is constant in each segment leaves.
    fn of_constant_segments(&self, structure: &Structure) -> Vec<Limit> {
        let rule = self.position.rule();
        let degree = structure.extinction_degree();
        let depth_is_exact = degree.is_some_and(|degree| degree <= rule.degree() as usize);
        if depth_is_exact && structure.emission_is_constant() {
            return Vec::new();
        }
        let part = Part::ConstantSegments;
        if structure.emission_is_constant() && !structure.breaks.is_empty() {
            return vec![Limit::unknown(part)];
        }
        let order = f64::from(rule.order());
        let leading = Limit {
            vanishes: structure.along.end_samples_cancel && rule.order() == 1,
            ..Limit::new(part, order)
        };
        if leading.vanishes {
            vec![leading, Limit::new(part, order + 1.0)]
        } else {
            vec![leading]
        }
    }

    fn of_break(&self, place: &Break, ladder: Option<&[u64]>) -> impl Iterator<Item = Limit> {
        let rule = self.position.rule();
        let limit = |part, power: &_| {
            let meeting = Meeting::of(place, power, ladder);
            meeting.allows(Some(rule), 1, false).limit(part)
        };
        let of_extinction = place
            .extinction
            .as_ref()
            .and_then(|power| limit(Part::ExtinctionBreak, power));
        let of_source = place
            .source
            .as_ref()
            .and_then(|power| limit(Part::SourceBreak, power));
        of_extinction.into_iter().chain(of_source)
    }
}
