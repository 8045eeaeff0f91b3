//! Models for a whole ray, before a format is chosen.

use super::candidates::{Forest, stretch};
use super::choose::{Chosen, choose};
use super::light::Light;
use super::run::Task;
use super::stored::{Because, Uncertainty};
use super::survey::Survey;
use super::weights::Weights;
use super::{Model, PlanError, Settings};
use crate::real::{Format, Real};
use crate::scene::{Form, Scene, Values};
use rug::Rational;

/// The part of the tolerance that models may use; the rest is left for rounding.
const FOR_MODELS: f64 = 0.9;
/// How much of the tolerance may be due to how well the radiance is known.
const FOR_REFERENCE: f64 = 0.1;
/// Decimal orders between the brightest light and the tolerance up to which binary64 knows the radiance well enough.
const OF_BINARY64: f64 = 11.5;

/// A plan without a format.
pub(super) struct Draft {
    pub(super) tasks: Vec<Task>,
    pub(super) bounds: Vec<f64>,
    pub(super) reasons: Vec<Because>,
    pub(super) stop: Option<usize>,
    pub(super) uncertainty: Uncertainty,
}

/// What is lacking for a draft in a format.
pub(super) enum Lacking {
    /// The radiance is not known well enough.
    Bits,
    /// No models add up to little enough: numbers are beyond the format's range.
    Models,
}

impl Draft {
    /// The cheapest models, or what is lacking for them in that format.
    pub(super) fn new<F: Format>(
        scene: &Scene,
        settings: &Settings,
        format: F,
    ) -> Result<Result<Draft, Lacking>, PlanError> {
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
            return Ok(Err(Lacking::Bits));
        }
        let forest = Forest::new(&survey, settings.cost, tolerance)?;
        let mut allowed = FOR_MODELS * tolerance - reference;
        // Models in front let in what models behind make of the light there, not what it is: where that is too
        // much, less is allowed of each.
        for _ in 0..8 {
            let Some(chosen) = choose(&forest, allowed) else {
                return Ok(Err(Lacking::Models));
            };
            let draft = Draft::of(&survey, &forest, &chosen)?;
            if draft.uncertainty.models <= FOR_MODELS * tolerance - reference {
                return Ok(Ok(draft));
            }
            allowed /= 2.0;
        }
        Ok(Err(Lacking::Models))
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
}

/// Bits in which the radiance is to be known, as far as that is clear beforehand.
pub(super) fn working_bits(scene: &Scene, tolerance: f64) -> u32 {
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

fn largest(values: &[Values]) -> f64 {
    let all = values.iter().map(|of_one| of_one.emission.to_f64());
    all.fold(0.0, f64::max)
}
