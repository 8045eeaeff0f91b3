//! What models give, and how near values lie.

use super::march::{radiance, radiance_kept};
use super::{Accumulator, Accuracy, Model, Recipe, Watched, WatchedLevel, fixed};
use crate::case::Nodes;
use crate::real::Native;

/// Correct digits that binary64 can show.
pub(super) const MOST_DIGITS: f64 = 16.0;
/// Quanta by which a fixed-point accumulator may differ from its model's, and more for every so many segments.
const QUANTA: f64 = 2.0;
const SEGMENTS_A_QUANTUM: f64 = 16.0;

/// A fixed-point accumulator's rounding depends on the order of every operation.
pub(super) fn in_quanta(model: &Model, level: &WatchedLevel, accuracy: Accuracy) -> Accuracy {
    let Model::Recipe(Recipe {
        accumulator: Accumulator::Fixed { bits, scale, .. },
        ..
    }) = model
    else {
        return accuracy;
    };
    let quanta = QUANTA + level.ray.count() as f64 / SEGMENTS_A_QUANTUM;
    Accuracy {
        quantum: 2.0 * quanta / scale.quanta(*bits),
        ..accuracy
    }
}

/// The model's values at all levels, with the nodes of the channel's case, those of a recipe as they are asked for;
/// `None` where it has none for one of them.
pub(super) fn values<'v, N: Nodes<Format = Native<f64>>>(
    model: &'v Model,
    watched: &'v Watched,
    nodes: &N,
) -> Option<Box<dyn Iterator<Item = f64> + 'v>> {
    let levels = watched.levels.iter();
    match model {
        Model::Recipe(recipe) => Some(Box::new(levels.map(|level| of_recipe(recipe, level)))),
        Model::Method(method) => {
            let values = levels.map(|level| method.radiance(nodes, level.uniform?).ok());
            let values: Option<Vec<f64>> = values.collect();
            Some(Box::new(values?.into_iter()))
        }
    }
}

fn of_recipe(recipe: &Recipe, level: &WatchedLevel) -> f64 {
    let format = Native::<f64>::new();
    match recipe.accumulator {
        Accumulator::Float | Accumulator::Binary32 => radiance(recipe, &level.ray, format),
        Accumulator::Fixed {
            bits,
            scale,
            rounding,
        } => radiance_kept(recipe, &level.ray, format, |x| {
            fixed::keep(x, bits, scale, rounding)
        }),
    }
}

/// −log₁₀ of the relative difference, from 0 to all that binary64 has.
pub(super) fn correct_digits(value: f64, model: f64) -> f64 {
    if value.to_bits() == model.to_bits() {
        return MOST_DIGITS;
    }
    let difference = ((value - model) / value.abs().max(model.abs())).abs();
    // Adding 0 takes the sign of −0.
    (-difference.log10()).clamp(0.0, MOST_DIGITS) + 0.0
}
