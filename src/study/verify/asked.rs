//! What a kernel is asked on one case, and what comes of its answers.

use super::line::{Failure, Line, Measured, Radiances};
use super::nominal::{self, Nominal};
use super::standing::{self, Judged};
use super::{Axis, Settings, VerifyError, expectation, truth};
use crate::case::Case;
use crate::convergence::{Replicas, Sample, fit, fit_replicas};
use crate::diagnosis::{Lookup, Ray, Watched, WatchedLevel};
use crate::kernel::{
    Cut, CutError, Data, Declaration, FormKind, Formula, Kernel, KernelError, Rendering, Segments,
    Subject, Table, Task, Volume,
};
use crate::real::Native;
use crate::study::Progress;
use rug::{Float, Rational};

/// Bits of references beyond those of the kernel's format.
const REFERENCE_BITS: u32 = 75;
/// Sizes that tables are known to be cut down to.
const COARSER_TABLES: [usize; 6] = [16, 32, 64, 128, 256, 512];
/// A kernel that says it is deterministic is asked twice, with another seed.
const OTHER_SEED: u64 = 1;

/// Other ways to look up tables: coarser ones, and the nearest entry.
fn lookups() -> impl Iterator<Item = Lookup> {
    let coarser = COARSER_TABLES.into_iter().map(Some);
    let entries = std::iter::once(None).chain(coarser);
    let all = entries.flat_map(|entries| [false, true].map(|nearest| Lookup { entries, nearest }));
    all.filter(|lookup| lookup.nearest || lookup.entries.is_some())
}

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
    formula: Option<Formula>,
}

/// What a kernel said to all levels of a case.
pub(super) struct Answers {
    /// By level and seed.
    levels: Vec<Vec<Result<Rendering, KernelError>>>,
    /// The coarsest level once more.
    again: Option<Result<Rendering, KernelError>>,
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
        let cut_error = |error| VerifyError::Cut {
            case: subject.name().into(),
            error,
        };
        let coarsest = settings.ladder.first().copied().unwrap_or(1);
        let cuts = settings.cuts(subject.length()).into_iter();
        let level = |(cut, n): (Cut, &u64)| {
            let (step, count) = cut.on(subject.length())?;
            let segments = (form == FormKind::Segments)
                .then(|| subject.segments(cut))
                .transpose()?;
            let cells = match settings.axis {
                Axis::Step => coarsest,
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
        let levels = cuts.zip(&settings.ladder).map(level);
        let formula = match form {
            FormKind::Formula(language) => Some(subject.formula(language)),
            _ => None,
        };
        Ok(Asked {
            subject,
            settings,
            declaration,
            levels: levels.collect::<Result<_, _>>().map_err(cut_error)?,
            formula: formula.transpose().map_err(|error| VerifyError::Formula {
                case: subject.name().into(),
                error,
            })?,
        })
    }

    /// Asks all levels.
    pub(super) fn of(&self, kernel: &mut dyn Kernel, progress: &dyn Progress) -> Answers {
        let stochastic = self.declaration.stochastic;
        let seeds = if stochastic {
            self.settings.replicas
        } else {
            1
        };
        let mut levels = Vec::with_capacity(self.levels.len());
        let mut again = None;
        for (index, level) in self.levels.iter().enumerate() {
            let tasks: Vec<Task<'_>> = (0..seeds as u64)
                .map(|seed| self.task(level, seed))
                .collect();
            let answers = kernel.render_all(&tasks);
            levels.push(answers.into_iter().map(|one| self.checked(one)).collect());
            if index == 0 && !stochastic {
                again = Some(self.checked(kernel.render(&self.task(level, OTHER_SEED))));
            }
            progress.advance(level.count * seeds as u64);
        }
        Answers { levels, again }
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

    /// An answer with a radiance for every channel, of a ray that can be.
    fn checked(&self, answer: Result<Rendering, KernelError>) -> Result<Rendering, KernelError> {
        let rendering = answer?;
        let (got, wanted) = (rendering.radiance.len(), self.subject.channels().len());
        if got != wanted {
            return Err(KernelError::Channels { got, wanted });
        }
        let what = "step";
        match rendering.step {
            Some(value) if !(value.is_finite() && value > 0.0) => {
                Err(KernelError::Used { what, value })
            }
            _ if rendering.segments == Some(0) => Err(KernelError::Used {
                what: "number of segments",
                value: 0.0,
            }),
            _ => Ok(rendering),
        }
    }

    /// How the ray was cut, by what the kernel says or else as asked.
    fn used(&self, level: &Level, rendering: &Rendering) -> Cut {
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

    /// The samples of one level as another use of the tables gives them.
    fn looked_up(&self, level: &Level, cut: Cut, lookup: Lookup) -> Result<Segments, VerifyError> {
        let Some(volume) = &level.volume else {
            return self.segments(level, cut);
        };
        let table = match lookup.entries {
            Some(entries) => volume.table.resampled(entries),
            None => volume.table.clone(),
        };
        let volume = Volume {
            field: volume.field.clone(),
            table,
        };
        let by = if lookup.nearest {
            Table::nearest
        } else {
            Table::at
        };
        let segments = volume.segments(self.subject.length(), cut, by);
        segments.map_err(|error| self.cut_error(error))
    }

    fn cut_error(&self, error: CutError) -> VerifyError {
        VerifyError::Cut {
            case: self.subject.name().into(),
            error,
        }
    }

    /// What one channel shows.
    pub(super) fn line(
        &self,
        channel: usize,
        answers: &Answers,
    ) -> Result<(Line, Watched), VerifyError> {
        let case = &self.subject.cases()[channel];
        let bits = nominal::bits(self.declaration.format).max(f64::MANTISSA_DIGITS);
        let exact = truth::of_case(case, bits + REFERENCE_BITS, self.declaration.far_wall)?;
        let stepwise = match self.levels.first().map(|level| &level.volume) {
            Some(Some(volume)) if self.settings.axis == Axis::Step => {
                let length = self.subject.length();
                truth::of_volume(volume, length, channel, bits + REFERENCE_BITS)
            }
            _ => exact,
        };
        let mut radiances = Radiances::new(stepwise);
        let mut failures = Vec::new();
        let mut watched = Watched {
            name: case.name().into(),
            case: case.clone(),
            scale: radiances.exact.to_f64().abs(),
            levels: Vec::new(),
            again: Self::again(channel, answers),
            lookups: lookups().map(|lookup| (lookup, Vec::new())).collect(),
        };
        if self.declaration.form != FormKind::Volume {
            watched.lookups.clear();
        }
        for (level, answers) in self.levels.iter().zip(&answers.levels) {
            let whole: Result<Vec<&Rendering>, &KernelError> =
                answers.iter().map(Result::as_ref).collect();
            let renderings = match whole {
                Ok(renderings) => renderings,
                Err(error) => {
                    let n = level.count;
                    failures.push(Failure::new(n, error));
                    continue;
                }
            };
            let Some(first) = renderings.first() else {
                continue;
            };
            let cut = self.used(level, first);
            let segments = self.segments(level, cut)?;
            let uniform = match cut {
                Cut::Segments(n) => Some(n),
                Cut::Step(_) => None,
            };
            let declared = nominal::at_level(self.declaration, case, &segments, channel, uniform);
            let values: Vec<Float> = renderings
                .iter()
                .map(|rendering| rendering.radiance[channel].clone())
                .collect();
            if let Some(value) = values.first() {
                watched.levels.push(WatchedLevel {
                    ray: Ray::new(&segments, channel, Native::<f64>::new()),
                    uniform: uniform.filter(|_| level.volume.is_none()),
                    value: value.to_f64(),
                });
            }
            for (lookup, rays) in &mut watched.lookups {
                let segments = self.looked_up(level, cut, *lookup)?;
                rays.push(Ray::new(&segments, channel, Native::<f64>::new()));
            }
            let step = first.step.unwrap_or_else(|| level.step.to_f64());
            let (n, step) = self.coordinate(level, uniform, step);
            let largest = watched.levels.last();
            let largest = largest.map_or(0.0, |level| level.ray.largest_emission());
            let floor = self.floor(
                &radiances.exact,
                level,
                declared.as_ref(),
                &values,
                (channel, largest),
            );
            radiances.push(n, step, values, floor, declared.map(|d| d.exact));
        }
        let steady = Self::is_steady(channel, answers);
        let line = self.judged(channel, radiances, failures, steady)?;
        Ok((line, watched))
    }

    /// n and d of a level: of the ray, or of the grid.
    fn coordinate(&self, level: &Level, uniform: Option<u64>, step: f64) -> (Option<u64>, f64) {
        match (self.settings.axis, &level.volume) {
            (Axis::Grid, Some(volume)) => {
                let cells = volume.cells() as u64;
                let width = Rational::from(self.subject.length() / cells.max(1));
                (Some(cells), width.to_f64())
            }
            _ => (uniform, step),
        }
    }

    /// What of an error may be rounding, or is left by what is not refined.
    fn floor(
        &self,
        exact: &Float,
        level: &Level,
        declared: Option<&Nominal>,
        values: &[Float],
        (channel, largest_emission): (usize, f64),
    ) -> Float {
        let bits = exact.prec();
        // Pixels are as bright as the brightest emission, and kernels round opacities, which are of order 1: what
        // is much fainter than either has the rounding of both.
        let scale = Float::with_val(bits, exact.abs_ref());
        let scale = scale.max(&Float::with_val(bits, largest_emission));
        let mut floor = scale * nominal::unit(self.declaration);
        if let Some(quantum) = self.declaration.quantum {
            floor = floor.max(&Float::with_val(bits, quantum / 2.0));
        }
        if let Some(Nominal { exact, in_format }) = declared {
            let rounding = Float::with_val(bits, in_format - exact).abs();
            if rounding > floor {
                floor = rounding;
            }
        } else {
            // Roundings of as many segments, by chance up and down.
            floor *= (level.count as f64).sqrt();
        }
        if let (Axis::Grid, Some(volume), Some(value)) =
            (self.settings.axis, &level.volume, values.first())
        {
            let on_grid = truth::of_volume(volume, self.subject.length(), channel, bits);
            floor += Float::with_val(bits, value - on_grid).abs();
        }
        floor
    }

    /// Whether a kernel that is said to be deterministic answers the same twice.
    fn is_steady(channel: usize, answers: &Answers) -> bool {
        let first = answers.levels.first().and_then(|level| level.first());
        match (first, &answers.again) {
            (Some(Ok(first)), Some(Ok(again))) => {
                let (first, again) = (&first.radiance[channel], &again.radiance[channel]);
                first == again || (first.is_nan() && again.is_nan())
            }
            _ => true,
        }
    }

    /// The second radiance of the coarsest level.
    fn again(channel: usize, answers: &Answers) -> Option<f64> {
        let of_replicas = || answers.levels.first()?.get(1);
        let second = answers.again.as_ref().or_else(of_replicas)?;
        let rendering = second.as_ref().ok()?;
        Some(rendering.radiance.get(channel)?.to_f64())
    }

    fn judged(
        &self,
        channel: usize,
        radiances: Radiances,
        failures: Vec<Failure>,
        steady: bool,
    ) -> Result<Line, VerifyError> {
        let case = &self.subject.cases()[channel];
        let expected = expectation::of(self.declaration, self.settings, case);
        let name = case.name().to_string();
        let measured = if self.declaration.stochastic {
            let levels: Vec<Replicas> = radiances.replicas();
            if levels.len() < 3 {
                Measured::Nothing
            } else {
                let fitted = fit_replicas(&levels, expected, 0);
                Measured::Scattered(Box::new(fitted.map_err(|error| VerifyError::Replicas {
                    case: name.clone(),
                    error,
                })?))
            }
        } else {
            let samples: Vec<Sample> = radiances.samples();
            let fitted = fit(&samples, expected).map_err(|error| VerifyError::Fit {
                case: name.clone(),
                error,
            })?;
            Measured::Fitted {
                fit: Box::new(fitted),
                samples,
            }
        };
        let of_method = radiances.nominal_samples().map(|samples| {
            fit(&samples, expected).map_err(|error| VerifyError::Fit {
                case: name.clone(),
                error,
            })
        });
        let of_method = of_method.transpose()?;
        let standing = standing::of(&Judged {
            measured: &measured,
            expected,
            failures: &failures,
            of_method: of_method.as_ref().map(|fit| fit.verdict),
            steady,
        });
        Ok(Line {
            name,
            expected,
            exact: radiances.exact,
            measured,
            failures,
            steady,
            standing,
        })
    }
}
