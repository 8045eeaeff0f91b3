//! The outer integral: the source term under the transmittance.

use super::Attenuation;
use super::error::{MethodError, require_multiple};
use crate::case::{Column, Nodes, Number};
use crate::quadrature::Rule;
use crate::real::{Format, Real, row, try_row};
use rug::Rational;
use std::borrow::Cow;
use std::fmt;

/// The rule for ∫₀ᴰ C τ T dλ.
///
/// A closed Newton–Cotes rule is laid over the boundaries themselves, Simpson over pairs and Boole over
/// fours of segments; midpoint and Gauss–Legendre look inside each segment, where the inner rule
/// continues the optical depth from the segment's front.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Outer(pub Rule);

impl Outer {
    /// What the number of segments must be a multiple of.
    #[must_use]
    pub fn segments_multiple(self) -> u64 {
        u64::from(self.0.intervals().unwrap_or(1))
    }

    /// The order q of the rule.
    #[must_use]
    pub fn order(self) -> f64 {
        f64::from(self.0.order())
    }

    /// The radiance: ∑ W C τ T; `nodes` are those that the attenuation was computed from.
    ///
    /// # Errors
    /// [`MethodError::Segments`] where n is no multiple of [`Outer::segments_multiple`].
    pub fn radiance<N: Nodes>(
        self,
        nodes: &N,
        attenuation: &Attenuation<Number<N>>,
    ) -> Result<Number<N>, MethodError> {
        let n = attenuation.segments();
        require_multiple(&self.0, n, self.segments_multiple())?;
        self.radiance_under(nodes, n, &self.transmittances(nodes, attenuation)?)
    }

    /// T wherever the rule looks.
    ///
    /// # Errors
    /// As [`Attenuation::inside`].
    pub fn transmittances<'t, N: Nodes>(
        self,
        nodes: &N,
        attenuation: &'t Attenuation<Number<N>>,
    ) -> Result<Transmittances<'t, Number<N>>, MethodError> {
        if self.0.intervals().is_some() {
            return Ok(vec![Cow::Borrowed(attenuation.at_boundaries())]);
        }
        let table = self.0.table(nodes.format().bits())?;
        let offsets = table.nodes.iter();
        try_row(offsets.map(|offset| attenuation.inside(nodes, offset).map(Cow::Owned)))
    }

    /// The radiance with transmittances from elsewhere, those of another format for instance.
    ///
    /// # Errors
    /// [`MethodError::Segments`] where n is no multiple of [`Outer::segments_multiple`].
    pub fn radiance_under<N: Nodes>(
        self,
        nodes: &N,
        n: u64,
        transmittances: &[Cow<'_, [Number<N>]>],
    ) -> Result<Number<N>, MethodError> {
        require_multiple(&self.0, n, self.segments_multiple())?;
        let format = nodes.format();
        let step = format.ratio(&(Rational::from(nodes.length()) / n));
        let sum = match (self.0.intervals(), transmittances) {
            (Some(intervals), [at_boundaries, ..]) => {
                self.over_boundaries(nodes, n, at_boundaries, intervals)?
            }
            (Some(_), []) => format.int(0),
            (None, inside) => self.inside_segments(nodes, n, inside)?,
        };
        Ok(sum * &step)
    }

    /// ∑ W C τ T over boundaries, from front to back, in units of the step.
    fn over_boundaries<N: Nodes>(
        self,
        nodes: &N,
        n: u64,
        transmittance: &[Number<N>],
        intervals: u32,
    ) -> Result<Number<N>, MethodError> {
        let format = nodes.format();
        let weights = CompositeWeights::new(self.0, intervals, format)?;
        let column = nodes.boundaries(n);
        let mut sum = format.int(0);
        for (term, weight) in terms(&column, transmittance).zip(weights.over(n)) {
            sum += &(term * weight);
        }
        Ok(sum)
    }

    /// The same of C τ T at boundaries, as another rule of these had it; with the step.
    pub(super) fn radiance_of_terms<N: Nodes>(
        self,
        nodes: &N,
        n: u64,
        terms: &[Number<N>],
        intervals: u32,
    ) -> Result<Number<N>, MethodError> {
        require_multiple(&self.0, n, self.segments_multiple())?;
        let format = nodes.format();
        let weights = CompositeWeights::new(self.0, intervals, format)?;
        let mut sum = format.int(0);
        let mut weighted = format.int(0);
        let one = format.int(1);
        // Of rules whose weights inside are 1 there is nothing to multiply.
        let plain = weights.repeating.iter().all(|weight| *weight == one);
        for (i, (term, weight)) in terms.iter().zip(weights.over(n)).enumerate() {
            if plain && i > 0 && i < terms.len() - 1 {
                sum += term;
            } else {
                weighted.set(term);
                weighted *= weight;
                sum += &weighted;
            }
        }
        Ok(sum * &format.ratio(&(Rational::from(nodes.length()) / n)))
    }

    /// The same of such terms summed up by what weights have in common: other roundings, and no work that grows with n.
    /// `None` where the rule's weights do not go by the place in a group of [`GROUP`].
    pub(super) fn radiance_of_sums<N: Nodes>(
        self,
        nodes: &N,
        n: u64,
        sums: &GroupSums<Number<N>>,
    ) -> Option<Result<Number<N>, MethodError>> {
        let intervals = self.0.intervals()?;
        let group = usize::try_from(intervals).ok()?;
        if !GROUP.is_multiple_of(group) {
            return None;
        }
        let format = nodes.format();
        let weighted = require_multiple(&self.0, n, self.segments_multiple()).and_then(|()| {
            let weights = CompositeWeights::new(self.0, intervals, format)?;
            let mut sum = sums.first.clone() * &weights.first;
            for (place, part) in sums.inside.iter().enumerate() {
                if let Some(weight) = weights.repeating.get(place % group) {
                    sum += &(part.clone() * weight);
                }
            }
            sum += &(sums.last.clone() * &weights.last);
            Ok(sum * &format.ratio(&(Rational::from(nodes.length()) / n)))
        });
        Some(weighted)
    }

    /// ∑ₖ wₖ ∑ⱼ C τ T at the nodes inside the segments, in units of the step.
    fn inside_segments<N: Nodes>(
        self,
        nodes: &N,
        n: u64,
        transmittances: &[Cow<'_, [Number<N>]>],
    ) -> Result<Number<N>, MethodError> {
        let format = nodes.format();
        let table = self.0.table(format.bits())?;
        let mut sum = format.int(0);
        let inside = table.nodes.iter().zip(&table.weights).zip(transmittances);
        for ((offset, weight), transmittance) in inside {
            let column = nodes.interior(n, offset);
            let mut part = format.int(0);
            for term in terms(&column, transmittance) {
                part += &term;
            }
            sum += &(part * &format.ratio(weight));
        }
        Ok(sum)
    }
}

/// Weights of closed rules repeat after so many segments, or a part of that.
const GROUP: usize = 4;

/// C τ T at boundaries, summed up: all that outer rules need that weigh them by their place in a group.
pub(crate) struct GroupSums<R> {
    first: R,
    /// Of the boundaries between the ends, by their number modulo [`GROUP`].
    inside: [R; GROUP],
    last: R,
}

impl<R: Real> GroupSums<R> {
    /// Of C τ, in the format of `zero`, and T, of no more bits.
    pub(super) fn new(sources: &[R], transmittances: &[R], zero: &R) -> Self {
        let mut sums = GroupSums {
            first: zero.clone(),
            inside: std::array::from_fn(|_| zero.clone()),
            last: zero.clone(),
        };
        let count = sources.len().min(transmittances.len());
        let mut term = zero.clone();
        for (i, (source, t)) in sources.iter().zip(transmittances).enumerate() {
            term.set(source);
            term *= t;
            if i == 0 {
                sums.first.set(&term);
            } else if i + 1 == count {
                sums.last.set(&term);
            } else {
                sums.inside[i % GROUP] += &term;
            }
        }
        sums
    }
}

/// T wherever an outer rule looks: at the boundaries, in one row, or a row for each node inside the segments.
pub type Transmittances<'t, R> = Vec<Cow<'t, [R]>>;

/// C τ T, node by node.
fn terms<'a, R: Real>(
    column: &'a Column<R>,
    transmittance: &'a [R],
) -> impl Iterator<Item = R> + 'a {
    column
        .emission
        .iter()
        .zip(&column.extinction)
        .zip(transmittance)
        .map(|((emission, extinction), t)| emission.clone() * extinction * t)
}

/// A closed rule repeated over n segments, in units of the step: neighbours share a node.
pub(super) struct CompositeWeights<R> {
    pub(super) first: R,
    /// The weights of nodes m, 1, 2 … m − 1 within each group of m segments, node m being the next
    /// group's node 0.
    pub(super) repeating: Vec<R>,
    pub(super) last: R,
}

impl<R: Real> CompositeWeights<R> {
    pub(super) fn new(rule: Rule, intervals: u32, format: R::Format) -> Result<Self, MethodError> {
        let table = rule.table(format.bits())?;
        let mut weights = vec![Rational::new(); intervals as usize + 1];
        for (node, weight) in table.nodes.iter().zip(&table.weights) {
            let at = Rational::from(node * intervals);
            for (k, slot) in weights.iter_mut().enumerate() {
                if at == k {
                    *slot = Rational::from(weight * intervals);
                }
            }
        }
        let (front, back) = (&weights[0], &weights[intervals as usize]);
        let shared = format.ratio(&Rational::from(front + back));
        let inner = weights[1..intervals as usize]
            .iter()
            .map(|w| format.ratio(w));
        Ok(CompositeWeights {
            first: format.ratio(front),
            last: format.ratio(back),
            repeating: row(std::iter::once(shared).chain(inner)),
        })
    }

    /// The weights of n + 1 boundaries, n being a multiple of the group.
    /// The weight of boundary j of n + 1.
    #[inline]
    pub(super) fn at(&self, j: u64, n: u64) -> &R {
        match &self.repeating[..] {
            _ if j == 0 => &self.first,
            _ if j == n => &self.last,
            [weight] => weight,
            // A rule has weights for a group of a few.
            weights => usize::try_from(j)
                .ok()
                .and_then(|j| weights.get(j % weights.len().max(1)))
                .unwrap_or(&self.last),
        }
    }

    /// The weights of all n + 1 boundaries.
    fn over(&self, n: u64) -> impl Iterator<Item = &R> {
        let inside = usize::try_from(n.saturating_sub(1)).unwrap_or(usize::MAX);
        let repeating = self.repeating.iter().cycle().skip(1).take(inside);
        let first = std::iter::once(&self.first);
        first.chain(repeating).chain(std::iter::once(&self.last))
    }
}

impl fmt::Display for Outer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
