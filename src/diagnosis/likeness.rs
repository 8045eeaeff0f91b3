//! The defect that an error looks like, where no model reproduces the values themselves.
//!
//! A real renderer rounds tables, positions and colours in ways that no model follows to the last digit. What
//! stands out of that is compared by the error alone: a defect is like it where it makes most of the same
//! error at most levels, and compositing without it does not.

use super::candidates::recipes;
use super::march::radiance;
use super::stops::USUAL;
use super::{Accumulator, Recipe, Watched};
use crate::parallel;
use crate::real::Native;

/// The part of a level's error that a model may leave.
const LEFT: f64 = 0.2;
/// The part of the levels that a defect has to explain …
const ENOUGH: f64 = 0.75;
/// … and compositing without it must not.
const TOO_MUCH: f64 = 0.5;

/// A defect, and how many levels have its error.
#[derive(Clone, Debug, PartialEq)]
pub struct Likeness {
    /// Compositing with that defect.
    pub recipe: Recipe,
    /// Levels explained.
    pub levels: usize,
    /// Levels in all.
    pub of: usize,
}

/// The single defect that makes most of a channel's error; `None` where none does, or none is needed.
///
/// `exact` is the radiance that the kernel should have given.
#[must_use]
pub fn likeness(watched: &Watched, exact: f64) -> Option<Likeness> {
    let of = watched.levels.len();
    let explained = |recipe: &Recipe| {
        let levels = watched.levels.iter();
        let explains = |level: &&super::WatchedLevel| {
            let model = radiance(recipe, &level.ray, Native::<f64>::new());
            (level.value - model).abs() <= LEFT * (level.value - exact).abs()
        };
        levels.filter(explains).count()
    };
    let candidates = recipes().into_iter().filter(|one| !one.is_free);
    let sampled = candidates
        .map(|one| one.recipe)
        .filter(|recipe| recipe.places.is_one_sample() && recipe.defects() <= 1);
    let (sound, defective): (Vec<Recipe>, Vec<Recipe>) =
        sampled.partition(|recipe| recipe.defects() == 0);
    let without = sound.iter().map(explained).max().unwrap_or(0);
    if without as f64 > TOO_MUCH * of as f64 {
        return None;
    }
    let uncorrected = sound.iter().map(|recipe| Recipe {
        opacity: super::OpacityModel::Uncorrected { length: 1.0 },
        ..*recipe
    });
    let uncorrected: Vec<Recipe> = uncorrected.collect();
    let stopped = sound.iter().flat_map(|recipe| {
        USUAL.into_iter().map(|stop| Recipe {
            stop: Some(stop),
            ..*recipe
        })
    });
    let all: Vec<Recipe> = defective
        .into_iter()
        .chain(uncorrected)
        .chain(stopped)
        .collect();
    let counted = parallel::map(&all, |recipe| (explained(recipe), *recipe));
    // The first of several that explain as much: simple and usual ones stand in front.
    let most = counted.iter().map(|(levels, _)| *levels).max()?;
    let (levels, recipe) = counted.into_iter().find(|(levels, _)| *levels == most)?;
    (levels as f64 >= ENOUGH * of as f64).then_some(Likeness { recipe, levels, of })
}

impl Recipe {
    /// The defect alone, of a recipe that has one.
    #[must_use]
    pub fn defect(&self) -> String {
        let whole = self.to_string();
        let sound = Recipe {
            places: self.places,
            opacity: match self.opacity {
                super::OpacityModel::Linear => super::OpacityModel::Linear,
                _ => super::OpacityModel::Exact,
            },
            accumulator: Accumulator::Float,
            ..Recipe::default()
        };
        let prefix = sound.to_string();
        match whole.strip_prefix(&prefix) {
            Some(rest) if !rest.is_empty() => rest.trim_start_matches(", ").into(),
            _ => whole
                .trim_start_matches(&format!("{}, ", self.places))
                .into(),
        }
    }
}
