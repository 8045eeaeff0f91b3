//! What a channel says of a kernel.

use super::line::{Failure, Line, Measured};
use crate::convergence::{ReportedError, Verdict};
use crate::method::Expected;
use std::fmt;

/// What a channel says of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Standing {
    /// The order is the one expected.
    Confirmed,
    /// It is not.
    Contradicted,
    /// What was measured cannot tell, although methods of that order, or nobody, could be asked what they show.
    Inconclusive,
    /// The ladder, the format or the case cannot tell: no method of that order shows it there.
    Unresolved,
    /// The case hides the leading error of what was declared.
    Blind,
    /// Levels were not answered.
    Failed,
}

impl Standing {
    /// The standing's name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Standing::Confirmed => "confirmed",
            Standing::Contradicted => "contradicted",
            Standing::Inconclusive => "inconclusive",
            Standing::Unresolved => "unresolved",
            Standing::Blind => "blind",
            Standing::Failed => "failed",
        }
    }
}

impl fmt::Display for Standing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// How many channels stand how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// [`Standing::Confirmed`].
    pub confirmed: usize,
    /// [`Standing::Contradicted`].
    pub contradicted: usize,
    /// [`Standing::Inconclusive`].
    pub inconclusive: usize,
    /// [`Standing::Unresolved`].
    pub unresolved: usize,
    /// [`Standing::Blind`].
    pub blind: usize,
    /// [`Standing::Failed`].
    pub failed: usize,
}

impl Counts {
    pub(super) fn of<'a>(lines: impl Iterator<Item = &'a Line>) -> Counts {
        let mut counts = Counts::default();
        for line in lines {
            let count = match line.standing {
                Standing::Confirmed => &mut counts.confirmed,
                Standing::Contradicted => &mut counts.contradicted,
                Standing::Inconclusive => &mut counts.inconclusive,
                Standing::Unresolved => &mut counts.unresolved,
                Standing::Blind => &mut counts.blind,
                Standing::Failed => &mut counts.failed,
            };
            *count += 1;
        }
        counts
    }
}

/// What a standing rests on.
pub struct Judged<'a> {
    /// The order that was measured.
    pub measured: &'a Measured,
    /// The order that was expected.
    pub expected: Option<Expected>,
    /// The levels that were not answered.
    pub failures: &'a [Failure],
    /// The verdict on the declared method itself, run exactly on the same levels.
    pub of_method: Option<Verdict>,
    /// Those on methods of the declared order where no method is, run in the declared format on the same levels.
    pub of_order: &'a [Verdict],
    /// Whether the declared method, exactly and in the declared format, or any of the declared order is confirmed on these
    /// levels; `None` where there is no method to ask.
    pub resolvable: Option<bool>,
    /// Whether the declared method, if there is one, has a value at every level in the declared format.
    pub in_range: bool,
    /// Whether answers to the same request are the same, and nothing is visibly wrong with any, whatever the order is.
    pub sound: bool,
    /// Whether samples in the middles of segments find their order on these levels, as far as that is known.
    pub resolved: bool,
    /// Standard errors that the kernel reported.
    pub reported: Option<ReportedError>,
}

/// Verdicts on errors that do not converge.
const DOES_NOT: [Verdict; 2] = [Verdict::Diverged, Verdict::Stalled];

/// A kernel is measured by what its declared method itself shows on the same levels: where that is not confirmed,
/// the ladder is too short or the case too hard for any kernel, and only what is worse than the method counts.
#[must_use]
pub fn of(judged: &Judged<'_>) -> Standing {
    let verdict = judged.measured.verdict();
    if !judged.failures.is_empty() {
        return Standing::Failed;
    }
    let misreports = judged.reported.as_ref();
    if !judged.sound || misreports.is_some_and(ReportedError::is_wrong) {
        return Standing::Contradicted;
    }
    if verdict == Verdict::NotFinite {
        // Nobody has a number where the format ends.
        return if judged.in_range {
            Standing::Contradicted
        } else {
            Standing::Unresolved
        };
    }
    if verdict.passes(judged.expected) {
        return Standing::Confirmed;
    }
    let does_not_converge = DOES_NOT.contains(&verdict);
    if matches!(judged.expected, Some(Expected::Blind { .. })) {
        // Whatever the order is that a case hides, its method converges there.
        let worse = does_not_converge && judged.of_method != Some(verdict);
        return if worse {
            Standing::Contradicted
        } else {
            Standing::Blind
        };
    }
    let is_order = matches!(judged.expected, Some(Expected::Order(_) | Expected::Exact));
    let misses = verdict == Verdict::TooLow || does_not_converge;
    let contradicts = match judged.of_method {
        Some(of_method) if of_method.passes(judged.expected) => {
            misses || matches!(verdict, Verdict::TooHigh | Verdict::Oscillatory)
        }
        Some(of_method) => does_not_converge && verdict != of_method,
        // Of an order alone nobody knows on which cases it is higher.
        // And in a format in which all of its methods show the same, nobody does better.
        None if is_order => {
            let same = |of_order: &Verdict| *of_order == verdict;
            let as_all = !judged.of_order.is_empty() && judged.of_order.iter().all(same);
            misses && judged.resolved && !as_all
        }
        // Whatever the order is, methods converge.
        None => {
            let converges = |verdict: &Verdict| !DOES_NOT.contains(verdict);
            does_not_converge
                && !judged.of_order.is_empty()
                && judged.of_order.iter().all(converges)
        }
    };
    // What was not refined is the kernel's.
    let is_ladder = verdict != Verdict::TooFewLevels;
    let unresolved = judged.resolvable == Some(false) || !judged.resolved;
    if contradicts {
        Standing::Contradicted
    } else if unresolved && is_ladder && judged.expected.is_some() {
        Standing::Unresolved
    } else {
        Standing::Inconclusive
    }
}
