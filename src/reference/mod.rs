//! The oracle: the radiance I(D) of a case to any number of digits, from its closed form where it has one.

mod closed_form;
mod error;

pub use error::ReferenceError;

use crate::case::Case;
use crate::real::{MAX_BITS, MIN_BITS};
use rug::Float;

/// Bits beyond those asked for with which values are held.
pub const GUARD_BITS: u32 = 64;

/// Where a value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// The closed form of the case, evaluated.
    ClosedForm,
}

/// A radiance, and how well it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// I(D), with [`GUARD_BITS`] more than were asked for.
    pub value: Float,
    /// What |value − I(D)| is estimated to be at most.
    pub error: Float,
    /// Where the value comes from.
    pub source: Source,
    /// How often the medium was evaluated; 0 for a closed form.
    pub evaluations: u64,
}

/// I(D) to `bits` significant bits.
///
/// # Errors
/// [`ReferenceError`] where the digits cannot be had.
pub fn radiance<C: Case>(case: &C, bits: u32) -> Result<Reference, ReferenceError> {
    check_bits(bits)?;
    match closed_form::radiance(case, bits) {
        Some(reference) => reference,
        None => Err(ReferenceError::NoClosedForm),
    }
}

/// Leaves room for guard bits.
fn check_bits(bits: u32) -> Result<(), ReferenceError> {
    if (MIN_BITS..=MAX_BITS / 4).contains(&bits) {
        return Ok(());
    }
    Err(ReferenceError::Bits { bits })
}
