//! A ray that is asked once more at the end: what a kernel has kept of others shows.

use super::{Terms, compare, of_places};
use crate::identify::ray::Ray;
use crate::identify::rule::Rule;
use crate::identify::session::Session;
use crate::identify::state::is_same;

/// A ray with its answers.
type Answered = (Ray, Vec<f64>);

/// What is asked again.
#[derive(Default)]
pub(super) struct Told {
    /// The first with gaps, of which an occupancy that is kept remembers something.
    first: Option<Answered>,
    /// The one that is farthest from what is right, with its digits: whatever is named shows on it.
    worst: Option<(f64, Answered)>,
}

impl Told {
    pub(super) fn hear(
        &mut self,
        rule: &Rule,
        terms: &Terms<'_>,
        ray: &Ray,
        got: &[f64],
        has_gaps: bool,
    ) {
        let answered = || (ray.clone(), got.to_vec());
        if has_gaps || terms.no_vacuum {
            self.first.get_or_insert_with(answered);
        }
        let Some(right) = terms.right else { return };
        let (segments, step) = rule.cut(ray);
        let all = compare(
            right,
            &of_places(right, terms.answers),
            &segments,
            step,
            got,
        );
        let digits = all.iter().map(|one| one.digits).fold(17.0, f64::min);
        if self.worst.as_ref().is_none_or(|(worst, _)| digits < *worst) {
            self.worst = Some((digits, answered()));
        }
    }

    /// Whether one has another answer by now; or, where something is to be named, of a kernel that was started anew.
    pub(super) fn changes(self, session: &mut Session<'_>) -> bool {
        let asked = match self.worst {
            Some((_, worst)) => {
                session.restart();
                Some(worst)
            }
            None => self.first,
        };
        asked.is_some_and(|(ray, before)| {
            let again = session.ask_any(&ray);
            again.is_ok_and(|again| !is_same(&before, &again))
        })
    }
}
