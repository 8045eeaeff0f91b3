//! Why there is no plan.

use crate::method::MethodError;
use crate::quadrature::RuleError;
use crate::reference::ReferenceError;

/// Why there is no plan, or none that can be run.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// No error can be below the tolerance.
    #[error("a tolerance of {tolerance} (allowed: a finite number above 0)")]
    Tolerance {
        /// What is asked for.
        tolerance: f64,
    },
    /// No allowed format is good enough.
    #[error(
        "no allowed format reaches a tolerance of {tolerance:e}: {best} rounds by {rounding:.1e}, and {left:.1e} is left for rounding (allowed: about {bits} bits, as in --format mpfr:{bits}, or a larger tolerance)"
    )]
    Format {
        /// What is asked for.
        tolerance: f64,
        /// The best of the formats.
        best: String,
        /// By how much it rounds.
        rounding: f64,
        /// By how much it may.
        left: f64,
        /// The bits that would do.
        bits: u32,
    },
    /// A medium whose values cannot be bounded.
    #[error(
        "medium {medium} is not resolved near lambda = {lambda}: C or tau has no bound there that a plan could rest on (allowed: media that are analytic but for a few places, and finite)"
    )]
    NotResolved {
        /// The medium's name.
        medium: String,
        /// Where, to the nearest binary64.
        lambda: f64,
    },
    /// A break that is not known well enough.
    #[error(
        "where the formulas of the media break is known to {blur:.1e} only, which may cost {error:.1e} (allowed: a tolerance above that, or breaks with a closed form)"
    )]
    Blur {
        /// How well all breaks are known.
        blur: f64,
        /// What that may do to the radiance.
        error: f64,
    },
    /// Too much precision is lost in the media themselves.
    #[error(
        "the radiance is not known to {tolerance:e} with {bits} bits (allowed: a larger tolerance, or media whose formulas cancel less)"
    )]
    Bits {
        /// What is asked for.
        tolerance: f64,
        /// The bits that were tried last.
        bits: u32,
    },
    /// Models that are too coarse, all of them.
    #[error(
        "no models that are tried add up to less than {tolerance:e} (allowed: a larger tolerance, or media of more pieces)"
    )]
    Models {
        /// What is asked for.
        tolerance: f64,
    },
    /// Too much to do.
    #[error(
        "a plan takes more than {work:e} products of numbers (allowed: a larger tolerance, fewer pieces, or media without narrow features)"
    )]
    Work {
        /// How many it may take, of binary64.
        work: u64,
    },
    /// A plan of another scene.
    #[error("the plan is for scene {plan}, not {scene} (allowed: the scene that it was made for)")]
    OtherScene {
        /// The fingerprint in the plan.
        plan: String,
        /// That of the scene.
        scene: String,
    },
    /// A stored plan that does not hang together.
    #[error("step {step}: {reason} (allowed: plans as volver plan writes them)")]
    Step {
        /// Which one, from 1.
        step: usize,
        /// What is wrong.
        reason: String,
    },
    /// A number that no format of the plan holds.
    #[error(
        "{channel}the radiance is {value} in {format} (allowed: finite; a format of more range)"
    )]
    NotFinite {
        /// The name of the channel and a colon, where it has one.
        channel: String,
        /// What came out.
        value: String,
        /// In which format.
        format: String,
    },
    /// A closed form that cannot be evaluated.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// The radiance itself cannot be had.
    #[error("the radiance to compare with: {0}")]
    Reference(#[from] ReferenceError),
    /// A rule of no points, or too many.
    #[error(transparent)]
    Rule(#[from] RuleError),
}

impl PlanError {
    /// Whether a format of more range may do.
    pub(super) fn is_of_range(&self) -> bool {
        matches!(
            self,
            PlanError::NotFinite { .. } | PlanError::Method(MethodError::ThickSegment { .. })
        )
    }
}
