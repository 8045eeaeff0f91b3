//! What a recipe makes of a ray.

use super::linear::LinearSegments;
use super::ray::Sample;
use super::{EmissionModel, End, Ends, OpacityModel, Places, Ray, Recipe};
use crate::case::Transfer;
use crate::method::OpacityFormula;
use crate::real::{Format, Native, Real};
use std::convert::identity;

/// The length that renderers give the last segment to make a wall of it: what absorbs nothing stays clear.
pub const WALL_LENGTH: i64 = 10_000_000_000;

/// What one segment does: I += T·adds, T ·= passes.
#[derive(Clone, Debug)]
pub(super) struct Step<R> {
    pub(super) adds: R,
    pub(super) passes: R,
}

/// The recipe's radiance of the ray; what is accumulated goes through `keep` after every segment.
///
/// I ← keep(I + T·aⱼ), T ← keep(T·pⱼ) from the front on, with aⱼ and pⱼ of the recipe's opacity and
/// emission, until T is under the recipe's stop.
pub(super) fn radiance_kept<R: Real>(
    recipe: &Recipe,
    ray: &Ray<R>,
    format: R::Format,
    keep: impl Fn(R) -> R,
) -> R {
    composited(recipe, ray, format, OpacityFormula::Expm1, keep)
}

fn composited<R: Real>(
    recipe: &Recipe,
    ray: &Ray<R>,
    format: R::Format,
    formula: OpacityFormula,
    keep: impl Fn(R) -> R,
) -> R {
    let stop = recipe.stop.map(|stop| format.binary64(stop));
    let mut radiance = format.int(0);
    let mut transmittance = format.int(1);
    for step in steps_by(recipe, ray, format, formula) {
        radiance = keep(radiance + &(step.adds * &transmittance));
        transmittance = keep(transmittance * &step.passes);
        if stop.as_ref().is_some_and(|stop| transmittance < *stop) {
            break;
        }
    }
    radiance
}

/// The recipe's radiance of the ray in the ray's own format.
pub fn radiance<R: Real>(recipe: &Recipe, ray: &Ray<R>, format: R::Format) -> R {
    radiance_kept(recipe, ray, format, identity)
}

/// The same with exact opacities by another formula, which rounds otherwise.
pub fn radiance_by<R: Real>(
    recipe: &Recipe,
    ray: &Ray<R>,
    format: R::Format,
    formula: OpacityFormula,
) -> R {
    composited(recipe, ray, format, formula, identity)
}

/// Σ |T·aⱼ|: what a radiance is made of, where terms cancel.
pub(super) fn terms(recipe: &Recipe, ray: &Ray<f64>) -> f64 {
    let (mut sum, mut transmittance) = (0.0, 1.0_f64);
    for step in steps(recipe, ray, Native::<f64>::new()) {
        sum += (transmittance * step.adds).abs();
        transmittance *= step.passes;
    }
    sum
}

/// What every segment does, from the eye on.
pub(super) fn steps<R: Real>(recipe: &Recipe, ray: &Ray<R>, format: R::Format) -> Vec<Step<R>> {
    steps_by(recipe, ray, format, OpacityFormula::Expm1)
}

fn steps_by<R: Real>(
    recipe: &Recipe,
    ray: &Ray<R>,
    format: R::Format,
    formula: OpacityFormula,
) -> Vec<Step<R>> {
    let mut steps = match recipe.places {
        Places::Ends => trapezoids(ray, format),
        Places::Linear => linear(ray, format),
        Places::Front | Places::Middle | Places::Back => sampled(recipe, ray, format, formula),
    };
    if recipe.swapped {
        steps.reverse();
    }
    steps
}

fn sampled<R: Real>(
    recipe: &Recipe,
    ray: &Ray<R>,
    format: R::Format,
    formula: OpacityFormula,
) -> Vec<Step<R>> {
    let mut samples = ray.samples(recipe.places);
    let Ends {
        first,
        last,
        one_extra,
    } = recipe.ends;
    match last {
        End::Kept => {}
        End::Dropped => {
            samples.pop();
        }
        End::Doubled => samples.extend(samples.last().cloned()),
    }
    match first {
        End::Kept => {}
        End::Dropped => {
            samples.drain(..samples.len().min(1));
        }
        End::Doubled => {
            if let Some(first) = samples.first().cloned() {
                samples.insert(0, first);
            }
        }
    }
    if one_extra {
        match ray.extra(recipe.places) {
            Some(extra) if recipe.places == Places::Back => samples.insert(0, extra),
            extra => samples.extend(extra),
        }
    }
    let opacity = Opacity::new(recipe.opacity, format, formula);
    let last = samples.len().saturating_sub(1);
    let step = |(j, sample): (usize, &Sample<R>)| {
        let (alpha, passes) = if recipe.wall && j == last {
            opacity.of(&Sample {
                length: format.int(WALL_LENGTH),
                ..sample.clone()
            })
        } else {
            opacity.of(sample)
        };
        let emission = sample.transfer.emission.clone();
        let adds = match recipe.emission {
            EmissionModel::TimesOpacity => emission * &alpha,
            EmissionModel::Unweighted => emission,
            EmissionModel::TimesOpacityTwice => emission * &alpha * &alpha,
        };
        Step { adds, passes }
    };
    samples.iter().enumerate().map(step).collect()
}

/// An opacity model with its parameters in a format.
struct Opacity<R> {
    model: OpacityModel,
    /// ℓ or κ.
    parameter: R,
    threshold: R,
    one: R,
    /// How an exact opacity is computed.
    formula: OpacityFormula,
}

impl<R: Real> Opacity<R> {
    fn new(model: OpacityModel, format: R::Format, formula: OpacityFormula) -> Self {
        let (of_length, threshold) = match model {
            OpacityModel::Exact | OpacityModel::Linear | OpacityModel::Unattenuated => (0.0, 0.0),
            OpacityModel::Uncorrected { length } => (length, 0.0),
            OpacityModel::Rescaled { factor } => (factor, 0.0),
            OpacityModel::SkippedUnder { threshold, length } => (length, threshold),
        };
        Opacity {
            model,
            parameter: format.binary64(of_length),
            threshold: format.binary64(threshold),
            one: format.int(1),
            formula,
        }
    }

    /// (α, what is let through).
    fn of(&self, sample: &Sample<R>) -> (R, R) {
        let extinction = sample.transfer.extinction.clone();
        let depth = |extinction: R| extinction * &sample.length;
        let exact = |depth: R| (self.formula.of(&depth), (-depth).exp());
        match self.model {
            OpacityModel::Exact => exact(depth(extinction)),
            OpacityModel::Linear => {
                let depth = depth(extinction);
                (depth.clone(), self.one.clone() - &depth)
            }
            OpacityModel::Unattenuated => {
                let depth = depth(extinction);
                (depth.clone(), (-depth).exp())
            }
            OpacityModel::Uncorrected { .. } => exact(extinction * &self.parameter),
            OpacityModel::Rescaled { .. } => exact(depth(extinction) * &self.parameter),
            OpacityModel::SkippedUnder { .. } => {
                let table = exact(extinction.clone() * &self.parameter);
                if table.0 > self.threshold {
                    exact(depth(extinction))
                } else {
                    table
                }
            }
        }
    }
}

/// C τ e^(−t) and t by trapezoids.
fn trapezoids<R: Real>(ray: &Ray<R>, format: R::Format) -> Vec<Step<R>> {
    let half = format.fraction(1, 2);
    let source = |at: &Transfer<R>| at.emission.clone() * &at.extinction;
    let ends = ray.edges.iter().zip(ray.edges.iter().skip(1));
    let steps = ends.zip(&ray.lengths).map(|((near, far), length)| {
        let width = length.clone() * &half;
        let depth = (near.extinction.clone() + &far.extinction) * &width;
        let passes = (-depth).exp();
        let adds = (source(near) + &(source(far) * &passes)) * &width;
        Step { adds, passes }
    });
    steps.collect()
}

fn linear<R: Real>(ray: &Ray<R>, format: R::Format) -> Vec<Step<R>> {
    let rule = LinearSegments::new(format);
    let ends = ray.edges.iter().zip(ray.edges.iter().skip(1));
    let steps = ends.zip(&ray.lengths).map(|((near, far), length)| {
        let (adds, passes) = rule.segment(near, far, length);
        Step { adds, passes }
    });
    steps.collect()
}
