//! What may stand for a stretch of a ray.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// How the light of a stretch is modelled: from front to back E + e^(−t) times what comes from behind.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "model", rename_all = "kebab-case")]
pub enum Model {
    /// E = 0, t = 0: nothing is there, or nothing that matters.
    Nothing,
    /// E = ∑ w C τ, t = 0: what is attenuated is neglected.
    EmissionOnly {
        /// Gauss–Legendre points.
        points: u32,
    },
    /// E = 0, t = ∑ w τ: what is emitted is neglected.
    AbsorptionOnly {
        /// Gauss–Legendre points.
        points: u32,
    },
    /// C and τ the same everywhere: E = C (1 − e^(−t)), t = τ h.
    Constant,
    /// C the same everywhere: E = C (1 − e^(−t)), t = ∑ w τ.
    ConstantEmission {
        /// Gauss–Legendre points.
        points: u32,
    },
    /// C and τ linear: the closed form with erf or Dawson's function, evaluated so that it is stable for slopes
    /// that vanish.
    Linear,
    /// E = ∑ w C τ e^(−t) with t the integral of the polynomial through τ at the points.
    Quadrature {
        /// Gauss–Legendre points.
        points: u32,
    },
}

impl Model {
    /// How often C and τ are evaluated.
    #[must_use]
    pub fn evaluations(self) -> u32 {
        match self {
            Model::Nothing => 0,
            Model::Constant => 1,
            Model::Linear => 2,
            Model::EmissionOnly { points }
            | Model::AbsorptionOnly { points }
            | Model::ConstantEmission { points }
            | Model::Quadrature { points } => points,
        }
    }

    /// The points of its rule, where it has one.
    #[must_use]
    pub fn points(self) -> Option<u32> {
        match self {
            Model::EmissionOnly { points }
            | Model::AbsorptionOnly { points }
            | Model::ConstantEmission { points }
            | Model::Quadrature { points } => Some(points),
            Model::Nothing | Model::Constant | Model::Linear => None,
        }
    }

    /// What it leaves out, in words; nothing where it is exact but for rounding.
    #[must_use]
    pub fn omission(self) -> &'static str {
        match self {
            Model::Nothing => "emission and absorption",
            Model::EmissionOnly { .. } => "absorption",
            Model::AbsorptionOnly { .. } => "emission",
            Model::Constant | Model::Linear => "nothing",
            Model::ConstantEmission { .. } | Model::Quadrature { .. } => {
                "what lies between the points"
            }
        }
    }
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let points = |points: u32| {
            if points == 1 {
                "1 point".to_string()
            } else {
                format!("{points} points")
            }
        };
        let text = match self {
            Model::Nothing => "nothing".to_string(),
            Model::EmissionOnly { points: p } => format!("emission only, {}", points(*p)),
            Model::AbsorptionOnly { points: p } => format!("absorption only, {}", points(*p)),
            Model::Constant => "constant, closed form".to_string(),
            Model::ConstantEmission { points: p } => {
                format!("constant emission, closed form, {}", points(*p))
            }
            Model::Linear => "linear, closed form".to_string(),
            Model::Quadrature { points: p } => format!("collocation, {}", points(*p)),
        };
        f.pad(&text)
    }
}
