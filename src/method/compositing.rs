//! Compositing: one sample a segment and the over operator, in the variants that renderers use.

mod limits;
mod opacity;
mod order;
mod position;
mod summation;
mod threshold;
mod tree;

pub use opacity::OpacityFormula;
pub use order::{Accumulation, CompositingOrder};
pub use position::Position;
pub use summation::Summation;
pub use threshold::Threshold;

use super::MethodError;
use super::error::require_multiple;
use crate::case::{Nodes, Number, Transfer};
use crate::real::{Format, row};
use order::FrontToBack;
use rug::Rational;
use std::fmt;
use summation::Sum;

/// Compositing: I ≈ Σⱼ Cⱼ αⱼ Tⱼ with Tⱼ = ∏_{k<j} (1 − αₖ), C and τ sampled once in each of n segments
/// of length d and α the opacity of the optical depth τ d.
///
/// Variants of one position and one family of opacity (exact: all but [`OpacityFormula::Linear`]) are the
/// same approximation in exact arithmetic and differ by rounding alone; so they have the same orders, which
/// [`Compositing::limits`] states. Linear opacities under [`Accumulation::Depths`] stand apart: there
/// Tⱼ = exp(−Σ τₖ d) all the same.
///
/// Termination at a [`Threshold`] leaves out at most the threshold times the largest C behind, whatever d:
/// a truncation error, which is neither discretization nor rounding and no part of the order.
///
/// Source: Max (1995), equations 7 to 10; Levoy (1988); [`Position`] and [`OpacityFormula`] name theirs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Compositing {
    /// Where in its segment a sample lies.
    pub position: Position,
    /// α of a segment's optical depth.
    pub opacity: OpacityFormula,
    /// In which order, and how, segments are composited.
    pub order: CompositingOrder,
}

/// When a ray ends before its far end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stop {
    /// Where the method's own threshold says so; nowhere where it has none.
    AsDeclared,
    /// Nowhere, whatever the method's threshold.
    Never,
    /// After that many segments from the front, in whatever order these are composited.
    After(u64),
}

/// A ray composited.
#[derive(Clone, Debug, PartialEq)]
pub struct Composite<R> {
    /// I.
    pub radiance: R,
    /// How many segments were composited, where these are not all.
    pub stopped: Option<u64>,
    /// T in front of each composited segment; empty where the order is not front to back.
    pub transmittances: Vec<R>,
}

/// C and the optical depth τ d of one segment.
struct Sample<R> {
    emission: R,
    depth: R,
}

impl Compositing {
    /// The transmittance at which a ray ends early, where it may.
    #[must_use]
    pub fn threshold(&self) -> Option<Threshold> {
        match self.order {
            CompositingOrder::FrontToBack { stop, .. } => stop,
            CompositingOrder::BackToFront | CompositingOrder::Tree => None,
        }
    }

    /// The radiance on n segments, stopped as declared. Front to back with naive or compensated sums it takes constant memory
    /// where `nodes` do.
    ///
    /// # Errors
    /// [`MethodError::Segments`] where n is 0.
    pub fn radiance<N: Nodes>(&self, nodes: &N, n: u64) -> Result<Number<N>, MethodError> {
        let (radiance, _) = self.run(nodes, n, Stop::AsDeclared, |_| ())?;
        Ok(radiance)
    }

    /// The radiance, with where it stopped and the transmittances on the way: bit for bit that of
    /// [`Compositing::radiance`].
    ///
    /// # Errors
    /// As [`Compositing::radiance`].
    pub fn composite<N: Nodes>(
        &self,
        nodes: &N,
        n: u64,
        stop: Stop,
    ) -> Result<Composite<Number<N>>, MethodError> {
        let mut transmittances = Vec::new();
        let record = |t: &Number<N>| transmittances.push(t.clone());
        let (radiance, stopped) = self.run(nodes, n, stop, record)?;
        Ok(Composite {
            radiance,
            stopped,
            transmittances,
        })
    }

    /// Σⱼ Cⱼ αⱼ Tⱼ with Tⱼ from outside, such as those of another format, over as many segments as there
    /// are; `None` where the order is not front to back and no such transmittance comes in.
    ///
    /// Given this method's own, it is [`Compositing::composite`]'s radiance bit for bit.
    ///
    /// # Errors
    /// As [`Compositing::radiance`].
    pub fn radiance_under<N: Nodes>(
        &self,
        nodes: &N,
        n: u64,
        transmittances: &[Number<N>],
    ) -> Option<Result<Number<N>, MethodError>> {
        let CompositingOrder::FrontToBack { summation, .. } = self.order else {
            return None;
        };
        let sum = self.step(nodes, n).map(|step| {
            let samples = self.samples(nodes, n, step);
            let mut sum = Sum::new(summation, nodes.format());
            for (sample, transmittance) in samples.zip(transmittances) {
                let alpha = self.opacity.of(&sample.depth);
                sum.add(&(sample.emission * &alpha * transmittance));
            }
            sum.value()
        });
        Some(sum)
    }

    /// The radiance, and after how many segments it stopped; `record` is shown T in front of each.
    fn run<N: Nodes>(
        &self,
        nodes: &N,
        n: u64,
        stop: Stop,
        record: impl FnMut(&Number<N>),
    ) -> Result<(Number<N>, Option<u64>), MethodError> {
        let step = self.step(nodes, n)?;
        let even = nodes.everywhere();
        let even = even.map(|transfer| Sample::new(transfer, &step));
        let samples = || self.samples(nodes, n, step);
        let (radiance, composited) = self.over(nodes.format(), (even, samples), (n, stop), record);
        Ok((radiance, (composited < n).then_some(composited)))
    }

    /// The radiance of samples that are given, C and the optical depth of each segment from the eye on.
    pub(crate) fn radiance_of<F: Format>(
        &self,
        format: F,
        samples: impl ExactSizeIterator<Item = (F::Real, F::Real)>,
    ) -> F::Real {
        let n = samples.len() as u64;
        let samples = samples.map(|(emission, depth)| Sample { emission, depth });
        let (radiance, _) = self.over(format, (None, || samples), (n, Stop::AsDeclared), |_| ());
        radiance
    }

    /// The radiance of n samples, and how many of them were composited; `record` is shown T in front of each. Where all are alike
    /// that one comes first.
    #[inline]
    fn over<F: Format, S: Iterator<Item = Sample<F::Real>>>(
        &self,
        format: F,
        (even, samples): (Option<Sample<F::Real>>, impl FnOnce() -> S),
        (n, stop): (u64, Stop),
        record: impl FnMut(&F::Real),
    ) -> (F::Real, u64) {
        let count = match stop {
            Stop::After(count) => count.min(n),
            Stop::AsDeclared | Stop::Never => n,
        };
        let samples = || samples().take(length(count));
        let opacity = self.opacity;
        match self.order {
            CompositingOrder::FrontToBack {
                depth,
                summation,
                stop: declared,
            } => {
                let threshold = declared.filter(|_| stop == Stop::AsDeclared);
                let order = FrontToBack {
                    opacity,
                    depth,
                    summation,
                    threshold: threshold.map(|threshold| format.ratio(&threshold.value())),
                };
                match even {
                    Some(sample) => order.composite_even(sample, count, record),
                    None => order.composite(format, samples(), record),
                }
            }
            CompositingOrder::BackToFront => {
                let radiance = match even {
                    Some(sample) => order::back_to_front_even(opacity, sample, count),
                    None => order::back_to_front(format, opacity, row(samples())),
                };
                (radiance, count)
            }
            CompositingOrder::Tree => {
                let radiance = match even {
                    Some(sample) => order::by_tree_even(opacity, sample, count),
                    None => order::by_tree(format, opacity, samples()),
                };
                (radiance, count)
            }
        }
    }

    /// d, of n segments.
    fn step<N: Nodes>(&self, nodes: &N, n: u64) -> Result<Number<N>, MethodError> {
        require_multiple(self, n, 1)?;
        Ok(nodes.format().ratio(&(Rational::from(nodes.length()) / n)))
    }

    /// The n samples, from front to back.
    fn samples<'a, N: Nodes>(
        &self,
        nodes: &'a N,
        n: u64,
        step: Number<N>,
    ) -> impl Iterator<Item = Sample<Number<N>>> + use<'a, N> {
        let transfers = self.position.march(nodes, n);
        transfers.map(move |transfer| Sample::new(transfer, &step))
    }
}

impl<R: crate::real::Real> Sample<R> {
    #[inline]
    fn new(transfer: Transfer<R>, step: &R) -> Self {
        Sample {
            emission: transfer.emission,
            depth: transfer.extinction * step,
        }
    }
}

/// A number of segments as a length in memory.
fn length(n: u64) -> usize {
    usize::try_from(n).unwrap_or(usize::MAX)
}

/// As in [`Method::name`](super::Method::name): `front-to-back/middle/expm1`.
impl fmt::Display for Compositing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Compositing {
            position, opacity, ..
        } = self;
        match self.order {
            CompositingOrder::FrontToBack {
                depth,
                summation,
                stop,
            } => {
                write!(f, "front-to-back/{position}/{opacity}")?;
                if depth != Accumulation::Transmittances {
                    write!(f, "/{depth}")?;
                }
                if summation != Summation::Naive {
                    write!(f, "/{summation}")?;
                }
                stop.map_or(Ok(()), |threshold| write!(f, "/stop={threshold}"))
            }
            CompositingOrder::BackToFront => write!(f, "back-to-front/{position}/{opacity}"),
            CompositingOrder::Tree => write!(f, "tree/{position}/{opacity}"),
        }
    }
}
