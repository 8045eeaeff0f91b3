//! The search for the simplest model that reproduces most.

use super::candidates::{methods, recipes};
use super::march::{radiance, terms};
use super::model::ENOUGH;
use super::parameter::solved;
use super::stops::{USUAL, explained};
use super::values::{MOST_DIGITS, correct_digits, in_quanta, values};
use super::{
    Accumulator, Accuracy, Fingerprint, FixedRounding, FixedScale, Match, Model, OpacityModel,
    Recipe, Watched, WatchedLevel, fixed,
};
use crate::case::{Shared, SymbolicCase};
use crate::method::Level;
use crate::parallel;
use crate::real::Native;

/// Levels that a model must reproduce before it is tried at all of them.
const SCREENED: usize = 2;
/// Models tried at all levels.
const FINALISTS: usize = 48;
/// 2⁻²⁴, the unit of binary32, tried where the values are coarser than declared.
const BINARY32: f64 = 5.960_464_477_539_063e-8;

/// Compares the values of channels with all models.
pub(super) struct Search<'a> {
    watched: &'a [Watched],
    /// Of each channel's case: thousands of methods look at the same places.
    nodes: Vec<Shared<'a, SymbolicCase, Native<f64>>>,
    accuracy: Accuracy,
    declared: Option<Model>,
}

impl<'a> Search<'a> {
    /// Of these channels, with the model that is declared.
    pub(super) fn new(watched: &'a [Watched], accuracy: Accuracy, declared: Option<Model>) -> Self {
        let nodes = |one: &'a Watched| Shared::new(&one.case, Native::new());
        Search {
            watched,
            nodes: watched.iter().map(nodes).collect(),
            accuracy,
            declared,
        }
    }

    /// The best model of all.
    pub(super) fn run(&self) -> Fingerprint {
        // A quantum that is declared is no discovery, nor is the format.
        let kept_in = fixed::detect(self.watched).filter(|kept| {
            let narrower = self.accuracy.unit < BINARY32 || *kept != Accumulator::Binary32;
            self.accuracy.quantum == 0.0 && narrower
        });
        let declared = self
            .declared
            .and_then(|model| self.compare(model, self.accuracy));
        let of = self.watched.len();
        if let Some(whole) = declared.as_ref().filter(|one| one.agrees.len() == of) {
            // What explains everything needs no rival.
            return Fingerprint {
                best: Some(whole.clone()),
                alike: Vec::new(),
                declared,
                samples_at: None,
            };
        }
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
            samples_at: None,
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
        let screened = parallel::map(&candidates, |candidate| {
            let recipes = if candidate.is_free {
                solved(&candidate.recipe, &probes, accuracy)
            } else {
                vec![candidate.recipe]
            };
            let models = recipes.into_iter().flat_map(|recipe| {
                let explained = explained(&recipe, self.watched, SCREENED, accuracy);
                let stopped = explained.stopped.map(|(count, threshold)| {
                    let stop = Some(threshold);
                    (count, Model::Recipe(Recipe { stop, ..recipe }))
                });
                let plain = (explained.plain, Model::Recipe(recipe));
                std::iter::once(plain).chain(stopped)
            });
            models.collect::<Vec<_>>()
        });
        let methods = self.screened_methods(accuracy);
        let declared = self.declared.map(|model| (usize::MAX, model));
        let mut screened: Vec<(usize, Model)> = declared
            .into_iter()
            .chain(screened.into_iter().flatten())
            .chain(methods)
            .filter(|(count, _)| *count > 0)
            .collect();
        screened.sort_by_key(|(count, model)| (std::cmp::Reverse(*count), model.defects()));
        screened.truncate(FINALISTS);
        let compared = parallel::map(&screened, |(_, model)| self.compare(*model, accuracy));
        compared.into_iter().flatten().collect()
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
            let search = Search::new(&watched, self.accuracy, None);
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
        let channels: Vec<_> = self.watched.iter().zip(&self.nodes).collect();
        let agreeing: Vec<Vec<bool>> = parallel::map(&channels, |(watched, nodes)| {
            let mut agrees = vec![true; methods.len()];
            for level in watched.levels.iter().take(SCREENED) {
                let mut shared = level.uniform.map(|n| Level::new(*nodes, n));
                let both = methods.iter().zip(&mut agrees);
                // What is off at a coarser level need not be computed at a finer one.
                for (method, agrees) in both.filter(|(_, agrees)| **agrees) {
                    let value = shared.as_mut().and_then(|l| l.radiance(method).ok());
                    *agrees = value.is_some_and(|v| level.agrees(v, watched.scale, accuracy));
                }
            }
            agrees
        });
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
        for (index, (watched, nodes)) in self.watched.iter().zip(&self.nodes).enumerate() {
            let Some(values) = values(&model, watched, nodes) else {
                continue;
            };
            compared += 1;
            // One by one, coarse levels first: most models are off there already.
            let mut worst = Some(MOST_DIGITS);
            for (level, value) in watched.levels.iter().zip(values) {
                let accuracy = in_quanta(&model, level, accuracy);
                if !level.agrees(value, watched.scale, accuracy)
                    && !agrees_by_terms(&model, level, value, accuracy)
                {
                    worst = None;
                    break;
                }
                worst = worst.map(|worst| worst.min(correct_digits(level.value, value)));
            }
            if let Some(worst) = worst {
                agrees.push(index);
                digits.push(worst);
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
            .filter(|candidate| !candidate.is_free && candidate.recipe.defects() <= 1);
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
        let compared = parallel::map(&all, |recipe| {
            self.compare(Model::Recipe(*recipe), self.accuracy)
        });
        let found = compared.into_iter().flatten();
        found.filter(|one| !one.agrees.is_empty()).collect()
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

/// Whether it agrees but for the rounding of terms that cancel: linear opacities above 1 make them alternate in sign.
fn agrees_by_terms(model: &Model, level: &WatchedLevel, value: f64, accuracy: Accuracy) -> bool {
    match model {
        Model::Recipe(recipe) if recipe.opacity == OpacityModel::Linear => {
            let terms = terms(recipe, &level.ray);
            terms.is_finite() && level.agrees(value, terms, accuracy)
        }
        Model::Recipe(_) | Model::Method(_) => false,
    }
}
