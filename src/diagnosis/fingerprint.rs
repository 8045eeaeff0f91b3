//! Which model reproduces a kernel's values.

use super::candidates::{methods, recipes};
use super::march::{radiance, radiance_kept};
use super::parameter::solved;
use super::stops::{USUAL, explained};
use super::{
    Accumulator, Accuracy, FixedRounding, FixedScale, Recipe, Watched, WatchedLevel, fixed,
};
use crate::case::{Fresh, Nodes};
use crate::kernel::Declaration;
use crate::method::{Level, Method};
use crate::real::Native;
use rayon::prelude::*;
use std::fmt;

/// Levels that a model must reproduce before it is tried at all of them.
const SCREENED: usize = 2;
/// Models tried at all levels.
const FINALISTS: usize = 48;
/// The part of the channels that a model has to reproduce to be named.
const ENOUGH: f64 = 0.9;
/// 2⁻²⁴, the unit of binary32, tried where the values are coarser than declared.
const BINARY32: f64 = 5.960_464_477_539_063e-8;
/// Correct digits that binary64 can show.
const MOST_DIGITS: f64 = 16.0;
/// Quanta by which a fixed-point accumulator may differ from its model's, and more for every so many segments.
const QUANTA: f64 = 2.0;
const SEGMENTS_A_QUANTUM: f64 = 16.0;

/// What a kernel may compute.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Model {
    /// Compositing, perhaps with defects.
    Recipe(Recipe),
    /// Another method of this crate.
    Method(Method),
}

impl Model {
    /// The model that a method is in exact arithmetic.
    #[must_use]
    pub fn of_method(method: Method) -> Model {
        Recipe::of_method(&method).map_or(Model::Method(method), Model::Recipe)
    }

    /// How many things are wrong with it.
    #[must_use]
    pub fn defects(&self) -> usize {
        match self {
            Model::Recipe(recipe) => recipe.defects(),
            Model::Method(_) => 0,
        }
    }
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Model::Recipe(recipe) => recipe.fmt(f),
            Model::Method(method) => method.fmt(f),
        }
    }
}

/// A model and how well it reproduces the values.
#[derive(Clone, Debug, PartialEq)]
pub struct Match {
    /// The model.
    pub model: Model,
    /// Correct decimal digits of the value that agrees least, of a channel in the middle of those that agree.
    pub digits: f64,
    /// Channels, by index, whose every level agrees.
    pub agrees: Vec<usize>,
    /// Channels compared.
    pub of: usize,
}

/// What the values say a kernel computes.
#[derive(Clone, Debug, PartialEq)]
pub struct Fingerprint {
    /// The model that reproduces most channels, the simplest of several; `None` where none reproduces more
    /// than by chance.
    pub best: Option<Match>,
    /// Other models, with as few defects, that give the same numbers in the same channels.
    pub alike: Vec<Model>,
    /// How well the declared method reproduces them, where there is one that the values can be compared with.
    pub declared: Option<Match>,
    /// What all values are numbers of, where that is coarser than declared.
    pub kept_in: Option<Accumulator>,
}

impl Fingerprint {
    /// Whether the best model explains enough to be named without reserve.
    #[must_use]
    pub fn is_named(&self) -> bool {
        let enough = |best: &Match| best.agrees.len() as f64 >= ENOUGH * best.of as f64;
        self.best.as_ref().is_some_and(enough)
    }

    /// Whether a method was declared and the values are not its.
    #[must_use]
    pub fn contradicts_declaration(&self) -> bool {
        let short = |declared: &Match| declared.agrees.len() < declared.of;
        self.declared.as_ref().is_some_and(short)
    }
}

/// Compares a kernel's values with all models.
///
/// `watched` has the channels rendered at the same levels; those without any radiance say nothing and are left
/// out. A model is screened at the two coarsest levels of all channels, and the best ones are compared at every
/// level. Parameters (a reference length, a threshold) are found from the values.
#[must_use]
pub fn fingerprint(
    watched: &[Watched],
    declaration: &Declaration,
    accuracy: Accuracy,
) -> Fingerprint {
    let informative: Vec<usize> = (0..watched.len())
        .filter(|&index| says_something(&watched[index]))
        .collect();
    let compared: Vec<Watched> = informative.iter().map(|&i| watched[i].clone()).collect();
    let search = Search {
        watched: &compared,
        accuracy,
        declared: declaration.method.map(|method| {
            let mut model = Model::of_method(method);
            if let Model::Recipe(recipe) = &mut model {
                recipe.wall = declaration.far_wall;
            }
            model
        }),
    };
    let mut found = search.run();
    let restore = |one: &mut Match| {
        for index in &mut one.agrees {
            *index = informative[*index];
        }
    };
    found.best.iter_mut().for_each(restore);
    found.declared.iter_mut().for_each(restore);
    found
}

fn says_something(watched: &Watched) -> bool {
    let finite = watched.levels.iter().all(|level| level.value.is_finite());
    watched.scale > 0.0 && finite && !watched.levels.is_empty()
}

struct Search<'a> {
    watched: &'a [Watched],
    accuracy: Accuracy,
    declared: Option<Model>,
}

impl Search<'_> {
    fn run(&self) -> Fingerprint {
        // A quantum that is declared is no discovery, nor is the format.
        let kept_in = fixed::detect(self.watched).filter(|kept| {
            let narrower = self.accuracy.unit < BINARY32 || *kept != Accumulator::Binary32;
            self.accuracy.quantum == 0.0 && narrower
        });
        let declared = self
            .declared
            .and_then(|model| self.compare(model, self.accuracy));
        let mut matches = Vec::new();
        match kept_in {
            Some(Accumulator::Fixed { bits, scale, .. }) => matches = self.in_fixed(bits, scale),
            Some(Accumulator::Binary32) => matches = self.in_binary32(),
            _ => {}
        }
        if !self.is_enough(&matches) {
            matches.extend(self.of(self.accuracy));
        }
        if !self.is_enough(&matches) {
            matches.extend(self.by_tables());
        }
        let may_be_narrower = self.accuracy.unit < BINARY32;
        if may_be_narrower && kept_in.is_none() && !self.is_enough(&matches) {
            matches.extend(self.in_binary32());
        }
        let (best, alike) = self.choose(matches);
        Fingerprint {
            best,
            alike,
            declared,
            kept_in,
        }
    }

    fn is_enough(&self, matches: &[Match]) -> bool {
        let most = matches.iter().map(|one| one.agrees.len()).max();
        most.unwrap_or(0) as f64 >= ENOUGH * self.watched.len() as f64
    }

    /// The same models, as far as binary32 goes.
    fn in_binary32(&self) -> Vec<Match> {
        let mut matches = self.of(Accuracy {
            unit: BINARY32,
            ..self.accuracy
        });
        for one in &mut matches {
            if let Model::Recipe(recipe) = &mut one.model {
                recipe.accumulator = Accumulator::Binary32;
            }
        }
        matches
    }

    /// The best models, compared at all levels.
    fn of(&self, accuracy: Accuracy) -> Vec<Match> {
        let probes = self.probes();
        let candidates = recipes();
        let screened: Vec<(usize, Model)> = candidates
            .par_iter()
            .flat_map_iter(|candidate| {
                let recipes = match candidate.free {
                    None => vec![candidate.recipe],
                    Some(free) => solved(&candidate.recipe, free, &probes, accuracy),
                };
                recipes.into_iter().flat_map(|recipe| {
                    let explained = explained(&recipe, self.watched, SCREENED, accuracy);
                    let stopped = explained.stopped.map(|(count, threshold)| {
                        let stop = Some(threshold);
                        (count, Model::Recipe(Recipe { stop, ..recipe }))
                    });
                    let plain = (explained.plain, Model::Recipe(recipe));
                    std::iter::once(plain).chain(stopped)
                })
            })
            .collect();
        let methods = self.screened_methods(accuracy);
        let declared = self.declared.map(|model| (usize::MAX, model));
        let mut screened: Vec<(usize, Model)> = declared
            .into_iter()
            .chain(screened)
            .chain(methods)
            .filter(|(count, _)| *count > 0)
            .collect();
        screened.sort_by_key(|(count, model)| (std::cmp::Reverse(*count), model.defects()));
        screened.truncate(FINALISTS);
        screened
            .into_par_iter()
            .filter_map(|(_, model)| self.compare(model, accuracy))
            .collect()
    }

    /// The same models with tables looked up in other ways.
    fn by_tables(&self) -> Vec<Match> {
        let lookups = self.watched.first().map_or(&[][..], |one| &one.lookups);
        let mut matches = Vec::new();
        for (index, (lookup, _)) in lookups.iter().enumerate() {
            let watched: Vec<Watched> = self
                .watched
                .iter()
                .map(|watched| watched.looked_up(index))
                .collect();
            let search = Search {
                watched: &watched,
                accuracy: self.accuracy,
                declared: None,
            };
            let mut found = search.of(self.accuracy);
            found.retain(|one| matches!(one.model, Model::Recipe(_)));
            for one in &mut found {
                if let Model::Recipe(recipe) = &mut one.model {
                    recipe.lookup = Some(*lookup);
                }
            }
            matches.extend(found);
        }
        matches
    }

    /// Channels in which the opacity matters most.
    fn probes(&self) -> Vec<&Watched> {
        let format = Native::<f64>::new();
        let sensitivity = |watched: &Watched| {
            let Some(level) = watched.levels.first() else {
                return 0.0;
            };
            let with = |opacity| {
                let recipe = Recipe {
                    opacity,
                    ..Recipe::default()
                };
                radiance(&recipe, &level.ray, format)
            };
            let exact = with(super::OpacityModel::Exact);
            let linear = with(super::OpacityModel::Linear);
            let part = ((exact - linear) / exact).abs();
            // Beyond a certain thickness nothing is seen of what happens behind.
            if part.is_finite() { part.min(0.2) } else { 0.0 }
        };
        let mut probes: Vec<(f64, &Watched)> = self
            .watched
            .iter()
            .map(|watched| (sensitivity(watched), watched))
            .collect();
        probes.sort_by(|a, b| b.0.total_cmp(&a.0));
        probes.into_iter().take(3).map(|(_, probe)| probe).collect()
    }

    /// Methods that agree at the coarsest levels, with the number of channels.
    fn screened_methods(&self, accuracy: Accuracy) -> Vec<(usize, Model)> {
        let methods = methods();
        let agreeing: Vec<Vec<bool>> = self
            .watched
            .par_iter()
            .map(|watched| {
                let nodes = Fresh::new(&watched.case, Native::<f64>::new());
                let mut agrees = vec![true; methods.len()];
                for level in watched.levels.iter().take(SCREENED) {
                    let mut shared = level.uniform.map(|n| Level::new(&nodes, n));
                    for (method, agrees) in methods.iter().zip(&mut agrees) {
                        let value = shared.as_mut().and_then(|l| l.radiance(method).ok());
                        *agrees = *agrees
                            && value.is_some_and(|v| level.agrees(v, watched.scale, accuracy));
                    }
                }
                agrees
            })
            .collect();
        let count = |index: usize| agreeing.iter().filter(|agrees| agrees[index]).count();
        let models = methods.iter().enumerate();
        models
            .map(|(index, method)| (count(index), Model::of_method(*method)))
            .collect()
    }

    /// How well a model reproduces all levels; `None` where it cannot be computed anywhere.
    fn compare(&self, model: Model, accuracy: Accuracy) -> Option<Match> {
        let mut digits = Vec::new();
        let mut agrees = Vec::new();
        let mut compared = 0;
        for (index, watched) in self.watched.iter().enumerate() {
            let values = values(&model, watched);
            let Some(values) = values else { continue };
            compared += 1;
            let both = watched.levels.iter().zip(&values);
            let together = both.clone().all(|(level, value)| {
                let accuracy = in_quanta(&model, level, accuracy);
                level.agrees(*value, watched.scale, accuracy)
            });
            if together {
                agrees.push(index);
                let worst = both.map(|(level, value)| correct_digits(level.value, *value));
                digits.push(worst.fold(MOST_DIGITS, f64::min));
            }
        }
        digits.sort_by(f64::total_cmp);
        (compared > 0).then_some(Match {
            model,
            digits: digits.get(digits.len() / 2).copied().unwrap_or(0.0),
            agrees,
            of: self.watched.len(),
        })
    }

    /// Recipes whose accumulators have that many bits.
    fn in_fixed(&self, bits: u32, scale: FixedScale) -> Vec<Match> {
        let roundings = [FixedRounding::Nearest, FixedRounding::Down];
        let stops = || std::iter::once(None).chain(USUAL.into_iter().map(Some));
        let simple = recipes()
            .into_iter()
            .filter(|candidate| candidate.free.is_none() && candidate.recipe.defects() <= 1);
        let all: Vec<Recipe> = simple
            .flat_map(|candidate| {
                roundings.into_iter().flat_map(move |rounding| {
                    stops().map(move |stop| Recipe {
                        stop,
                        accumulator: Accumulator::Fixed {
                            bits,
                            scale,
                            rounding,
                        },
                        ..candidate.recipe
                    })
                })
            })
            .collect();
        let compared = all
            .into_par_iter()
            .filter_map(|recipe| self.compare(Model::Recipe(recipe), self.accuracy));
        compared.filter(|one| !one.agrees.is_empty()).collect()
    }

    /// The simplest of the models that reproduce most, the declared one before all others, and what is as good.
    fn choose(&self, mut matches: Vec<Match>) -> (Option<Match>, Vec<Model>) {
        let most = matches.iter().map(|one| one.agrees.len()).max();
        let Some(most) = most.filter(|most| *most > 0) else {
            return (None, Vec::new());
        };
        matches.retain(|one| one.agrees.len() == most);
        // Sorting keeps the order of what is alike: simple positions and opacities come first.
        matches.sort_by_key(|one| (Some(one.model) != self.declared, one.model.defects()));
        let mut matches = matches.into_iter();
        let best = matches.next();
        let defects = best.as_ref().map_or(0, |best| best.model.defects());
        let mut alike = Vec::new();
        for one in matches {
            let known = best.as_ref().map(|best| &best.agrees);
            let is_new = Some(&one.model) != best.as_ref().map(|best| &best.model);
            let is_as_simple = one.model.defects() <= defects;
            if known == Some(&one.agrees) && is_new && is_as_simple && !alike.contains(&one.model) {
                alike.push(one.model);
            }
        }
        (best, alike)
    }
}

/// A fixed-point accumulator's rounding depends on the order of every operation.
fn in_quanta(model: &Model, level: &WatchedLevel, accuracy: Accuracy) -> Accuracy {
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

/// The model's values at all levels; `None` where it has none for one of them.
fn values(model: &Model, watched: &Watched) -> Option<Vec<f64>> {
    match model {
        Model::Recipe(recipe) => {
            let levels = watched.levels.iter();
            Some(levels.map(|level| of_recipe(recipe, level)).collect())
        }
        Model::Method(method) => {
            let nodes = Fresh::new(&watched.case, Native::<f64>::new());
            let levels = watched.levels.iter();
            levels
                .map(|level| of_method(method, &nodes, level))
                .collect()
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

fn of_method<N: Nodes<Format = Native<f64>>>(
    method: &Method,
    nodes: &N,
    level: &WatchedLevel,
) -> Option<f64> {
    method.radiance(nodes, level.uniform?).ok()
}

/// −log₁₀ of the relative difference, from 0 to all that binary64 has.
fn correct_digits(value: f64, model: f64) -> f64 {
    if value.to_bits() == model.to_bits() {
        return MOST_DIGITS;
    }
    let difference = ((value - model) / value.abs().max(model.abs())).abs();
    // Adding 0 takes the sign of −0.
    (-difference.log10()).clamp(0.0, MOST_DIGITS) + 0.0
}
