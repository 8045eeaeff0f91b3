//! The ray of a task, whoever makes it up.

use super::Subject;
use crate::case::SymbolicCase;
use rug::Rational;
use std::fmt::Debug;

/// A ray with its channels: a case, or one that asks a kernel what it computes.
pub trait Medium: Debug + Sync {
    /// Its name.
    fn name(&self) -> &str;

    /// The names of the channels, at least one.
    fn channels(&self) -> &[String];

    /// D.
    fn length(&self) -> &Rational;

    /// τ(λ), and into `emission` C(λ) of every channel, in their order.
    fn at(&self, lambda: f64, emission: &mut [f64]) -> f64;

    /// What comes from behind the end of the ray, of every channel; nothing where it is empty.
    fn background(&self) -> &[f64] {
        &[]
    }

    /// Whether emission is the source term j per length already: where nothing absorbs no C has one.
    fn is_per_length(&self) -> bool {
        false
    }

    /// The case of each channel, where the ray is made of cases.
    fn cases(&self) -> &[SymbolicCase] {
        &[]
    }
}

impl Medium for Subject {
    fn name(&self) -> &str {
        self.name()
    }

    fn channels(&self) -> &[String] {
        self.channels()
    }

    fn length(&self) -> &Rational {
        self.length()
    }

    fn at(&self, lambda: f64, emission: &mut [f64]) -> f64 {
        self.at(lambda, emission)
    }

    fn background(&self) -> &[f64] {
        self.background()
    }

    fn cases(&self) -> &[SymbolicCase] {
        self.cases()
    }
}
