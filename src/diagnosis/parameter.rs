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

/// Opacity models with a parameter to be found.
#[derive(Clone, Copy, Debug)]
enum Free {
    /// ℓ of [`OpacityModel::Uncorrected`].
    Length,
    /// κ of [`OpacityModel::Rescaled`].
    Factor,
}

impl Free {
    const ALL: [Free; 2] = [Free::Length, Free::Factor];

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
pub(super) fn solved(recipe: &Recipe, probes: &[&Watched], accuracy: Accuracy) -> Vec<Recipe> {
    let solved: Vec<_> = probes
        .iter()
        .filter_map(|probe| Solved::new(recipe, probe))
        .collect();
    let mut found: Vec<Recipe> = Vec::new();
    for free in Free::ALL {
        for recipe in solved
            .iter()
            .flat_map(|one| one.recipes(recipe, free, accuracy))
        {
            if !found.contains(&recipe) {
                found.push(recipe);
            }
        }
    }
    found
}

/// The two coarsest levels of a channel, and the factors with which the first agrees.
struct Solved<'a> {
    coarse: &'a WatchedLevel,
    next: &'a WatchedLevel,
    scale: f64,
    step: f64,
    factors: Vec<f64>,
}

impl<'a> Solved<'a> {
    fn new(recipe: &Recipe, probe: &'a Watched) -> Option<Self> {
        let [coarse, next, ..] = &probe.levels[..] else {
            return None;
        };
        Some(Solved {
            coarse,
            next,
            scale: probe.scale,
            step: *coarse.ray.lengths.first()?,
            factors: factors(recipe, coarse),
        })
    }

    /// Those with that parameter that agree at the next level too.
    fn recipes(&self, recipe: &Recipe, free: Free, accuracy: Accuracy) -> Vec<Recipe> {
        let with = |opacity| Recipe { opacity, ..*recipe };
        let agrees = |recipe: &Recipe, level: &WatchedLevel| {
            level.agrees(value(recipe, level), self.scale, accuracy)
        };
        let of_factor = |factor: &f64| {
            // A parameter is a round number more often than not.
            let round = match free {
                Free::Length => rounded(factor * self.step) / self.step,
                Free::Factor => rounded(*factor),
            };
            let round = with(free.model(round, self.step));
            let solved = if agrees(&round, self.coarse) {
                round
            } else {
                with(free.model(*factor, self.step))
            };
            // Corrected as it should be.
            let as_it_should_be = solved.opacity == free.model(1.0, self.step);
            (!as_it_should_be && agrees(&solved, self.next)).then_some(solved)
        };
        self.factors.iter().filter_map(of_factor).collect()
    }
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
