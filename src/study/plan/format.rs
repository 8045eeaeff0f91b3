//! The shortest format that is good enough.

use super::draft::{Draft, working_bits};
use super::run::{Task, run};
use super::stored::{Step, StoredPlan, Uncertainty, VERSION};
use super::{Plan, PlanError, Settings};
use crate::real::{Format, FormatName, Mpfr, Real, WithFormat};
use crate::scene::Scene;
use rug::{Float, Rational};

impl Draft {
    /// The plan in the shortest allowed format that rounds little enough.
    pub(super) fn in_a_format(self, scene: &Scene, settings: &Settings) -> Result<Plan, PlanError> {
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
        formats.sort_by_key(|format| format.bits());
        let mut best: Option<(FormatName, f64)> = None;
        for format in formats {
            let rounding = match rehearsed(format) {
                Ok(rounding) => rounding,
                Err(error) if error.is_of_range() => f64::INFINITY,
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
        let bits = best.bits() + more as u32 + 1;
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
