//! How a ray is cut into segments.

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
            Cut::Segments(n) => {
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
}
