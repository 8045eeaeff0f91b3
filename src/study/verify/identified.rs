//! What a kernel computes, beside the values that the ladder has of it: these are a hold-out at no cost.

use super::accept::{Acceptance, Accepted, acceptance};
use super::{Line, Settings};
use crate::identify::rule::Rule;
use crate::identify::{Budget, Deviation, Examined, Seen, Spent, examine_for};
use crate::kernel::{FormKind, Kernel, Quantity, Segments, Subject};
use crate::study::Progress;
use rug::Rational;
use std::time::Duration;

/// Whether it is read off what a kernel computes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Identify {
    /// With no more rays than the ladder itself has.
    #[default]
    Auto,
    /// With as many as `volver identify` asks at most.
    Full,
    /// No.
    Off,
}

impl Identify {
    const ALL: [Identify; 3] = [Identify::Auto, Identify::Full, Identify::Off];

    /// As on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Identify::Auto => "auto",
            Identify::Full => "full",
            Identify::Off => "off",
        }
    }

    /// The one of that name.
    #[must_use]
    pub fn of_name(name: &str) -> Option<Self> {
        Identify::ALL.into_iter().find(|one| one.name() == name)
    }
}

/// So many rays may be asked however short the ladder is.
const FEWEST_RAYS: u64 = 150;
/// And so much time may be taken however fast the kernel is.
const SHORTEST: Duration = Duration::from_secs(60);

/// What was read off, and what the ladder says of it.
#[derive(Clone, Debug)]
pub struct Identified {
    /// What was read off, with the smallest ray that shows a deviation.
    pub examined: Examined,
    /// Channels of the ladder that the rule was compared with.
    pub compared: usize,
    /// Those of them in which the answers are not the rule's.
    pub differs: Vec<String>,
}

impl Identified {
    /// The rule, where it holds on rays of every kind and in most channels of the ladder.
    #[must_use]
    pub fn named(&self) -> Option<&Rule> {
        let is_most = 2 * self.differs.len() <= self.compared;
        self.examined.found.named().filter(|_| is_most)
    }

    /// In so many channels of the ladder the answers are the rule's.
    #[must_use]
    pub fn agrees(&self) -> usize {
        self.compared - self.differs.len()
    }

    /// Every deviation, and whether it is accepted.
    pub fn deviations<'a>(
        &'a self,
        accepted: &'a [Accepted],
    ) -> impl Iterator<Item = (&'a Deviation, Acceptance)> {
        let all = self.examined.deviations.iter();
        all.map(|deviation| (deviation, acceptance(accepted, deviation)))
    }

    /// Whether anything speaks against the kernel that is not accepted.
    #[must_use]
    pub fn speaks_against(&self, accepted: &[Accepted]) -> bool {
        let mut all = self.deviations(accepted);
        !self.differs.is_empty() || all.any(|(_, how)| how != Acceptance::Accepted)
    }
}

/// The answers of a case at one level.
pub(super) struct SeenLevel {
    pub(super) segments: Segments,
    pub(super) step: f64,
    /// By channel.
    pub(super) answers: Vec<f64>,
}

/// What a ladder has cost, and what was answered to it.
pub(super) struct Ladder<'a> {
    pub(super) subjects: &'a [Subject],
    /// By case; none of a case that says nothing.
    pub(super) levels: Vec<Vec<SeenLevel>>,
    pub(super) rays: u64,
    pub(super) took: Duration,
}

/// Reads off what a kernel computes that has answered so many rays, in such a time where that is known.
pub(super) fn examined(
    kernel: &mut dyn Kernel,
    settings: &Settings,
    rays: u64,
    took: Option<Duration>,
    progress: &dyn Progress,
) -> Examined {
    // What comes next has nothing to do with what has failed.
    kernel.renew();
    let usual = Budget::default();
    let budget = match settings.identify {
        Identify::Full => usual,
        Identify::Auto | Identify::Off => Budget {
            rays: rays.clamp(FEWEST_RAYS, usual.rays),
            time: took.map_or(Duration::MAX, |took| took.max(SHORTEST)),
            ..usual
        },
    };
    let mut before = 0;
    let claimed = settings.expect.as_ref().map(Rational::to_f64);
    let claimed = claimed.or(kernel.declaration().order);
    examine_for(kernel, claimed, budget, &mut |spent: &Spent| {
        // The search for a witness has its own count.
        progress.advance(spent.segments.saturating_sub(before));
        before = spent.segments;
    })
}

/// Reads off what a kernel computes that has answered such a ladder.
pub(super) fn identified(
    kernel: &mut dyn Kernel,
    settings: &Settings,
    ladder: &Ladder<'_>,
    lines: &[Line],
    progress: &dyn Progress,
) -> Identified {
    let took = Some(ladder.took);
    let mut examined = examined(kernel, settings, ladder.rays, took, progress);
    let evaluates = match examined.declaration.form {
        FormKind::Function | FormKind::Formula(_) => true,
        FormKind::Segments | FormKind::Volume => false,
    };
    let (mut compared, mut differs) = (0, Vec::new());
    let mut lines = lines
        .iter()
        .filter(|line| line.quantity == Quantity::Radiance);
    for (subject, levels) in ladder.subjects.iter().zip(&ladder.levels) {
        let mut agrees: Option<Vec<bool>> = None;
        for level in levels {
            let of_level = examined.found.agrees(&Seen {
                medium: evaluates.then_some(subject),
                segments: &level.segments,
                step: level.step,
                answers: &level.answers,
            });
            agrees = match (agrees, of_level) {
                (Some(all), Some(one)) => Some(all.iter().zip(one).map(|(a, b)| *a && b).collect()),
                (all, one) => all.or(one),
            };
        }
        let of_channels: Vec<&Line> = lines.by_ref().take(subject.channels().len()).collect();
        for (line, agrees) in of_channels.into_iter().zip(agrees.into_iter().flatten()) {
            if line.is_complete() && line.steady {
                compared += 1;
                if !agrees {
                    differs.push(line.name.clone());
                }
            }
        }
    }
    // Probes are linear between the places that they are made for: they do not show that a kernel looks elsewhere.
    if evaluates && 2 * differs.len() > compared {
        examined
            .withdraw("a rule that holds on probes does not on the ladder: samples lie elsewhere");
        (compared, differs) = (0, Vec::new());
    }
    Identified {
        examined,
        compared,
        differs,
    }
}
