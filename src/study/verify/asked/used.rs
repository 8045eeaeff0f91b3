//! How a ray was really cut, and what a kernel saw there.

use super::{Asked, Level};
use crate::kernel::{Cut, CutError, Rendering, Segments, Table};
use crate::real::{Format, Native};
use crate::study::verify::{Axis, VerifyError};
use rug::Rational;

/// A level as it was rendered.
pub(super) struct Used {
    pub(super) segments: Segments,
    /// n.
    pub(super) count: u64,
    /// d, or the mean length where segments are uneven: the largest of random lengths scatters.
    pub(super) step: f64,
    /// Whether all segments have one length.
    pub(super) is_uniform: bool,
    /// Whether the kernel chose where they end.
    pub(super) is_adaptive: bool,
}

impl Asked<'_> {
    /// The segments that were used, by what the kernel says or else as asked.
    pub(super) fn used(
        &self,
        level: &Level,
        rendering: Option<&Rendering>,
    ) -> Result<Used, VerifyError> {
        if let Some(edges) = rendering.and_then(|rendering| rendering.edges.as_ref()) {
            let length = self.subject.length();
            // Rounding may take the outermost off the ray.
            let end = Native::<f64>::new().ratio(length);
            let edges = edges.iter().map(|edge| edge.clamp(0.0, end)).collect();
            let segments = match &level.volume {
                Some(volume) => volume.segments_between(edges, length, Table::at),
                None => self.subject.segments_between(edges),
            };
            let count = segments.count() as u64;
            return Ok(Used {
                step: Rational::from(length / count.max(1)).to_f64(),
                segments,
                count,
                is_uniform: false,
                is_adaptive: true,
            });
        }
        let cut = rendering.map_or(level.cut, |rendering| self.cut(level, rendering));
        // Refused already, where the ray cannot be cut so.
        let on = cut.on(self.subject.length());
        let (step, count) = on.map_err(|error| self.cut_error(error))?;
        Ok(Used {
            segments: self.segments(level, cut)?,
            count,
            step: step.to_f64(),
            is_uniform: matches!(cut, Cut::Segments(_)),
            is_adaptive: false,
        })
    }

    /// How the ray was cut, by what the kernel says or else as asked.
    pub(super) fn cut(&self, level: &Level, rendering: &Rendering) -> Cut {
        if let Some(segments) = rendering.segments {
            return Cut::Segments(segments);
        }
        let Some(step) = rendering.step else {
            return level.cut;
        };
        let count = (self.subject.length().to_f64() / step).round();
        let even = (count * step / self.subject.length().to_f64() - 1.0).abs() < 1e-12;
        // The quotient of two positive numbers; too large ones are refused when the ray is cut.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        if even && count >= 1.0 {
            Cut::Segments(count as u64)
        } else {
            Cut::Step(step)
        }
    }

    /// The samples of one level, as the kernel saw or might have seen them.
    fn segments(&self, level: &Level, cut: Cut) -> Result<Segments, VerifyError> {
        if let Some(given) = level.segments.as_ref().filter(|_| cut == level.cut) {
            return Ok(given.clone());
        }
        let length = self.subject.length();
        let segments = match &level.volume {
            Some(volume) => volume.segments(length, cut, Table::at),
            None => self.subject.segments(cut),
        };
        segments.map_err(|error| self.cut_error(error))
    }

    pub(super) fn cut_error(&self, error: CutError) -> VerifyError {
        VerifyError::Cut {
            case: self.subject.name().into(),
            error,
        }
    }

    /// n and d of a level: of the ray, or of the grid.
    pub(super) fn coordinate(&self, level: &Level, segments: u64, step: f64) -> (Option<u64>, f64) {
        match (self.settings.axis, &level.volume) {
            (Axis::Grid, Some(volume)) => {
                let cells = volume.cells() as u64;
                let width = Rational::from(self.subject.length() / cells.max(1));
                (Some(cells), width.to_f64())
            }
            _ => (Some(segments), step),
        }
    }
}
