//! A recipe's free parameter, from the values.

use super::march::radiance;
use super::{Accuracy, OpacityModel, Recipe, Watched, WatchedLevel};
use crate::real::Native;

/// Factors κ looked at, as powers of two.
const EXPONENTS: (i32, i32) = (-12, 12);
/// Places looked at between neighbouring powers of two.
const BETWEEN: i32 = 3;
/// Halvings of what contains a root.
const HALVINGS: u32 = 60;

/// Opacity models with a parameter still to be found.
#[derive(Clone, Copy, Debug)]
pub(super) enum Free {
    /// ℓ of [`OpacityModel::Uncorrected`].
    Length,
    /// κ of [`OpacityModel::Rescaled`].
    Factor,
}

impl Free {
    /// The model in which the depths of segments of length `step` are multiplied by `factor`.
    fn model(self, factor: f64, step: f64) -> OpacityModel {
        match self {
            Free::Length => OpacityModel::Uncorrected {
                length: factor * step,
            },
            Free::Factor => OpacityModel::Rescaled { factor },
        }
    }
}

/// Recipes with a parameter that makes one level of one channel agree, and a further level too.
pub(super) fn solved(
    recipe: &Recipe,
    free: Free,
    probes: &[&Watched],
    accuracy: Accuracy,
) -> Vec<Recipe> {
    let mut found: Vec<Recipe> = Vec::new();
    for probe in probes {
        let [coarse, next, ..] = &probe.levels[..] else {
            continue;
        };
        let Some(step) = coarse.ray.lengths.first() else {
            continue;
        };
        for factor in factors(recipe, coarse) {
            let with = |opacity| Recipe { opacity, ..*recipe };
            let mut solved = with(free.model(factor, *step));
            // A parameter is a round number more often than not.
            let round = with(free.model(rounded(factor * step) / step, *step));
            let is_round = |one: &Recipe| coarse.agrees(value(one, coarse), probe.scale, accuracy);
            if matches!(free, Free::Length) && is_round(&round) {
                solved = round;
            }
            let round = with(free.model(rounded(factor), *step));
            if matches!(free, Free::Factor) && is_round(&round) {
                solved = round;
            }
            if solved.opacity == free.model(1.0, *step) {
                // Corrected as it should be.
                continue;
            }
            let agrees = next.agrees(value(&solved, next), probe.scale, accuracy);
            if agrees && !found.contains(&solved) {
                found.push(solved);
            }
        }
    }
    found
}

/// To nine digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.8e}").parse().unwrap_or(x)
}

fn value(recipe: &Recipe, level: &WatchedLevel) -> f64 {
    radiance(recipe, &level.ray, Native::<f64>::new())
}

/// All κ at which the recipe gives the level's value.
fn factors(recipe: &Recipe, level: &WatchedLevel) -> Vec<f64> {
    let excess = |factor: f64| {
        let opacity = OpacityModel::Rescaled { factor };
        value(&Recipe { opacity, ..*recipe }, level) - level.value
    };
    let (first, last) = EXPONENTS;
    let places = (first * BETWEEN)..=(last * BETWEEN);
    let places: Vec<(f64, f64)> = places
        .map(|k| (f64::from(k) / f64::from(BETWEEN)).exp2())
        .map(|factor| (factor, excess(factor)))
        .collect();
    let changes = places.windows(2).filter_map(|pair| match pair {
        [(low, below), (high, above)] if (*below < 0.0) != (*above < 0.0) => Some((*low, *high)),
        _ => None,
    });
    let root = |(mut low, mut high): (f64, f64)| {
        let is_negative = excess(low) < 0.0;
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(low, high);
            if (excess(middle) < 0.0) == is_negative {
                low = middle;
            } else {
                high = middle;
            }
        }
        f64::midpoint(low, high)
    };
    changes.map(root).collect()
}
