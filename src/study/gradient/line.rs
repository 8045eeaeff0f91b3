//! What a derivative shows on a case, in one norm.

use super::{Derivative, Norm, Trouble};
use crate::convergence::{Fit, Sample, Verdict};
use crate::method::Expected;

/// One derivative of a case in one norm.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// By which numbers.
    pub derivative: Derivative,
    /// How the errors of a level become one.
    pub norm: Norm,
    /// The order that is expected, where theory says one.
    pub expected: Option<Expected>,
    /// The order.
    pub fit: Fit,
    /// What it was fitted to: errors as parts of the derivative's scale.
    pub samples: Vec<Sample>,
    /// What that says of the kernel.
    pub standing: Standing,
}

/// What a line says of a kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Standing {
    /// The order is the one expected.
    Confirmed,
    /// It is not, or something is wrong whatever the order is.
    Contradicted,
    /// What was measured cannot tell.
    Inconclusive,
    /// Levels were not answered.
    Failed,
}

impl Standing {
    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Standing::Confirmed => "confirmed",
            Standing::Contradicted => "contradicted",
            Standing::Inconclusive => "inconclusive",
            Standing::Failed => "failed",
        }
    }

    pub(super) fn of(
        verdict: Verdict,
        expected: Option<Expected>,
        trouble: Option<&Trouble>,
        failed: bool,
    ) -> Self {
        // A right derivative converges on any case; where nothing is expected, any order will do.
        let is_low = match expected {
            Some(Expected::Order(_)) => verdict == Verdict::TooLow,
            _ => false,
        };
        let does_not_converge = [Verdict::Stalled, Verdict::Diverged, Verdict::NotFinite];
        if failed {
            Standing::Failed
        } else if trouble.is_some() || is_low || does_not_converge.contains(&verdict) {
            Standing::Contradicted
        } else if verdict.passes(expected) {
            Standing::Confirmed
        } else {
            Standing::Inconclusive
        }
    }
}

impl Line {
    /// The order and the half-width of its interval, where there is a window for one.
    #[must_use]
    pub fn order(&self) -> Option<(f64, f64)> {
        self.fit.window?;
        self.fit.order.zip(self.fit.half_width)
    }

    /// The error at the finest level, as a part of the scale.
    #[must_use]
    pub fn finest(&self) -> Option<f64> {
        self.samples.last().map(|sample| sample.error.to_f64())
    }
}
