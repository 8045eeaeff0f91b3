//! What a kernel is asked on one case.

mod allowance;
mod answered;
mod floor;
mod resolved;
mod sampled;
mod unabsorbed;
mod used;
mod wanted;

pub(super) use wanted::{Run, Wanted, depth_rule};

use super::identified::SeenLevel;
use super::{Axis, Settings, Steps, VerifyError};
use crate::kernel::{
    Cut, CutError, Data, Declaration, FormKind, Formula, Kernel, KernelError, Quantity, Rendering,
    Segments, Subject, Task, Volume,
};
use crate::real::{Format, Native};
use crate::study::Progress;
use rug::{Float, Rational};

/// A kernel that says it is deterministic is asked twice, with another seed; one that draws random numbers with the same.
const OTHER_SEED: u64 = 1;

/// One level of one case.
struct Level {
    cut: Cut,
    step: Rational,
    count: u64,
    segments: Option<Segments>,
    volume: Option<Volume>,
}

/// One case, as a kernel is asked it.
pub(super) struct Asked<'a> {
    subject: &'a Subject,
    settings: &'a Settings,
    declaration: &'a Declaration,
    levels: Vec<Level>,
    /// What is asked beside them.
    spots: Vec<Level>,
    formula: Option<Formula>,
}

/// What a kernel said to all levels of a case.
pub(super) struct Answers {
    /// By level and seed.
    levels: Vec<Vec<Result<Rendering, KernelError>>>,
    /// Beside the levels.
    spots: Vec<Result<Rendering, KernelError>>,
    /// By level, why there is no answer to the ray that does not absorb.
    no_emission: Vec<Option<KernelError>>,
    /// The coarsest level once more.
    again: Option<Result<Rendering, KernelError>>,
}

impl Answers {
    /// By level and seed.
    pub(super) fn by_seed(&self) -> &[Vec<Result<Rendering, KernelError>>] {
        &self.levels
    }

    /// How many rays were asked.
    pub(super) fn rays(&self) -> u64 {
        let levels: usize = self.levels.iter().map(Vec::len).sum();
        (levels + self.spots.len() + usize::from(self.again.is_some())) as u64
    }

    /// All that were given.
    fn given(&self) -> impl Iterator<Item = &Rendering> {
        let levels = self.levels.iter().flatten().chain(&self.spots);
        levels
            .chain(&self.again)
            .filter_map(|one| one.as_ref().ok())
    }

    /// Those of a level, unless what is wanted was asked by a ray of its own and not answered.
    fn are_of<T>(&self, wanted: &Wanted, level: usize, these: T) -> Result<T, &KernelError> {
        let is_own = wanted.quantity == Quantity::Emission;
        match self.no_emission.get(level) {
            Some(Some(error)) if is_own => Err(error),
            _ => Ok(these),
        }
    }

    /// Whether there is a single one.
    pub(super) fn are_there(&self) -> bool {
        self.levels.iter().flatten().any(Result::is_ok)
    }
}

impl<'a> Asked<'a> {
    pub(super) fn new(
        subject: &'a Subject,
        settings: &'a Settings,
        declaration: &'a Declaration,
    ) -> Result<Self, VerifyError> {
        let form = declaration.form;
        if settings.axis == Axis::Grid && form != FormKind::Volume {
            return Err(VerifyError::Axis { form });
        }
        if settings.axis == Axis::Grid && !declaration.has(Quantity::Radiance) {
            return Err(VerifyError::NoRadiance);
        }
        if let Steps::Spaced(_) = settings.steps
            && (form != FormKind::Segments || declaration.step_divides)
        {
            return Err(VerifyError::Spacing { form });
        }
        let cut_error = |error| VerifyError::Cut {
            case: subject.name().into(),
            error,
        };
        let shared = settings.cells();
        let cuts = settings.cuts(subject.length()).into_iter();
        let level = |(cut, n): (Cut, &u64)| {
            let (step, count) = cut.on(subject.length())?;
            let segments = (form == FormKind::Segments)
                .then(|| subject.segments(cut))
                .transpose()?;
            let cells = match settings.axis {
                Axis::Step => shared,
                Axis::Grid => *n,
            };
            Ok(Level {
                cut,
                step,
                count,
                segments,
                volume: (form == FormKind::Volume).then(|| subject.volume(cells, settings.entries)),
            })
        };
        let levels: Result<Vec<Level>, CutError> = cuts.zip(&settings.ladder).map(level).collect();
        let spots = match form {
            // Kinks of a grid stand elsewhere there.
            FormKind::Volume => Vec::new(),
            _ => settings.spots(subject.length(), declaration),
        };
        let spots = spots.into_iter().map(|cut| level((cut, &1)));
        let formula = match form {
            FormKind::Formula(language) => Some(subject.formula(language)),
            _ => None,
        };
        Ok(Asked {
            subject,
            settings,
            declaration,
            levels: levels.map_err(cut_error)?,
            spots: spots.collect::<Result<_, _>>().map_err(cut_error)?,
            formula: formula.transpose().map_err(|error| VerifyError::Formula {
                case: subject.name().into(),
                error,
            })?,
        })
    }

    /// What is wanted of the answers.
    pub(super) fn wanted(&self, answers: &Answers) -> Result<Vec<Wanted>, VerifyError> {
        // While a grid is refined only the radiance is looked at.
        let others = self.settings.axis == Axis::Step;
        let all = wanted::wanted(self.subject, self.declaration, answers.given())?;
        let looked_at = |one: &Wanted| others || one.quantity == Quantity::Radiance;
        Ok(all.into_iter().filter(looked_at).collect())
    }

    /// How many seeds a level is asked with.
    fn seeds(&self) -> usize {
        if self.declaration.stochastic {
            self.settings.replicas
        } else {
            1
        }
    }

    /// How many rays are asked, one for the coarsest level once more among them: [`Answers::rays`].
    #[cfg(feature = "studies")]
    pub(super) fn rays(&self) -> u64 {
        let again = self.levels.len().min(1);
        (self.levels.len() * self.seeds() + self.spots.len() + again) as u64
    }

    /// Asks all levels.
    pub(super) fn of(&self, kernel: &mut dyn Kernel, progress: &dyn Progress) -> Answers {
        let stochastic = self.declaration.stochastic;
        let seeds = self.seeds();
        let of_level = |level| (0..seeds as u64).map(move |seed| (level, seed));
        let of_levels = self.levels.iter().flat_map(of_level);
        let rays: Vec<(&Level, u64)> = of_levels
            .chain(self.spots.iter().map(|spot| (spot, 0)))
            .collect();
        // What takes many rays at once is asked all; else a level at a time, so that one that fails is not the others'.
        let (ladder, spots) = rays.split_at(self.levels.len() * seeds);
        let requests: Vec<&[(&Level, u64)]> = match self.declaration.batch {
            Some(_) => vec![&rays],
            None => ladder.chunks(seeds.max(1)).chain(spots.chunks(1)).collect(),
        };
        let mut answers = Vec::with_capacity(rays.len());
        for request in requests {
            let tasks: Vec<Task<'_>> = request
                .iter()
                .map(|(level, seed)| self.task(level, *seed))
                .collect();
            let before = answers.len();
            let answered = request.iter().zip(kernel.render_all(&tasks));
            answers.extend(answered.map(|((level, _), one)| self.checked(level, one)));
            // Those beside the ladder are no part of the work that is counted.
            let counted = request.iter().take(ladder.len().saturating_sub(before));
            progress.advance(counted.map(|(level, _)| level.count).sum());
        }
        let spots = answers.split_off(ladder.len());
        let mut answers = answers.into_iter();
        let level = |_| answers.by_ref().take(seeds).collect();
        let levels = self.levels.iter().map(level).collect();
        // After all others: what keeps an answer for the next request has another one by now.
        let seed = if stochastic { 0 } else { OTHER_SEED };
        let again = self.levels.first().map(|level| {
            let answer = kernel.render(&self.task(level, seed));
            self.checked(level, answer)
        });
        let mut answers = Answers {
            levels,
            spots,
            no_emission: Vec::new(),
            again,
        };
        self.ask_unabsorbed(kernel, &mut answers);
        answers
    }

    /// What was answered, where that is one answer to each ray: to compare a rule with.
    pub(super) fn seen(&self, answers: &Answers) -> Result<Vec<SeenLevel>, VerifyError> {
        let mut seen = Vec::new();
        // A rule knows no background.
        let has_background = !self.subject.background().is_empty();
        let has_rule = !self.declaration.stochastic && !has_background;
        if !has_rule || self.declaration.form == FormKind::Volume {
            return Ok(seen);
        }
        let firsts = answers.levels.iter().map(|level| level.first());
        let beside = answers.spots.iter().map(Some);
        let levels = self.levels.iter().chain(&self.spots);
        for (level, answer) in levels.zip(firsts.chain(beside)) {
            let Some(Ok(rendering)) = answer else {
                continue;
            };
            let used = self.used(level, Some(rendering))?;
            seen.push(SeenLevel {
                segments: used.segments,
                step: used.step,
                answers: rendering.radiance.iter().map(Float::to_f64).collect(),
            });
        }
        Ok(seen)
    }

    fn task<'t>(&'t self, level: &'t Level, seed: u64) -> Task<'t> {
        let data = match (&level.segments, &level.volume, &self.formula) {
            (Some(segments), ..) => Data::Segments(segments),
            (_, Some(volume), _) => Data::Volume(volume),
            (_, _, Some(formula)) => Data::Formula(formula),
            _ => Data::Function,
        };
        Task {
            subject: self.subject,
            step: level.step.to_f64(),
            segments: level.count,
            seed,
            data,
        }
    }

    /// An answer with what is declared, a radiance for every channel among it, of a ray that can be.
    fn checked(
        &self,
        level: &Level,
        answer: Result<Rendering, KernelError>,
    ) -> Result<Rendering, KernelError> {
        let rendering = answer?;
        for quantity in self.declaration.answers.iter().copied() {
            let (got, wanted) = (rendering.radiance.len(), self.subject.channels().len());
            if quantity == Quantity::Radiance && got != wanted {
                return Err(KernelError::Channels { got, wanted });
            }
            if rendering.of(quantity, 0).is_none() {
                let given = false;
                return Err(KernelError::Answers { quantity, given });
            }
        }
        let length = Native::<f64>::new().ratio(self.subject.length());
        let rendering = rendering.with_edges_on(length)?;
        let used = |what, value| Err(KernelError::Used { what, value });
        let cut = || self.cut(level, &rendering).on(self.subject.length());
        match (rendering.segments, rendering.step) {
            (_, Some(step)) if !(step.is_finite() && step > 0.0) => used("step", step),
            (Some(0), _) => used("number of segments", 0.0),
            // So many that no ray is cut so: what it sampled cannot be told.
            (Some(segments), _) if cut().is_err() => used("number of segments", segments as f64),
            (None, Some(step)) if cut().is_err() => used("step", step),
            _ => Ok(rendering),
        }
    }
}
