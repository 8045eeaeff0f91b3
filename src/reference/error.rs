//! Why there is no reference value.

use crate::real::{MAX_BITS, MIN_BITS};

/// Why there is no reference value.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReferenceError {
    /// A precision beyond what values are computed in.
    #[error("a reference of {bits} bits (allowed: {MIN_BITS} to {})", MAX_BITS / 4)]
    Bits {
        /// The bits asked for.
        bits: u32,
    },
    /// NaN or infinity from a closed form.
    #[error("the closed form is {value} at the far end (allowed: a finite value)")]
    ClosedFormNotFinite {
        /// What came out.
        value: String,
    },
    /// Digits cancel in a closed form, whatever the precision.
    #[error(
        "the closed form gives {believed} significant bits at a precision of {precision} (allowed: closed forms that give {bits})"
    )]
    Cancelled {
        /// The significant bits that can be believed.
        believed: u32,
        /// The precision it was last evaluated with.
        precision: u32,
        /// The bits asked for.
        bits: u32,
    },
    /// NaN or infinity from the medium.
    #[error(
        "the medium has tau = {extinction} and C = {emission} near lambda = {lambda} (allowed: finite values)"
    )]
    MediumNotFinite {
        /// Where, to the nearest binary64.
        lambda: f64,
        /// τ.
        extinction: f64,
        /// C.
        emission: f64,
    },
    /// A negative extinction.
    #[error("tau < 0 near lambda = {lambda} (allowed: tau >= 0)")]
    NegativeExtinction {
        /// Where, to the nearest binary64.
        lambda: f64,
    },
    /// All light is behind so much extinction that its transmittance is below the least number.
    #[error(
        "underflow of the oracle: all of the radiance is below the least MPFR number behind an optical depth of up to {depth} (allowed: light in front of a depth of some 7e8)"
    )]
    OracleUnderflow {
        /// t(D).
        depth: f64,
    },
    /// There is no enclosure.
    #[error(
        "not enclosed: {reason} (allowed: media that are formulas, analytic but for kinks and jumps)"
    )]
    NotEnclosed {
        /// Why.
        reason: super::NotEnclosed,
    },
    /// The series do not get there.
    #[error(
        "not resolved to {wanted} bits{}: {believed} bits after {evaluations} evaluations (allowed: media that are analytic but for a few places)",
        lambda.map_or(String::new(), |at| format!(" near lambda = {at}"))
    )]
    NotResolved {
        /// The significant bits asked for.
        wanted: u32,
        /// Those that can be believed.
        believed: u32,
        /// Where it was given up, where it was at one place.
        lambda: Option<f64>,
        /// How often the medium was evaluated.
        evaluations: u64,
    },
}
