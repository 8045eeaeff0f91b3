//! Why a method cannot run.

use crate::quadrature::RuleError;

/// Why a method cannot run on a ray of n segments.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MethodError {
    /// n is 0 or not a multiple of what the rule needs.
    #[error("n = {n} segments do not suit {rule} (allowed: positive multiples of {multiple})")]
    Segments {
        /// The rule's name.
        rule: String,
        /// The number of segments asked for.
        n: u64,
        /// What n must be a multiple of.
        multiple: u64,
    },
    /// n is too small for the stencil of an interpolant.
    #[error("n = {n} segments are too few for {interpolant} (allowed: {least} or more)")]
    TooFewSegments {
        /// The interpolant's name.
        interpolant: String,
        /// The number of segments asked for.
        n: u64,
        /// The least that suits.
        least: u64,
    },
    /// Integration in closed form on a case whose transfer functions are no known polynomials.
    #[error(
        "no closed form: the case's transfer functions are not polynomials (allowed: integration by sub-intervals)"
    )]
    NoClosedForm,
    /// A segment whose optical depth no series of reasonable length reaches.
    #[error("optical depth {depth} of one segment is too large (allowed: up to 65536)")]
    ThickSegment {
        /// A bound of the segment's depth.
        depth: String,
    },
    /// A rule on no sub-intervals.
    #[error("0 sub-intervals a segment (allowed: 1 or more)")]
    NoSubIntervals,
    /// A rule that cannot be.
    #[error(transparent)]
    Rule(#[from] RuleError),
}

/// Checks that `n` is a positive multiple of `multiple`.
pub(super) fn require_multiple(
    rule: &impl ToString,
    n: u64,
    multiple: u64,
) -> Result<(), MethodError> {
    if n > 0 && n.is_multiple_of(multiple) {
        Ok(())
    } else {
        Err(MethodError::Segments {
            rule: rule.to_string(),
            n,
            multiple,
        })
    }
}
