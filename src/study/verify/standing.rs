//! What a channel says of a kernel.

use super::line::{Failure, Line, Measured};
use crate::convergence::Verdict;
use crate::method::Expected;
use std::fmt;

/// What a channel says of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Standing {
    /// The order is the one expected.
    Confirmed,
    /// It is not.
    Contradicted,
    /// The ladder, the format or the case cannot tell.
    Inconclusive,
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
    /// [`Standing::Blind`].
    pub blind: usize,
    /// [`Standing::Failed`].
    pub failed: usize,
}

impl Counts {
    pub(super) fn of(lines: &[Line]) -> Counts {
        let mut counts = Counts::default();
        for line in lines {
            let count = match line.standing {
                Standing::Confirmed => &mut counts.confirmed,
                Standing::Contradicted => &mut counts.contradicted,
                Standing::Inconclusive => &mut counts.inconclusive,
                Standing::Blind => &mut counts.blind,
                Standing::Failed => &mut counts.failed,
            };
            *count += 1;
        }
        counts
    }
}

/// What a standing rests on.
pub(super) struct Judged<'a> {
    pub(super) measured: &'a Measured,
    pub(super) expected: Option<Expected>,
    pub(super) failures: &'a [Failure],
    /// The verdict on the declared method itself, run exactly on the same levels.
    pub(super) of_method: Option<Verdict>,
    /// Whether the declared method, if there is one, has a value at every level in the declared format.
    pub(super) in_range: bool,
    pub(super) steady: bool,
}

/// A kernel is measured by what its declared method itself shows on the same levels: where that is not confirmed,
/// the ladder is too short or the case too hard for any kernel, and only what is worse than the method counts.
pub(super) fn of(judged: &Judged<'_>) -> Standing {
    let verdict = judged.measured.verdict();
    if !judged.failures.is_empty() {
        return Standing::Failed;
    }
    if !judged.steady {
        return Standing::Contradicted;
    }
    if verdict == Verdict::NotFinite {
        // Nobody has a number where the format ends.
        return if judged.in_range {
            Standing::Contradicted
        } else {
            Standing::Inconclusive
        };
    }
    if verdict.passes(judged.expected) {
        return Standing::Confirmed;
    }
    let does_not_converge = matches!(verdict, Verdict::Diverged | Verdict::Stalled);
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
        None => is_order && misses,
    };
    if contradicts {
        Standing::Contradicted
    } else {
        Standing::Inconclusive
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convergence::{Sample, fit};
    use rug::Float;

    /// Errors of that order on seven levels, with a part that does not converge.
    fn measured(order: f64, rest: f64, expected: Expected) -> Measured {
        let sample = |level: i32| {
            let step = 0.5_f64.powi(level);
            Sample {
                n: None,
                step,
                error: Float::with_val(53, step.powf(order) + rest),
                floor: Float::with_val(53, 1e-16),
            }
        };
        let samples: Vec<Sample> = (3..10).map(sample).collect();
        let fit = Box::new(fit(&samples, Some(expected)).unwrap());
        Measured::Fitted { fit, samples }
    }

    fn standing(measured: &Measured, expected: Expected, of_method: Option<Verdict>) -> Standing {
        of(&Judged {
            measured,
            expected: Some(expected),
            failures: &[],
            of_method,
            in_range: true,
            steady: true,
        })
    }

    #[test]
    fn a_blind_case_still_tells_what_does_not_converge() {
        let blind = Expected::Blind {
            general: 1.0,
            here: 2.0,
        };
        let fine = measured(2.0, 0.0, blind);
        assert_eq!(
            standing(&fine, blind, Some(Verdict::Blind)),
            Standing::Blind
        );
        let too_bright = measured(2.0, 0.1, blind);
        assert_eq!(too_bright.verdict(), Verdict::Stalled);
        let contradicted = standing(&too_bright, blind, Some(Verdict::Blind));
        assert_eq!(contradicted, Standing::Contradicted);
        // Where the method itself stalls there, nobody does better.
        let as_the_method = standing(&too_bright, blind, Some(Verdict::Stalled));
        assert_eq!(as_the_method, Standing::Blind);
    }

    #[test]
    fn what_the_method_cannot_show_is_not_asked_of_a_kernel() {
        let second = Expected::Order(2.0);
        let first = measured(1.0, 0.0, second);
        assert_eq!(first.verdict(), Verdict::TooLow);
        for (of_method, says) in [
            (Some(Verdict::Confirmed), Standing::Contradicted),
            (Some(Verdict::PreAsymptotic), Standing::Inconclusive),
            (None, Standing::Contradicted),
        ] {
            assert_eq!(standing(&first, second, of_method), says);
        }
        // Of a claim alone an order may be higher here or there.
        let third = measured(3.0, 0.0, second);
        assert_eq!(third.verdict(), Verdict::TooHigh);
        assert_eq!(standing(&third, second, None), Standing::Inconclusive);
        let confirmed = Some(Verdict::Confirmed);
        assert_eq!(standing(&third, second, confirmed), Standing::Contradicted);
    }
}
