//! Cases that a kernel is not asked, since it declares that it does not take them.

use super::{Finding, GRID_SEGMENTS, Settings};
use crate::kernel::{Cut, Declaration, Segments, Subject};

/// The subjects that are asked, and the names of the others: of a kernel that takes no negative emission those that have
/// some, where it would be sampled or at any of many places.
pub(super) fn sorted(
    subjects: Vec<Subject>,
    declaration: &Declaration,
    settings: &Settings,
) -> (Vec<Subject>, Vec<String>) {
    if !declaration.positive_emission {
        return (subjects, Vec::new());
    }
    let (left_out, asked): (Vec<Subject>, Vec<Subject>) = subjects
        .into_iter()
        .partition(|subject| has_negative(subject, declaration, settings));
    let names = left_out.iter().map(|subject| subject.name().into());
    (asked, names.collect())
}

fn has_negative(subject: &Subject, declaration: &Declaration, settings: &Settings) -> bool {
    let length = subject.length();
    let levels = settings.cuts(length).into_iter();
    let mut cuts = levels
        .chain(settings.spots(length, declaration))
        .chain([Cut::Segments(GRID_SEGMENTS)]);
    // A ray that cannot be cut so is refused when it is asked.
    cuts.any(|cut| {
        let segments = subject.segments(cut);
        segments.is_ok_and(|segments| is_negative_somewhere(&segments))
    })
}

fn is_negative_somewhere(segments: &Segments) -> bool {
    let all = [&segments.edges, &segments.middles].into_iter();
    let mut emission = all.flat_map(|samples| samples.emission.iter().flatten());
    emission.any(|c| *c < 0.0)
}

/// That they were.
pub(super) fn finding(names: &[String]) -> Option<Finding> {
    let words = match names.len() {
        0 => return None,
        1 => "1 case left out, of negative emission, which the kernel declares not to take".into(),
        count => format!(
            "{count} cases left out, of negative emission, which the kernel declares not to take"
        ),
    };
    Some(Finding {
        words,
        channels: names.to_vec(),
        wrong: false,
    })
}
