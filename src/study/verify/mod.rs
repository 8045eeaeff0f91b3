//! A kernel put to the test: its orders on cases with known radiance, and what its values say it computes.

mod accept;
#[cfg(feature = "studies")]
pub mod apart;
mod asked;
mod background;
#[cfg(feature = "studies")]
mod baseline;
mod beyond;
mod error;
mod expectation;
mod explain;
mod identified;
mod left_out;
mod line;
mod nominal;
pub(crate) mod of_order;
mod peer;
mod peers;
mod prepared;
mod remark;
mod scattered;
mod seeds;
mod settings;
pub(crate) mod standing;
mod truth;

#[cfg(feature = "studies")]
pub(in crate::study) use background::before;
#[cfg(feature = "studies")]
pub(in crate::study) use truth::wall_opacity;

pub use accept::{Acceptance, Accepted, AcceptedError};
#[cfg(feature = "studies")]
pub use baseline::{Baseline, BaselineDeviation, BaselineError, BaselineLine, BaselinePart, Moved};
pub use beyond::{Beyond, TakesOver};
pub use error::VerifyError;
pub use explain::Finding;
pub use identified::{Identified, Identify};
pub use line::{Failure, Line, Measured};
pub use remark::Remark;
pub use settings::{
    Axis, GRID_SEGMENTS, MAX_REPLICAS, REPLICAS, Settings, SettingsError, Steps, TABLE_ENTRIES,
};
pub use standing::{Counts, Standing};

use super::Progress;
use crate::convergence::Verdict;
use crate::identify::{OPACITY_ANSWERED, Spent, Together, together};
use crate::kernel::{Declaration, Kernel, Quantity, Subject};
use identified::{Ladder, identified};
use prepared::Prepared;
use seeds::Seeds;
use std::time::Instant;

/// A kernel that answers nothing on one case may answer on the next; on so many in a row, it does not.
const UNANSWERED_CASES: u32 = 3;

/// So many channels may fail to show an order that methods of that order show there: their leading errors are others.
pub const MISSING: usize = 2;

/// What came out.
#[derive(Clone, Debug)]
pub struct Verification {
    /// What the kernel says of itself.
    pub declaration: Declaration,
    /// How it was tested.
    pub settings: Settings,
    /// In the order of the cases: one a channel, and one for every other quantity that was answered.
    pub lines: Vec<Line>,
    /// What it computes; `None` where that was not to be read off, along the grid, or where there is no radiance.
    pub identification: Option<Identified>,
    /// Many rays in one request; `None` where that was not to be seen.
    pub together: Option<Together>,
    /// What else was found, with the channels that show it.
    pub findings: Vec<Finding>,
    /// Cases that were not asked, since the kernel declares that it does not take them.
    pub left_out: Vec<String>,
    /// So many seeds had answers of their own; `None` for a deterministic kernel.
    pub different_seeds: Option<usize>,
}

/// What a verification says in all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Conclusion {
    /// Orders are confirmed, none is contradicted, and the values are those of the declared method.
    Confirmed,
    /// Something contradicts, fails, or nothing is confirmed.
    NotConfirmed,
    /// No level of any case could be rendered.
    CouldNotRun,
}

impl Verification {
    /// How many channels stand how.
    #[must_use]
    pub fn counts(&self) -> Counts {
        Counts::of(self.lines.iter())
    }

    /// How many lines of one quantity stand how.
    #[must_use]
    pub fn counts_of(&self, quantity: Quantity) -> Counts {
        Counts::of(self.of(quantity))
    }

    /// The quantities that were measured, as they are reported; the first is the one that rows are printed of.
    #[must_use]
    pub fn quantities(&self) -> Vec<Quantity> {
        let is_there = |quantity: &Quantity| self.of(*quantity).next().is_some();
        Quantity::MEASURED.into_iter().filter(is_there).collect()
    }

    /// The lines of one quantity.
    pub fn of(&self, quantity: Quantity) -> impl Iterator<Item = &Line> {
        let lines = self.lines.iter();
        lines.filter(move |line| line.quantity == quantity)
    }

    /// Quantities beside the first that are not shown to be right: with a channel confirmed, or none worse than methods are,
    /// and no more missing than may be.
    #[must_use]
    pub fn not_shown(&self) -> Vec<Quantity> {
        let others = self.quantities().into_iter().skip(1);
        // What comes without a word promises nothing; what is wrong with it contradicts.
        let counted = others
            .filter(|quantity| self.declaration.has(*quantity) && !self.is_accepted(*quantity));
        let is_shown = |quantity: &Quantity| {
            let mut lines = self.of(*quantity);
            let shows = lines.any(Line::is_shown);
            shows && missing(self.of(*quantity)) <= MISSING
        };
        counted.filter(|quantity| !is_shown(quantity)).collect()
    }

    /// Whether what is wrong with a quantity is a deviation that is accepted.
    #[must_use]
    pub fn is_accepted(&self, quantity: Quantity) -> bool {
        let accepted = &self.settings.accept;
        let found = self.identification.iter();
        let mut deviations = found.flat_map(|found| found.deviations(accepted));
        quantity == Quantity::Opacity
            && deviations.any(|(deviation, how)| {
                deviation.name == OPACITY_ANSWERED && how == Acceptance::Accepted
            })
    }

    /// Whether orders are those of a method that is declared, and not of an order alone.
    #[must_use]
    pub fn is_of_method(&self) -> bool {
        self.settings.expect.is_none() && self.declaration.method.is_some()
    }

    /// Whether answers are multiples of a quantum that no order is seen through, and right to one wherever methods are.
    #[must_use]
    pub fn is_right_to_quantum(&self) -> bool {
        let mut right = self
            .lines
            .iter()
            .filter_map(|line| line.right_to_quantum)
            .peekable();
        right.peek().is_some() && right.all(|right| right)
    }

    /// How many channels are not confirmed although the declared method, or every method of the declared order, is, and
    /// have larger errors than these: what is better than promised has no order that was.
    #[must_use]
    pub fn missing(&self) -> usize {
        let first = self.quantities().first().copied();
        first.map_or(0, |quantity| missing(self.of(quantity)))
    }

    /// Whether a kernel that says it draws random numbers has the same answers to several seeds, and errors in them.
    #[must_use]
    pub fn seeds_repeat(&self) -> bool {
        let repeat = self
            .different_seeds
            .is_some_and(|different| different < self.settings.replicas);
        let errs = |line: &Line| line.measured.verdict() != Verdict::Exact;
        repeat && self.lines.iter().any(errs)
    }

    /// In how many channels the values are those of the declared method, and of how many; `None` where there is nothing to
    /// compare.
    #[must_use]
    pub fn as_declared(&self) -> Option<(usize, usize)> {
        let compared = self.lines.iter().filter_map(|line| line.as_declared);
        let (agree, of) = compared.fold((0, 0), |(agree, of), as_declared| {
            (agree + usize::from(as_declared), of + 1)
        });
        (of > 0).then_some((agree, of))
    }

    /// Whether a method is declared and the values are not its.
    #[must_use]
    pub fn contradicts_declaration(&self) -> bool {
        self.as_declared().is_some_and(|(agree, of)| agree < of)
    }

    /// Whether what it computes speaks against it, but for what is accepted.
    #[must_use]
    pub fn deviates(&self) -> bool {
        let identified = self.identification.as_ref();
        identified.is_some_and(|identified| identified.speaks_against(&self.settings.accept))
            || self.depends_on_others()
    }

    /// Whether rays of one request have other answers than alone, but for what is accepted.
    #[must_use]
    pub fn depends_on_others(&self) -> bool {
        let how = self.acceptance_of_batch();
        how.is_some_and(|how| how != Acceptance::Accepted)
    }

    /// Whether that is accepted; `None` where no ray has another answer, or it was not to be seen.
    #[must_use]
    pub fn acceptance_of_batch(&self) -> Option<Acceptance> {
        let differ = self.together.as_ref().filter(|found| found.differ > 0)?;
        let accepted = &self.settings.accept;
        let deviation = differ.deviation.as_ref();
        Some(deviation.map_or(Acceptance::Unknown, |one| accept::acceptance(accepted, one)))
    }

    /// Whether there are deviations that are all accepted, from which the values follow.
    #[must_use]
    pub fn is_explained(&self) -> bool {
        let accepted = &self.settings.accept;
        self.identification.as_ref().is_some_and(|identified| {
            let has_any = !identified.examined.deviations.is_empty();
            has_any && identified.named().is_some() && !identified.speaks_against(accepted)
        })
    }

    /// What it says in all.
    #[must_use]
    pub fn conclusion(&self) -> Conclusion {
        let first = self.quantities().first().copied();
        let counted = self.lines.iter();
        let counts = Counts::of(counted.filter(|line| !self.is_accepted(line.quantity)));
        let contradicts = self.contradicts_declaration() && !self.is_explained();
        let deviates = contradicts || self.deviates();
        let failed = counts.failed + counts.contradicted > 0;
        // A case may hide an error, but not most of them: then the order is a higher one.
        // What is answered beside the first quantity may well be better than that.
        let of_first: Vec<&Line> = self
            .lines
            .iter()
            .filter(|line| Some(line.quantity) == first)
            .collect();
        let confirmed = Counts::of(of_first.iter().copied()).confirmed;
        let higher = of_first.iter().filter(|line| {
            line.standing == Standing::Inconclusive && line.measured.verdict() == Verdict::TooHigh
        });
        let failed = failed || higher.count() > confirmed;
        let failed = failed || self.missing() > MISSING || !self.not_shown().is_empty();
        let failed = failed || self.seeds_repeat();
        if self.lines.iter().all(Line::is_without_answer) {
            Conclusion::CouldNotRun
        } else if (confirmed == 0 && !self.is_right_to_quantum()) || failed || deviates {
            Conclusion::NotConfirmed
        } else {
            Conclusion::Confirmed
        }
    }
}

impl Conclusion {
    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Conclusion::Confirmed => "confirmed",
            Conclusion::NotConfirmed => "not confirmed",
            Conclusion::CouldNotRun => "could not run",
        }
    }
}

/// How many are not confirmed although methods are, and have larger errors than these.
fn missing<'a>(lines: impl Iterator<Item = &'a Line>) -> usize {
    let required = lines.filter(|line| line.is_required);
    required
        .filter(|line| line.standing != Standing::Confirmed && !line.is_as_good)
        .count()
}

/// Runs a kernel on all subjects; `shown` hears of every channel as soon as it is done.
///
/// # Errors
/// [`VerifyError`] where a subject cannot be cut as asked for, or has no reference. What the kernel does wrong is
/// no error but stands in the lines.
pub fn verify(
    kernel: &mut dyn Kernel,
    subjects: &[Subject],
    settings: &Settings,
    progress: &dyn Progress,
    shown: &mut dyn FnMut(&Line),
) -> Result<Verification, VerifyError> {
    let prepared = Prepared::new(kernel.declaration(), subjects, settings)?;
    let identifies = prepared.identifies();
    let Prepared {
        settings, subjects, ..
    } = &prepared;
    let mut lines = Vec::new();
    let mut unanswered = 0;
    let mut seeds = Seeds::new(settings.replicas);
    let started = Instant::now();
    let (mut seen, mut rays) = (Vec::new(), 0);
    for subject in subjects {
        if unanswered < UNANSWERED_CASES {
            kernel.renew();
        }
        let asked = prepared.asked(subject)?;
        let answers = asked.of(kernel, progress);
        if let Some(why) = kernel.gone() {
            return Err(why.into());
        }
        seeds.hear(&answers);
        unanswered = if answers.are_there() {
            0
        } else {
            unanswered + 1
        };
        for wanted in asked.wanted(&answers)? {
            if let Some(line) = asked.line(&wanted, &answers)? {
                shown(&line);
                lines.push(line);
            }
        }
        rays += answers.rays();
        if identifies {
            seen.push(asked.seen(&answers)?);
        }
    }
    let ladder = Ladder {
        subjects,
        levels: seen,
        rays,
        took: started.elapsed(),
    };
    let answers = !lines.iter().all(Line::is_without_answer);
    let identification =
        (identifies && answers).then(|| identified(kernel, settings, &ladder, &lines, progress));
    let together = match settings.batch {
        Some(count) if answers => {
            let mut before = 0;
            Some(together(kernel, count, &mut |spent: &Spent| {
                progress.advance(spent.segments.saturating_sub(before));
                before = spent.segments;
            })?)
        }
        _ => None,
    };
    if let Some(why) = kernel.gone() {
        return Err(why.into());
    }
    let Prepared {
        declaration,
        settings,
        left_out,
        ..
    } = prepared;
    let unsteady = explain::unsteady(&declaration, &lines).into_iter();
    let found = unsteady.chain(explain::outside(&lines));
    let findings = found.chain(left_out::finding(&left_out)).collect();
    let different_seeds = declaration.stochastic.then(|| seeds.different());
    let mut verification = Verification {
        declaration,
        settings,
        lines,
        identification,
        together,
        findings,
        left_out,
        different_seeds,
    };
    let scattered = scattered::findings(&verification);
    verification.findings.splice(0..0, scattered);
    Ok(verification)
}
