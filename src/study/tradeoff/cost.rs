//! By which cost points are compared.

use super::Point;
use serde::Serialize;
use std::fmt;

/// By which cost points are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Cost {
    /// How often the medium was evaluated.
    Evaluations,
    /// How many operations and functions it took, whatever the format.
    Operations,
    /// Nanoseconds by the model.
    Modelled,
    /// Nanoseconds, measured.
    Measured,
}

impl Cost {
    /// Whether it takes times: those differ from run to run.
    #[must_use]
    pub fn is_timed(self) -> bool {
        matches!(self, Cost::Modelled | Cost::Measured)
    }

    /// The cost of a point, `None` where it is unknown; never 0, NaN or infinite.
    #[must_use]
    pub fn of(self, point: &Point) -> Option<f64> {
        let cost = match self {
            Cost::Evaluations => Some(point.counts.evaluations() as f64),
            Cost::Operations => Some(point.counts.operations() as f64),
            Cost::Modelled => point.modelled,
            Cost::Measured => point.measured.map(|timing| timing.median),
        };
        cost.filter(|cost| cost.is_finite() && *cost > 0.0)
    }

    /// The cost in words, for an axis.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Cost::Evaluations => "evaluations of the medium",
            Cost::Operations => "operations",
            Cost::Modelled => "modelled time, ns",
            Cost::Measured => "measured time, ns",
        }
    }
}

impl fmt::Display for Cost {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Cost::Evaluations => "evaluations",
            Cost::Operations => "operations",
            Cost::Modelled => "modelled",
            Cost::Measured => "measured",
        })
    }
}
