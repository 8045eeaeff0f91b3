//! A plan as it is kept.

use super::Model;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The version of stored plans.
pub(super) const VERSION: u32 = 1;

/// A plan as it is kept in a file: for one scene, in full.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[schemars(title = "A plan of volver")]
pub struct StoredPlan {
    /// The version of this form.
    pub plan: u32,
    /// The fingerprint of the scene.
    pub scene: String,
    /// What the radiance of every channel may be off by.
    pub tolerance: f64,
    /// The format that it is for.
    pub format: String,
    /// From front to back, without gaps.
    pub steps: Vec<Step>,
    /// Where the ray may end: nothing behind it matters.
    pub stop: Option<String>,
    /// How often C and τ are evaluated.
    pub evaluations: u64,
    /// What the plan itself errs by at most.
    pub uncertainty: Uncertainty,
    /// What came of it; nothing before it was run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub checked: Option<Checked>,
}

impl StoredPlan {
    /// The JSON Schema of a stored plan.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        schemars::schema_for!(StoredPlan).to_value()
    }
}

/// The model of a stretch.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub struct Step {
    /// The number of the medium, from 1.
    pub medium: usize,
    /// Where it begins, exactly.
    pub from: String,
    /// Where it ends, exactly.
    pub to: String,
    /// What stands for it.
    #[serde(flatten)]
    pub model: Model,
    /// What it makes the radiance err by at most.
    pub bound: f64,
    /// How that comes about.
    pub because: Because,
}

/// The arithmetic of a bound, in the channel where it is largest: T (|Ẽ − E| + |e^(−t̃) − e^(−t)| R).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Because {
    /// The channel, from 1.
    pub channel: usize,
    /// T in front of the stretch.
    pub front: f64,
    /// |Ẽ − E|: what its own light errs by.
    pub radiance: f64,
    /// |e^(−t̃) − e^(−t)|: what its transmittance errs by.
    pub transmittance: f64,
    /// R: the light that comes in from behind.
    pub behind: f64,
}

impl Because {
    /// T (|Ẽ − E| + |e^(−t̃) − e^(−t)| R); ∞ where that is no number, which no maximum would pass on.
    #[must_use]
    pub fn error(&self) -> f64 {
        // Nothing behind makes no transmittance wrong.
        let passed = if self.behind == 0.0 {
            0.0
        } else {
            self.transmittance * self.behind
        };
        if self.front == 0.0 {
            return 0.0;
        }
        let error = self.front * (self.radiance + passed);
        if error.is_nan() { f64::INFINITY } else { error }
    }
}

/// What came of a plan when it was run, beside the radiance to many digits.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Checked {
    /// By channel.
    pub channels: Vec<CheckedChannel>,
}

/// One channel of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CheckedChannel {
    /// Its name, empty where the scene names none.
    pub channel: String,
    /// What the plan gave, as it prints.
    pub radiance: String,
    /// The radiance to many digits.
    pub reference: String,
    /// How far they are apart.
    pub error: f64,
}

/// Where the error of a plan comes from; all of it is at most the tolerance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Uncertainty {
    /// The bounds of all steps.
    pub models: f64,
    /// What the radiance was known to when these were found.
    pub reference: f64,
    /// What rounding does in the plan's format.
    pub rounding: f64,
}

impl Uncertainty {
    /// The sum.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.models + self.reference + self.rounding
    }
}
