//! By which values a kernel differentiates, and what length each stands for.

use crate::kernel::{Declaration, GradientAt, Samples, Sampling, Segments};
use crate::method::Method;

/// Within that part of the largest τ of a ray a sample is taken to lie at the kink of a rectifier.
const KINK: f64 = 1e-6;

/// Lengths that differ by no more than this part are the same.
const SAME: f64 = 1e-6;

/// Which values the samples of a kernel are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Places {
    /// Middles or edges.
    pub at: GradientAt,
    /// How edges are used: in the middles of segments nothing else can be.
    pub sampling: Sampling,
    /// Whether that was declared; else it is what most kernels of that kind do.
    pub is_declared: bool,
}

/// Samples that no error is measured at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeftOut {
    /// Where τ is that close to 0: a rectifier may have any slope there.
    pub kinks: usize,
    /// Of these where the kernel's derivative is 0 and theory's is not: a vacuum without a slope, so that no extinction
    /// ever grows there.
    pub flat: usize,
    /// The last of a far wall.
    pub wall: usize,
    /// Of ends those with segments of two lengths beside them, or one alone: what they stand for does not lie about them.
    pub uneven: usize,
}

/// Values that kernels cannot sample so.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "it answers gradients by the {} and samples '{sampling}' (allowed: middles with sampling middle, edges with front, back or ends)", at.name()
)]
pub struct PlacesError {
    /// Middles or edges.
    pub at: GradientAt,
    /// What is sampled.
    pub sampling: Sampling,
}

impl Places {
    /// Those of a kernel that differentiates by these values.
    ///
    /// # Errors
    /// [`PlacesError`] where it samples elsewhere.
    pub fn of(declaration: &Declaration, at: GradientAt) -> Result<Self, PlacesError> {
        let of_method = match (at, declaration.method) {
            // They look at both ends.
            (
                GradientAt::Edges,
                Some(Method::Nested(_) | Method::Preintegrated(_) | Method::Layered(_)),
            ) => Some(Sampling::Ends),
            _ => None,
        };
        let claimed = declaration.claimed_sampling().or(of_method);
        let sampling = claimed.unwrap_or(match at {
            GradientAt::Middles => Sampling::Middle,
            GradientAt::Edges => Sampling::Ends,
        });
        match (at, sampling) {
            (GradientAt::Middles, Sampling::Middle)
            | (GradientAt::Edges, Sampling::Front | Sampling::Back | Sampling::Ends) => {
                Ok(Places {
                    at,
                    sampling,
                    is_declared: claimed.is_some(),
                })
            }
            // In the mean over seeds a value stands for what is interpolated with it.
            (_, Sampling::Jittered) if declaration.stochastic => Ok(Places {
                at,
                sampling,
                is_declared: true,
            }),
            _ => Err(PlacesError { at, sampling }),
        }
    }

    /// The order that derivatives have at such places, if all else is right.
    #[must_use]
    pub fn order(self) -> f64 {
        match self.sampling {
            // That of the mean, of jittered samples.
            Sampling::Middle | Sampling::Ends | Sampling::Jittered => 2.0,
            Sampling::Front | Sampling::Back => 1.0,
        }
    }

    /// The values themselves.
    #[must_use]
    pub fn samples(self, segments: &Segments) -> &Samples {
        match self.at {
            GradientAt::Middles => &segments.middles,
            GradientAt::Edges => &segments.edges,
        }
    }

    /// The length that each value stands for; `None` of one that is not used.
    pub(in crate::study) fn lengths(self, segments: &Segments) -> Vec<Option<f64>> {
        let lengths: Vec<f64> = segments.lengths().collect();
        let behind = lengths.iter().copied().map(Some).chain([None]);
        let before = [None].into_iter().chain(lengths.iter().copied().map(Some));
        match self.sampling {
            _ if self.at == GradientAt::Middles => lengths.iter().copied().map(Some).collect(),
            Sampling::Front => behind.collect(),
            Sampling::Back => before.collect(),
            Sampling::Middle | Sampling::Jittered | Sampling::Ends => before
                .zip(behind)
                .map(|(before, behind)| {
                    Some(f64::midpoint(before.unwrap_or(0.0), behind.unwrap_or(0.0)))
                })
                .collect(),
        }
    }

    /// Of each value whether it is looked at in the derivative by τ, and in that by C: not what belongs to a wall, and by τ
    /// not what lies at a kink.
    pub(super) fn looked_at(
        self,
        segments: &Segments,
        far_wall: bool,
    ) -> (Vec<[bool; 2]>, LeftOut) {
        let extinction = &self.samples(segments).extinction;
        let largest = extinction
            .iter()
            .fold(0.0, |most: f64, tau| most.max(tau.abs()));
        let lengths = self.lengths(segments);
        let used = lengths.iter().filter(|length| length.is_some()).count();
        let of_wall = match self.sampling {
            _ if !far_wall => 0,
            // Both ends of the last segment.
            _ if self.is_shared() => 2,
            _ => 1,
        };
        let is_even = self.is_even(segments);
        let mut left_out = LeftOut::default();
        let mut seen = 0;
        let values = extinction.iter().zip(&lengths).zip(is_even);
        let looked_at = values.map(|((tau, length), is_even)| {
            if length.is_none() {
                return [false; 2];
            }
            seen += 1;
            if seen + of_wall > used {
                left_out.wall += 1;
                return [false; 2];
            }
            if !is_even {
                left_out.uneven += 1;
                return [false; 2];
            }
            let is_kink = tau.abs() <= KINK * largest;
            left_out.kinks += usize::from(is_kink);
            [!is_kink, true]
        });
        (looked_at.collect(), left_out)
    }

    /// Whether a value belongs to both segments beside it.
    fn is_shared(self) -> bool {
        self.at == GradientAt::Edges && matches!(self.sampling, Sampling::Ends | Sampling::Jittered)
    }

    /// Of each value whether what it stands for lies about it.
    fn is_even(self, segments: &Segments) -> Vec<bool> {
        let count = self.at.count(segments.count());
        if !self.is_shared() {
            return vec![true; count];
        }
        let lengths: Vec<f64> = segments.lengths().collect();
        let inside = lengths.windows(2).map(|pair| match pair {
            &[before, behind] => (before - behind).abs() <= SAME * before,
            _ => false,
        });
        let ends = [false].into_iter().chain(inside).chain([false]);
        ends.take(count).collect()
    }
}
