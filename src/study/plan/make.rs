//! Making a plan, and what it says.

use super::candidates::{Forest, Weights, stretch};
use super::choose::{Chosen, choose};
use super::layout::Stretch;
use super::light::Light;
use super::run::{Rendered, Task, run};
use super::settings::MAX_BITS;
use super::stored::{Because, Checked, CheckedChannel, Step, StoredPlan, Uncertainty, VERSION};
use super::survey::Survey;
use super::truth::scene_radiance;
use super::{Model, PlanError, Settings};
use crate::real::{Format, FormatName, Mpfr, Native, NativeFloat, Real, WithFormat};
use crate::scene::{Form, Scene};
use crate::symbolic::parse_number;
use rug::{Float, Rational};

/// The part of the tolerance that models may use; the rest is left for rounding.
const FOR_MODELS: f64 = 0.9;
/// How much of the tolerance may be due to how well the radiance is known.
const FOR_REFERENCE: f64 = 0.1;
/// Decimal orders between the brightest light and the tolerance up to which binary64 knows the radiance well enough.
const OF_BINARY64: f64 = 11.5;

/// The models of a scene that are enough for a tolerance, and a format.
#[derive(Clone, Debug)]
pub struct Plan {
    scene: Scene,
    stored: StoredPlan,
    tasks: Vec<Task>,
    background: bool,
    format: FormatName,
}

impl Plan {
    /// The plan of fewest evaluations for a tolerance, in binary32, binary64 or as many bits as it takes.
    ///
    /// ```
    /// use volver::scene;
    /// use volver::study::plan::Plan;
    ///
    /// let text = "
    ///     [[media]]
    ///     from = 0
    ///     to = 2
    ///     kind = 'constant'
    ///     extinction = 0.5
    ///     emission = 1
    /// ";
    /// let scene = scene::read(text, std::path::Path::new("."))?;
    /// let rendered = Plan::for_scene(&scene, 1e-4)?.run::<f32>()?;
    /// assert_eq!(rendered.evaluations, 1);
    /// assert!((rendered.radiance[0] - (1.0 - (-1_f32).exp())).abs() < 1e-4);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`PlanError`] where the media cannot be bounded.
    pub fn for_scene(scene: &Scene, tolerance: f64) -> Result<Plan, PlanError> {
        Plan::new(scene, &Settings::new(tolerance))
    }

    /// The plan that is cheapest in the sense of the settings.
    ///
    /// # Errors
    /// [`PlanError`] where the media cannot be bounded, or no allowed format is good enough.
    pub fn new(scene: &Scene, settings: &Settings) -> Result<Plan, PlanError> {
        let tolerance = settings.tolerance;
        if !(tolerance.is_finite() && tolerance >= f64::MIN_POSITIVE) {
            return Err(PlanError::Tolerance { tolerance });
        }
        let mut bits = working_bits(scene, tolerance);
        loop {
            let drafted = if bits <= f64::MANTISSA_DIGITS {
                Draft::new(scene, settings, Native::<f64>::new())?
            } else {
                Draft::new(scene, settings, Mpfr { bits })?
            };
            match drafted {
                Some(draft) => return draft.in_a_format(scene, settings),
                None if bits < MAX_BITS => bits = (2 * bits).max(128),
                None => return Err(PlanError::Bits { tolerance, bits }),
            }
        }
    }

    /// A stored plan for its scene.
    ///
    /// # Errors
    /// [`PlanError::OtherScene`] and [`PlanError::Step`] where it is for another one, or damaged.
    pub fn from_stored(scene: &Scene, stored: StoredPlan) -> Result<Plan, PlanError> {
        if stored.plan != VERSION {
            return Err(PlanError::Step {
                step: 1,
                reason: format!("a plan of version {}, not {VERSION}", stored.plan),
            });
        }
        if stored.scene != scene.fingerprint() {
            return Err(PlanError::OtherScene {
                plan: stored.scene.escape_debug().to_string(),
                scene: scene.fingerprint().into(),
            });
        }
        let wrong = |step: usize, reason: String| PlanError::Step { step, reason };
        let format = stored
            .format
            .parse()
            .map_err(|error: crate::real::FormatError| wrong(1, error.to_string()))?;
        let mut tasks = Vec::with_capacity(stored.steps.len());
        let mut place = None;
        for (i, step) in stored.steps.iter().enumerate() {
            let task = task(scene, step).map_err(|reason| wrong(i + 1, reason))?;
            let begin = place.unwrap_or_else(|| scene.media()[0].from());
            if task.stretch.from != begin {
                let reason = format!("it begins at {}, not at {begin}", step.from);
                return Err(wrong(i + 1, reason));
            }
            place = Some(task.stretch.to.clone());
            tasks.push(task);
        }
        let end = scene.media().last().map(crate::scene::Medium::to);
        if place != end && stored.stop.is_none() {
            let reason = "the steps end before the ray does".into();
            return Err(wrong(stored.steps.len(), reason));
        }
        Ok(Plan {
            scene: scene.clone(),
            background: stored.stop.is_none(),
            stored,
            tasks,
            format,
        })
    }

    /// The plan as it is kept.
    #[must_use]
    pub fn stored(&self) -> &StoredPlan {
        &self.stored
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// The format that it is for.
    #[must_use]
    pub fn format(&self) -> FormatName {
        self.format
    }

    /// How often C and τ are evaluated.
    #[must_use]
    pub fn evaluations(&self) -> u64 {
        self.stored.evaluations
    }

    /// Runs it in its own format and keeps what comes out beside the radiance to many digits.
    ///
    /// # Errors
    /// [`PlanError`] where it does not run, or where the radiance cannot be had.
    pub fn check(&mut self) -> Result<&Checked, PlanError> {
        // Digits beyond the tolerance tell how far it is from being reached.
        let digits = -self.stored.tolerance.min(1.0).log10() + 6.0;
        // At most some 320.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let digits = digits.ceil() as u32;
        let bits = 4 * digits + 8;
        let exact = scene_radiance(&self.scene, bits)?;
        let found = self.format.with(Running { plan: self })?;
        let names = self.scene.channels().iter();
        let channels =
            names
                .zip(found.iter().zip(&exact))
                .map(|(name, ((value, shown), exact))| {
                    let error = Float::with_val(bits, value - exact).abs();
                    CheckedChannel {
                        channel: name.clone(),
                        radiance: shown.clone(),
                        reference: exact.to_string_radix(10, Some(digits as usize)),
                        error: error.to_f64(),
                    }
                });
        let checked = Checked {
            channels: channels.collect(),
        };
        Ok(self.stored.checked.insert(checked))
    }

    /// Runs it in a native type.
    ///
    /// # Errors
    /// [`PlanError::NotFinite`] where the type's range is too short.
    pub fn run<T: NativeFloat>(&self) -> Result<Rendered<T>, PlanError> {
        self.run_in(Native::<T>::new())
    }

    /// Runs it in a format.
    ///
    /// # Errors
    /// [`PlanError::NotFinite`] where the format's range is too short.
    pub fn run_in<F: Format>(&self, format: F) -> Result<Rendered<F::Real>, PlanError> {
        run(&self.scene, &self.tasks, self.background, format)
    }
}

/// Bits in which the radiance is to be known, as far as that is clear beforehand.
fn working_bits(scene: &Scene, tolerance: f64) -> u32 {
    let emission = |form: &Form| match form {
        Form::Vacuum | Form::Smooth { .. } => 1.0,
        Form::Constant(values) => largest(values),
        Form::Linear { front, back } => largest(front).max(largest(back)),
    };
    let pieces = scene.media().iter().flat_map(|medium| &medium.pieces);
    let background = scene.background().iter().map(Rational::to_f64);
    let light = pieces.map(|piece| emission(&piece.form)).chain(background);
    let brightest = light.fold(1.0_f64, f64::max);
    let digits = (brightest / tolerance).log10();
    if digits <= OF_BINARY64 {
        return f64::MANTISSA_DIGITS;
    }
    // At most some 700 digits.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let bits = (digits * std::f64::consts::LOG2_10) as u32 + 64;
    bits
}

fn largest(values: &[crate::scene::Values]) -> f64 {
    let all = values.iter().map(|of_one| of_one.emission.to_f64());
    all.fold(0.0, f64::max)
}

/// A plan without a format.
struct Draft {
    tasks: Vec<Task>,
    bounds: Vec<f64>,
    reasons: Vec<Because>,
    stop: Option<usize>,
    uncertainty: Uncertainty,
}

impl Draft {
    /// The cheapest models; `None` where the radiance is not known well enough in that format.
    fn new<F: Format>(
        scene: &Scene,
        settings: &Settings,
        format: F,
    ) -> Result<Option<Draft>, PlanError> {
        let tolerance = settings.tolerance;
        let survey = Survey::new(scene, format, tolerance)?;
        let reference = survey.uncertainty;
        let blurred = survey.blur();
        if blurred > FOR_REFERENCE * tolerance {
            return Err(PlanError::Blur {
                blur: scene.media().iter().map(|medium| medium.blur).sum(),
                error: blurred,
            });
        }
        if reference.is_nan() || reference > FOR_REFERENCE * tolerance {
            return Ok(None);
        }
        let forest = Forest::new(&survey, settings.cost, tolerance)?;
        let mut allowed = FOR_MODELS * tolerance - reference;
        // Models in front let in what models behind make of the light there, not what it is: where that is too
        // much, less is allowed of each.
        for _ in 0..8 {
            let Some(chosen) = choose(&forest, allowed) else {
                return Ok(None);
            };
            let draft = Draft::of(&survey, &forest, &chosen)?;
            if draft.uncertainty.models <= FOR_MODELS * tolerance - reference {
                return Ok(Some(draft));
            }
            allowed /= 2.0;
        }
        Ok(None)
    }

    /// What was chosen, with the bounds that hold for it.
    fn of<F: Format>(
        survey: &Survey<'_, F>,
        forest: &Forest,
        chosen: &[Chosen],
    ) -> Result<Draft, PlanError> {
        let format = survey.layout.format;
        let mut draft = Draft {
            tasks: Vec::new(),
            bounds: Vec::new(),
            reasons: Vec::new(),
            stop: None,
            uncertainty: Uncertainty {
                reference: survey.uncertainty,
                ..Uncertainty::default()
            },
        };
        let background = survey.scene.background().iter();
        let mut behind: Vec<F::Real> = background.map(|q| format.ratio(q)).collect();
        let mut steps = Vec::with_capacity(chosen.len());
        for of_one in chosen.iter().rev() {
            let Some(stretch) = stretch(survey, &of_one.panels) else {
                continue;
            };
            let candidate = &forest.nodes[of_one.node].candidates[of_one.candidate];
            let task = Task {
                stretch,
                model: candidate.model,
            };
            let light = super::run::light(survey.scene, &survey.layout, &task)?;
            let exact = survey.light(of_one.panels.clone());
            let weights = Weights {
                front: &survey.transmittance[of_one.panels.start],
                behind: &behind,
                exact: &exact,
            };
            // A model of few points counts with the largest error of it and of more points.
            let because = weights.because(&light);
            steps.push((task, because.error().max(candidate.error), because));
            behind = behind
                .iter()
                .zip(&light)
                .map(|(behind, light): (&F::Real, &Light<F::Real>)| {
                    (-light.depth.clone()).exp() * behind + &light.radiance
                })
                .collect();
        }
        for (task, bound, because) in steps.into_iter().rev() {
            draft.uncertainty.models += bound;
            draft.tasks.push(task);
            draft.bounds.push(bound);
            draft.reasons.push(because);
        }
        draft.find_stop(survey);
        Ok(draft)
    }

    /// Behind the last step that does anything the ray may end, the background being neglected with the rest where
    /// the tolerance has room for it.
    fn find_stop<F: Format>(&mut self, survey: &Survey<'_, F>) {
        let is_nothing = |task: &Task| task.model == Model::Nothing;
        let last = self.tasks.iter().rposition(|task| !is_nothing(task));
        let stop = last.map_or(0, |last| last + 1);
        if stop == self.tasks.len() {
            return;
        }
        if survey.scene.background().iter().all(|q| *q == 0) {
            self.stop = Some(stop);
        }
    }

    /// The plan in the shortest allowed format that rounds little enough.
    fn in_a_format(self, scene: &Scene, settings: &Settings) -> Result<Plan, PlanError> {
        let tolerance = settings.tolerance;
        let used = self.uncertainty.models + self.uncertainty.reference;
        let left = tolerance - used;
        let background = self.stop.is_none();
        let exact_bits = f64::MANTISSA_DIGITS.max(working_bits(scene, tolerance)) + 64;
        let rehearsed = |format: FormatName| -> Result<f64, PlanError> {
            format.with(Rehearsal {
                scene,
                tasks: &self.tasks,
                background,
                exact_bits,
            })
        };
        let mut formats = settings.formats.clone();
        if formats.is_empty() {
            formats = vec![FormatName::F32, FormatName::F64];
            let bits = exact_bits.next_multiple_of(32);
            formats.push(FormatName::Mpfr(bits));
        }
        formats.sort_by_key(|format| bits_of(*format));
        let mut best: Option<(FormatName, f64)> = None;
        for format in formats {
            let rounding = match rehearsed(format) {
                Ok(rounding) => rounding,
                Err(PlanError::NotFinite { .. }) => f64::INFINITY,
                Err(error) => return Err(error),
            };
            if rounding <= left {
                return Ok(self.plan(scene, tolerance, format, rounding));
            }
            if best.is_none_or(|(_, least)| rounding < least) {
                best = Some((format, rounding));
            }
        }
        let (best, rounding) = best.unwrap_or((FormatName::F64, f64::INFINITY));
        let more = (rounding / left).log2().ceil().clamp(1.0, 1e4);
        // At most ten thousand.
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
        let bits = bits_of(best) + more as u32 + 1;
        Err(PlanError::Format {
            tolerance,
            best: best.to_string(),
            rounding,
            left,
            bits,
        })
    }

    fn plan(self, scene: &Scene, tolerance: f64, format: FormatName, rounding: f64) -> Plan {
        let steps = self.tasks.iter().zip(&self.bounds).zip(&self.reasons);
        let steps = steps.map(|((task, bound), because)| Step {
            medium: task.stretch.medium + 1,
            from: task.stretch.from.to_string(),
            to: task.stretch.to.to_string(),
            model: task.model,
            bound: *bound,
            because: *because,
        });
        let stop = self.stop.map(|stop| {
            let place = match stop.checked_sub(1) {
                Some(last) => self.tasks[last].stretch.to.clone(),
                None => self
                    .tasks
                    .first()
                    .map_or_else(Rational::new, |task| task.stretch.from.clone()),
            };
            place.to_string()
        });
        let stored = StoredPlan {
            plan: VERSION,
            scene: scene.fingerprint().into(),
            tolerance,
            format: format.to_string(),
            steps: steps.collect(),
            stop,
            evaluations: self
                .tasks
                .iter()
                .map(|task| u64::from(task.model.evaluations()))
                .sum(),
            checked: None,
            uncertainty: Uncertainty {
                rounding,
                ..self.uncertainty
            },
        };
        Plan {
            scene: scene.clone(),
            background: self.stop.is_none(),
            stored,
            tasks: self.tasks,
            format,
        }
    }
}

/// The radiance of a plan by channel: the number, and how it prints.
struct Running<'a> {
    plan: &'a Plan,
}

impl WithFormat for Running<'_> {
    type Output = Result<Vec<(Float, String)>, PlanError>;

    fn run<F: Format>(self, format: F) -> Self::Output {
        let rendered = self.plan.run_in(format)?;
        let radiance = rendered.radiance.iter();
        Ok(radiance.map(|r| (r.to_float(), r.to_string())).collect())
    }
}

/// By how much a plan rounds in a format: against many more bits, at the same places.
struct Rehearsal<'a> {
    scene: &'a Scene,
    tasks: &'a [Task],
    background: bool,
    exact_bits: u32,
}

impl WithFormat for Rehearsal<'_> {
    type Output = Result<f64, PlanError>;

    fn run<F: Format>(self, format: F) -> Self::Output {
        let wide = Mpfr {
            bits: self.exact_bits.max(format.bits() + 64),
        };
        let short = run(self.scene, self.tasks, self.background, format)?;
        let exact = run(self.scene, self.tasks, self.background, wide)?;
        let pairs = short.radiance.iter().zip(&exact.radiance);
        let errors = pairs.map(|(short, exact)| {
            let error: Float = short.to_float() - exact.to_float();
            Float::with_val(53, error.abs()).to_f64()
        });
        Ok(errors.fold(0.0, f64::max))
    }
}

fn bits_of(format: FormatName) -> u32 {
    struct Bits;
    impl WithFormat for Bits {
        type Output = u32;
        fn run<F: Format>(self, format: F) -> u32 {
            format.bits()
        }
    }
    format.with(Bits)
}

/// What a stored step says, made sure of.
fn task(scene: &Scene, step: &Step) -> Result<Task, String> {
    let number = |text: &str| {
        let shown = text.escape_debug();
        parse_number(text).map_err(|_| format!("'{shown}' is no number"))
    };
    let (from, to) = (number(&step.from)?, number(&step.to)?);
    let index = step.medium.checked_sub(1);
    let medium = index.and_then(|index| Some((index, scene.media().get(index)?)));
    let Some((index, medium)) = medium else {
        return Err(format!("there is no medium {}", step.medium));
    };
    if from >= to || from < medium.from() || to > medium.to() {
        return Err(format!(
            "from {} to {} is no part of medium {}",
            step.from, step.to, medium.name
        ));
    }
    let first = medium.pieces.partition_point(|piece| piece.to <= from);
    let end = medium.pieces.partition_point(|piece| piece.from < to);
    let task = Task {
        stretch: Stretch {
            medium: index,
            pieces: first..end,
            from,
            to,
        },
        model: step.model,
    };
    let piece = task.stretch.only_piece(scene);
    let fits = match step.model {
        Model::Constant => piece.is_some_and(|p| matches!(p.form, Form::Constant(_))),
        Model::Linear => piece.is_some_and(|p| {
            matches!(p.form, Form::Linear { .. })
                && p.from == task.stretch.from
                && p.to == task.stretch.to
        }),
        model => model.points().is_none_or(|p| (1..=1000).contains(&p)),
    };
    if !fits {
        return Err(format!("{} does not fit the medium there", step.model));
    }
    Ok(task)
}
