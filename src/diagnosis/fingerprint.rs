//! Which model reproduces a kernel's values.

use super::model::ENOUGH;
use super::search::Search;
use super::{Accuracy, Match, Model, Places, Watched};
use crate::kernel::{Declaration, Sampling};

/// Decimal digits that it has to reproduce: in a coarse format much agrees that has nothing in common.
const FEWEST_DIGITS: f64 = 1.0;

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
    /// Where the values say that segments are sampled, where that is not as declared.
    pub samples_at: Option<Places>,
}

impl Fingerprint {
    /// Whether the best model explains enough to be named without reserve.
    #[must_use]
    pub fn is_named(&self) -> bool {
        let enough = |best: &Match| {
            best.agrees.len() as f64 >= ENOUGH * best.of as f64 && best.digits >= FEWEST_DIGITS
        };
        self.best.as_ref().is_some_and(enough)
    }

    /// Whether a method was declared and the values are not its, or are sampled elsewhere than declared.
    #[must_use]
    pub fn contradicts_declaration(&self) -> bool {
        let short = |declared: &Match| declared.agrees.len() < declared.of;
        self.declared.as_ref().is_some_and(short) || self.samples_at.is_some()
    }

    /// Where the best model samples, where neither it nor one that is alike samples as declared.
    fn sampled_otherwise(&self, declared: Sampling) -> Option<Places> {
        let places = |model: &Model| match model {
            Model::Recipe(recipe) => Some(recipe.places),
            Model::Method(_) => None,
        };
        let best = self.best.as_ref().filter(|_| self.is_named())?;
        let found = places(&best.model)?;
        let as_declared = |places: Places| match declared {
            Sampling::Front => places == Places::Front,
            Sampling::Middle => places == Places::Middle,
            Sampling::Back => places == Places::Back,
            Sampling::Ends => !places.is_one_sample(),
            // No recipe draws random numbers.
            Sampling::Jittered => false,
        };
        let mut all = self.alike.iter().filter_map(places).chain([found]);
        (!all.any(as_declared)).then_some(found)
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
    let declared = declaration.method.map(|method| {
        let mut model = Model::of_method(method);
        if let Model::Recipe(recipe) = &mut model {
            recipe.wall = declaration.far_wall;
        }
        model
    });
    let search = Search::new(&compared, accuracy, declared);
    let mut found = search.run();
    let restore = |one: &mut Match| {
        for index in &mut one.agrees {
            *index = informative[*index];
        }
    };
    found.samples_at = declaration
        .claimed_sampling()
        .and_then(|declared| found.sampled_otherwise(declared));
    found.best.iter_mut().for_each(restore);
    found.declared.iter_mut().for_each(restore);
    found
}

fn says_something(watched: &Watched) -> bool {
    let finite = watched.levels.iter().all(|level| level.value.is_finite());
    watched.scale > 0.0 && finite && !watched.levels.is_empty()
}
