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
    /// A case without a closed form.
    #[error("no closed form of the radiance (allowed: cases that have one)")]
    NoClosedForm,
    /// NaN or infinity from a closed form.
    #[error("the closed form of the radiance is {value} at the far end (allowed: a finite value)")]
    ClosedFormNotFinite {
        /// What came out.
        value: String,
    },
    /// Digits cancel in a closed form, whatever the precision.
    #[error(
        "the closed form of the radiance gives {believed} bits at a precision of {precision} (allowed: closed forms with all {bits} bits at 16 times the precision)"
    )]
    Cancelled {
        /// The significant bits that can be believed.
        believed: u32,
        /// The precision it was last evaluated with.
        precision: u32,
        /// The bits asked for.
        bits: u32,
    },
}
