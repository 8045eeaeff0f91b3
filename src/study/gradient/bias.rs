//! The bias of a gradient that is drawn at random, beside its standard error.

use super::{Derivative, Standing, Trouble};
use crate::convergence::{LevelMoments, StochasticFit, Verdict};
use crate::method::Expected;

/// Means that are known no better than this, as a part of theory, show nothing.
const RESOLVED: f64 = 0.01;
/// Bias of a lower order does not fall.
const FLAT: f64 = 0.1;
/// Seeds resolve a bias at coarse levels, where the next power has a part: an order is lower where it is so by more.
const SLACK: f64 = 0.5;
/// So many of the finest levels decide.
const FINEST: usize = 4;

/// What the derivatives of a ray are summed with, so that they are one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Against {
    /// 1: the derivative by a change that is the same everywhere.
    Sum,
    /// Theory itself: a factor shows most.
    Theory,
}

impl Against {
    /// Both.
    pub const ALL: [Against; 2] = [Against::Sum, Against::Theory];

    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Against::Sum => "sum",
            Against::Theory => "theory",
        }
    }
}

/// What means over seeds say.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Biased {
    /// No mean of the finest levels is off by more than chance, and they are known well enough to tell.
    No,
    /// Means are off, and fall with the step as fast as expected.
    Falls,
    /// Means are off, and fall more slowly than expected or not at all.
    Stays,
    /// Means are off; how they fall is not told by so few seeds.
    Open,
    /// Standard errors are too large to tell.
    Unresolved,
    /// Something is no number.
    NotFinite,
}

impl Biased {
    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Biased::No => "no bias",
            Biased::Falls => "bias falls",
            Biased::Stays => "biased",
            Biased::Open => "bias open",
            Biased::Unresolved => "unresolved",
            Biased::NotFinite => "not finite",
        }
    }
}

/// One derivative of a case, summed along the ray: errors over seeds as parts of what theory has.
#[derive(Clone, Debug, PartialEq)]
pub struct Bias {
    /// By which numbers.
    pub derivative: Derivative,
    /// With what it is summed.
    pub against: Against,
    /// The order that a bias has to fall with, where theory says one.
    pub expected: Option<Expected>,
    /// Mean, standard deviation and standard error of every level, and the orders of both.
    pub fit: StochasticFit,
    /// What the means say.
    pub biased: Biased,
    /// What that says of the kernel.
    pub standing: Standing,
}

impl Bias {
    pub(super) fn new(
        (derivative, against): (Derivative, Against),
        expected: Option<Expected>,
        fit: StochasticFit,
        trouble: Option<&Trouble>,
        failed: bool,
    ) -> Self {
        let biased = judged(&fit, expected);
        let standing = match biased {
            _ if failed => Standing::Failed,
            _ if trouble.is_some() => Standing::Contradicted,
            Biased::Stays | Biased::NotFinite => Standing::Contradicted,
            Biased::No | Biased::Falls => Standing::Confirmed,
            Biased::Open | Biased::Unresolved => Standing::Inconclusive,
        };
        Bias {
            derivative,
            against,
            expected,
            fit,
            biased,
            standing,
        }
    }

    /// The finest level, of those with a bias where one was seen.
    #[must_use]
    pub fn finest(&self) -> Option<&LevelMoments> {
        let biased = self.fit.levels.iter().rfind(|level| level.biased);
        biased
            .filter(|_| self.biased != Biased::No)
            .or(self.fit.levels.last())
    }

    /// By how many standard errors the mean of a level is off at most, of the finest that decide; infinite where all seeds
    /// have one answer.
    #[must_use]
    pub fn standard_errors(&self) -> f64 {
        let finest = self.fit.levels.iter().rev().take(FINEST);
        let off = finest.filter(|level| level.mean != 0.0);
        off.map(|level| level.mean.abs() / level.standard_error)
            .fold(0.0, f64::max)
    }
}

fn judged(fit: &StochasticFit, expected: Option<Expected>) -> Biased {
    if fit.verdict == Verdict::NotFinite {
        return Biased::NotFinite;
    }
    let finest = || fit.levels.iter().rev().take(FINEST);
    if !finest().any(|level| level.biased) {
        // A bias that does not fall shows where the mean is known best.
        let best = finest().map(|level| level.standard_error);
        let is_known = best.fold(f64::INFINITY, f64::min) <= RESOLVED;
        return if is_known {
            Biased::No
        } else {
            Biased::Unresolved
        };
    }
    let least = match expected {
        Some(Expected::Order(order)) => order - SLACK,
        _ => FLAT,
    };
    match fit.bias {
        Some(order) if order.high < least => Biased::Stays,
        Some(order) if order.low > FLAT => Biased::Falls,
        _ => Biased::Open,
    }
}
