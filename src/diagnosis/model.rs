//! Models of what a kernel computes, and how well they match.

use super::Recipe;
use crate::method::Method;
use std::fmt;

/// The part of the channels that a model has to reproduce to be named.
pub(super) const ENOUGH: f64 = 0.9;

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
