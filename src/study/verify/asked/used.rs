//! How a ray was really cut, and what a kernel saw there.

use super::{Asked, Level};
use crate::kernel::{Cut, CutError, Rendering, Segments, Table};
use crate::study::verify::{Axis, VerifyError};
use rug::Rational;

impl Asked<'_> {
    /// How the ray was cut, by what the kernel says or else as asked.
    pub(super) fn used(&self, level: &Level, rendering: &Rendering) -> Cut {
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
    pub(super) fn segments(&self, level: &Level, cut: Cut) -> Result<Segments, VerifyError> {
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
