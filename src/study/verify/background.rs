//! What is behind the rays of a kernel that takes a background.

use super::{Axis, Settings};
use crate::kernel::{Declaration, Subject, SubjectError};

/// The radiance behind the first channel, and by how much those behind the next are brighter: others for every channel, so
/// that none is taken for another, and none of 1.
const FIRST: f64 = 0.5;
const NEXT: f64 = 0.25;

/// The subjects before their own background, or one for all that have none; before nothing where a kernel takes none, and
/// over grids, where the medium is what is refined.
pub(in crate::study) fn before(
    subjects: &[Subject],
    declaration: &Declaration,
    settings: &Settings,
) -> Result<Vec<Subject>, SubjectError> {
    let is_given = declaration.background && settings.axis == Axis::Step;
    let before = |subject: &Subject| {
        let subject = subject.clone();
        if !is_given {
            return Ok(subject.before_nothing());
        }
        if !subject.background().is_empty() {
            return Ok(subject);
        }
        let channels = 0..subject.channels().len();
        let background = channels.map(|channel| FIRST + NEXT * channel as f64);
        subject.before(background.collect())
    };
    subjects.iter().map(before).collect()
}
