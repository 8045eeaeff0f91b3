//! Running a plan.

use super::layout::{Layout, Stretch};
use super::light::{Light, by_points};
use super::{Model, PlanError};
use crate::case::Transfer;
use crate::real::{Format, Real, row, try_row};
use crate::scene::{BoundPiece, Form, Scene, Values};

/// What comes out of a plan, by channel.
#[derive(Clone, Debug, PartialEq)]
pub struct Rendered<R> {
    /// I.
    pub radiance: Vec<R>,
    /// T over the whole ray, as far as the plan follows it.
    pub transmittance: Vec<R>,
    /// How often C and τ were evaluated.
    pub evaluations: u64,
}

/// A step of a plan, ready to run.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Task {
    pub(super) stretch: Stretch,
    pub(super) model: Model,
}

/// Numbers rounded once.
pub(super) fn rounded<F: Format>(values: &Values, format: F) -> Transfer<F::Real> {
    Transfer {
        emission: format.ratio(&values.emission),
        extinction: format.ratio(&values.extinction),
    }
}

/// The radiance of a scene by these steps, from front to back. Of steps that are left out nothing is evaluated;
/// without `background` that is left out too.
pub(super) fn run<F: Format>(
    scene: &Scene,
    tasks: &[Task],
    background: bool,
    format: F,
) -> Result<Rendered<F::Real>, PlanError> {
    let layout = Layout::new(scene, format);
    let channels = layout.channels;
    let mut radiance = row((0..channels).map(|_| format.int(0)));
    let mut transmittance = row((0..channels).map(|_| format.int(1)));
    let mut evaluations = 0;
    for task in tasks {
        let light = light(scene, &layout, task)?;
        evaluations += u64::from(task.model.evaluations());
        let sums = radiance.iter_mut().zip(&mut transmittance);
        for ((radiance, transmittance), light) in sums.zip(&light) {
            *radiance += &(light.radiance.clone() * transmittance);
            *transmittance = behind(transmittance.clone(), &light.depth);
        }
    }
    if background {
        let both = radiance.iter_mut().zip(&transmittance);
        for ((radiance, transmittance), light) in both.zip(scene.background()) {
            *radiance += &(format.ratio(light) * transmittance);
        }
    }
    for (radiance, channel) in radiance.iter().zip(scene.channels()) {
        if !radiance.is_finite() {
            return Err(PlanError::NotFinite {
                channel: if channel.is_empty() {
                    String::new()
                } else {
                    format!("{channel}: ")
                },
                value: radiance.to_string(),
                format: format.to_string(),
            });
        }
    }
    Ok(Rendered {
        radiance,
        transmittance,
        evaluations,
    })
}

/// T behind a step of that depth: T − T α where the step is thin, so that what it takes is not rounded beside 1 and the errors
/// of many steps go either way; T e^(−t) where it is not, and a difference would leave few digits of what remains.
fn behind<R: Real>(transmittance: R, depth: &R) -> R {
    let format = depth.format();
    if depth.clone().abs() < format.fraction(1, 2) {
        let taken = transmittance.clone() * &-(-depth.clone()).exp_m1();
        transmittance - &taken
    } else {
        transmittance * &(-depth.clone()).exp()
    }
}

/// The light of one step, by channel.
pub(super) fn light<F: Format>(
    scene: &Scene,
    layout: &Layout<'_, F>,
    task: &Task,
) -> Result<Vec<Light<F::Real>>, PlanError> {
    let format = layout.format;
    let none = || row((0..layout.channels).map(|_| Light::none(format)));
    let length = || format.ratio(&task.stretch.length());
    match task.model {
        Model::Nothing => Ok(none()),
        Model::Constant => match layout.piece(&task.stretch) {
            Some(BoundPiece::Constant(values)) => {
                let length = length();
                let light = values.iter().map(|of_one| {
                    let depth = of_one.extinction.clone() * &length;
                    Light::of_constant_emission(&of_one.emission, depth)
                });
                Ok(row(light))
            }
            _ => Ok(none()),
        },
        Model::Linear => match task.stretch.only_piece(scene).map(|piece| &piece.form) {
            Some(Form::Linear { front, back }) => {
                let length = length();
                let ends = front.iter().zip(back);
                let light = ends.map(|(front, back)| {
                    let (near, far) = (rounded(front, format), rounded(back, format));
                    Ok(Light::linear(&near, &far, &length)?)
                });
                try_row(light)
            }
            _ => Ok(none()),
        },
        model => {
            let looked = layout.look(&task.stretch, model.evaluations())?;
            let columns = looked
                .columns
                .emission
                .iter()
                .zip(&looked.columns.extinction);
            let light = columns.map(|(emission, extinction)| {
                by_points(model, emission, extinction, &looked.table, &looked.length)
            });
            Ok(row(light))
        }
    }
}
