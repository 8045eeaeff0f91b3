//! The inner integral: the optical depth at every place where the outer rule looks.

mod groups;
mod monte_carlo;
mod segments;

pub use groups::Filling;

use groups::Group;

use super::Expected;
use super::breaks::{Allowed, Meeting};
use super::error::{MethodError, require_multiple};
use super::limit::{Limit, Part, euler_maclaurin};
use crate::case::{Nodes, Number, Structure};
use crate::quadrature::{Rule, Sampling};
use crate::real::{Format, Real, row};
use rug::Rational;
use std::fmt;

/// How the optical depth t(λ) = ∫₀^λ τ is approximated.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Inner {
    /// The rule on every segment by itself, with nodes of its own inside the segment
    /// (Simpson: the segment's midpoint).
    PerSegment(Rule),
    /// Simpson's rule over pairs of segments, which uses boundaries alone and leaves the odd ones to be filled.
    SimpsonPairs(Filling),
    /// Boole's rule over four segments at a time, which uses boundaries alone; the depth at those inside comes of the polynomial
    /// through all five values.
    BooleFours,
    /// Random samples.
    MonteCarlo {
        /// Which samples.
        sampling: Sampling,
        /// Where their stream starts.
        seed: u64,
    },
}

/// The optical depth along a ray of n segments.
#[derive(Clone, Debug)]
pub struct OpticalDepth<R> {
    /// The depth of each segment.
    pub segments: Vec<R>,
    /// The depth from the front to each boundary, 0 first: n + 1 values.
    pub boundaries: Vec<R>,
}

impl<R: Real> OpticalDepth<R> {
    fn from_segments(segments: Vec<R>, zero: R) -> Self {
        let mut depth = zero;
        let mut boundaries = Vec::with_capacity(segments.len() + 1);
        boundaries.push(depth.clone());
        for segment in &segments {
            depth += segment;
            boundaries.push(depth.clone());
        }
        OpticalDepth {
            segments,
            boundaries,
        }
    }

    fn from_boundaries(boundaries: Vec<R>) -> Self {
        let ends = boundaries.windows(2);
        let segments = row(ends.map(|pair| pair[1].clone() - &pair[0]));
        OpticalDepth {
            segments,
            boundaries,
        }
    }
}

impl Inner {
    /// The optical depth of every segment and up to every boundary.
    ///
    /// # Errors
    /// [`MethodError::Segments`] where n is 0, or no multiple of [`Inner::segments_multiple`].
    pub fn depth<N: Nodes>(
        self,
        nodes: &N,
        n: u64,
    ) -> Result<OpticalDepth<Number<N>>, MethodError> {
        require_multiple(&self, n, self.segments_multiple())?;
        let zero = nodes.format().int(0);
        match self {
            Inner::PerSegment(rule) => {
                let whole = Rational::from(1);
                let segments = segments::partial_depths(rule, nodes, n, &whole)?;
                Ok(OpticalDepth::from_segments(segments, zero))
            }
            Inner::SimpsonPairs(filling) => {
                let segments = groups::segment_depths(Group::Pair(filling), nodes, n);
                Ok(OpticalDepth::from_segments(segments, zero))
            }
            Inner::BooleFours => {
                let segments = groups::segment_depths(Group::Four, nodes, n);
                Ok(OpticalDepth::from_segments(segments, zero))
            }
            Inner::MonteCarlo { sampling, seed } => {
                Ok(monte_carlo::depth(sampling, seed, nodes, n))
            }
        }
    }

    /// What the number of segments must be a multiple of.
    #[must_use]
    pub fn segments_multiple(self) -> u64 {
        match self {
            Inner::SimpsonPairs(filling) => Group::Pair(filling).size(),
            Inner::BooleFours => Group::Four.size(),
            Inner::PerSegment(_) | Inner::MonteCarlo { .. } => 1,
        }
    }

    /// For each segment the depth from its front to `offset` of its length, 0 < offset < 1; `depth`
    /// is what [`Inner::depth`] gave.
    ///
    /// # Errors
    /// As [`Inner::depth`].
    pub fn partial_depths<N: Nodes>(
        self,
        nodes: &N,
        n: u64,
        offset: &Rational,
        depth: &OpticalDepth<Number<N>>,
    ) -> Result<Vec<Number<N>>, MethodError> {
        require_multiple(&self, n, self.segments_multiple())?;
        match self {
            Inner::PerSegment(rule) => Ok(segments::partial_depths(rule, nodes, n, offset)?),
            Inner::SimpsonPairs(filling) => {
                let pair = Group::Pair(filling);
                Ok(groups::partial_depths(pair, nodes, n, offset))
            }
            Inner::BooleFours => Ok(groups::partial_depths(Group::Four, nodes, n, offset)),
            Inner::MonteCarlo { sampling, seed } => Ok(monte_carlo::partial_depths(
                sampling, seed, nodes, n, offset, depth,
            )),
        }
    }

    /// What a break of τ allows the depth; `peeks`: the outer rule looks inside segments.
    ///
    /// Random samples lie inside segments as the nodes of an open rule do: the one segment that holds the
    /// break scatters by O(d^(1+α)), which is the limit of stratified samples alone, the others being of
    /// order 1 and less.
    pub(super) fn allowed_by(self, meeting: &Meeting<'_>, peeks: bool) -> Allowed {
        match self {
            Inner::PerSegment(rule) => meeting.allows(Some(rule), 1, peeks),
            Inner::SimpsonPairs(_) => meeting.allows(Some(Rule::Simpson), 2, true),
            Inner::BooleFours => meeting.allows(Some(Rule::Boole), 4, true),
            Inner::MonteCarlo { .. } => meeting.allows(None, 1, peeks),
        }
    }

    /// The order p of the optical depth (of its standard deviation's effect on the radiance, for
    /// Monte Carlo); `None` where the depth of a medium whose extinction along the ray is a
    /// polynomial of `extinction_degree` comes out exact.
    ///
    /// Source: the composite rules' orders; for pairs and fours the degree of what fills the boundaries inside.
    #[must_use]
    pub fn order(self, extinction_degree: Option<usize>) -> Option<f64> {
        let (order, degree) = match self {
            Inner::PerSegment(rule) => (f64::from(rule.order()), rule.degree() as usize),
            Inner::SimpsonPairs(filling) => Group::Pair(filling).order_and_degree(),
            Inner::BooleFours => Group::Four.order_and_degree(),
            // How many of the shared samples lie before a node is random, whatever the medium.
            Inner::MonteCarlo {
                sampling: Sampling::Shared,
                ..
            } => return Some(Sampling::Shared.order()),
            Inner::MonteCarlo { sampling, .. } => (sampling.order(), 0),
        };
        match extinction_degree {
            Some(d) if d <= degree => None,
            _ => Some(order),
        }
    }

    /// The order of the optical depth of a whole ray, breaks lying off the nodes. What it integrates is τ, and not C τ e^(−t):
    /// the structure is that of the case with C = e^t, where both are the same.
    #[must_use]
    pub fn expected(self, structure: &Structure) -> Expected {
        let Some(order) = self.order(structure.extinction_degree()) else {
            return Expected::Exact;
        };
        let mut limits = match self {
            Inner::PerSegment(rule) => euler_maclaurin(Part::InnerRule, rule, structure),
            Inner::SimpsonPairs(_) | Inner::BooleFours | Inner::MonteCarlo { .. } => {
                vec![Limit::new(Part::InnerRule, order)]
            }
        };
        limits.extend(structure.breaks.iter().filter_map(|place| {
            let power = place.extinction.as_ref()?;
            let meeting = Meeting::of(place, power, None);
            self.allowed_by(&meeting, false)
                .limit(Part::ExtinctionBreak)
        }));
        Expected::from_limits(&limits)
    }
}

impl fmt::Display for Inner {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Inner::PerSegment(rule) => rule.fmt(f),
            Inner::SimpsonPairs(filling) => filling.fmt(f),
            Inner::BooleFours => f.pad("boole-fours"),
            Inner::MonteCarlo { sampling, .. } => sampling.fmt(f),
        }
    }
}
