//! How a ray is cut into segments.

use super::Spacing;
use crate::case::nodes::grid::Grid;
use crate::real::{Format, Native};
use rug::Rational;

/// The most segments that one task may have: their values are written out.
pub const MAX_TASK_SEGMENTS: u64 = 1 << 20;

/// One level of refinement along the ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cut {
    /// That many segments of the same length.
    Segments(u64),
    /// Segments of that length, the last one shorter where it does not divide the ray.
    Step(f64),
    /// That many segments of uneven lengths; d is D/n, their mean.
    Spaced(u64, Spacing),
}

/// Where a ray that is cut is looked at.
pub(super) struct Places {
    /// The ends of segments, from the eye on.
    pub(super) edges: Vec<f64>,
    /// The middles of segments.
    pub(super) middles: Vec<f64>,
}

impl Places {
    /// Those of segments with these ends.
    pub(super) fn of(edges: Vec<f64>) -> Places {
        let middles = edges.windows(2).map(|ends| f64::midpoint(ends[0], ends[1]));
        Places {
            middles: middles.collect(),
            edges,
        }
    }
}

/// A level that no task can have.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CutError {
    /// Too few or too many segments.
    #[error("{segments} segments (allowed: 1 to {MAX_TASK_SEGMENTS})")]
    Segments {
        /// How many.
        segments: f64,
    },
    /// No length of a segment.
    #[error("a step of {step} (allowed: finite, above 0)")]
    Step {
        /// The step.
        step: f64,
    },
}

impl Cut {
    /// (d, n) on a ray of that length.
    ///
    /// # Errors
    /// [`CutError`] where there would be no segments, or more than [`MAX_TASK_SEGMENTS`].
    pub fn on(self, length: &Rational) -> Result<(Rational, u64), CutError> {
        let (step, segments) = match self {
            Cut::Segments(n) | Cut::Spaced(n, _) => {
                if n == 0 {
                    return Err(CutError::Segments { segments: 0.0 });
                }
                (Rational::from(length / n), n)
            }
            Cut::Step(step) => {
                let exact = Rational::from_f64(step)
                    .filter(|exact| *exact > 0)
                    .ok_or(CutError::Step { step })?;
                let count = Rational::from(length / &exact).ceil();
                let segments = count.numer().to_u64().unwrap_or(u64::MAX);
                (exact, segments)
            }
        };
        if segments > MAX_TASK_SEGMENTS {
            let segments = segments as f64;
            return Err(CutError::Segments { segments });
        }
        Ok((step, segments))
    }

    /// The ends and the middles of the segments of a ray of that length, each rounded once.
    ///
    /// # Errors
    /// As [`Cut::on`].
    pub(super) fn places(self, length: &Rational) -> Result<Places, CutError> {
        let (step, count) = self.on(length)?;
        let format = Native::<f64>::new();
        if let Cut::Spaced(n, spacing) = self {
            return Ok(Places::of(spacing.edges(n, format.ratio(length))));
        }
        let grid = match self {
            Cut::Segments(_) => Grid::new(length, 2 * count, &Rational::new()),
            Cut::Step(_) | Cut::Spaced(..) => None,
        };
        let edge = |i: u64| {
            if i == count {
                length.clone()
            } else {
                Rational::from(&step * i)
            }
        };
        let at_half_steps = |half_steps: u64| match &grid {
            Some(grid) => {
                let (numerator, denominator) = grid.place(half_steps);
                format.fraction(numerator, denominator)
            }
            None if half_steps.is_multiple_of(2) => format.ratio(&edge(half_steps / 2)),
            // The last segment may be shorter.
            None => {
                let i = half_steps / 2;
                format.ratio(&((edge(i) + edge(i + 1)) / 2_u32))
            }
        };
        Ok(Places {
            edges: (0..=count).map(|i| at_half_steps(2 * i)).collect(),
            middles: (0..count).map(|i| at_half_steps(2 * i + 1)).collect(),
        })
    }
}
