//! The oracle: t(D) and I(D) of a case to any number of digits, from its closed form where it has one, else by
//! Chebyshev series.

pub(crate) mod chebyshev;
mod closed_form;
mod error;
mod medium;
mod spectral;

pub use error::ReferenceError;
pub use spectral::Work;

use crate::case::Case;
use crate::real::{MAX_BITS, MIN_BITS};
use chebyshev::log2_abs;
use medium::Medium;
use rug::Float;
use std::f64::consts::LOG10_2;

/// Bits beyond those asked for with which values are held.
pub const GUARD_BITS: u32 = 64;

/// Where a value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// The closed form of the case, evaluated.
    ClosedForm,
    /// The integral, by Chebyshev series.
    Spectral,
}

/// What is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    /// t(D).
    Depth,
    /// I(D).
    Radiance,
}

/// A value at the far end of a ray, and how well it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The value, held with [`GUARD_BITS`] more than were asked for.
    pub value: Float,
    /// What |value − exact| is estimated to be at most.
    pub error: Float,
    /// Where the value comes from.
    pub source: Source,
    /// What was done for it; nothing is counted of a closed form.
    pub work: Work,
}

impl Reference {
    /// The significant decimal digits that can be believed: −log₁₀ of the relative error, rounded down;
    /// `None` for an exact 0.
    #[must_use]
    pub fn digits(&self) -> Option<u32> {
        if self.value.is_zero() && self.error.is_zero() {
            return None;
        }
        let bits = believed_bits(&self.value, &self.error);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // At most MAX_BITS.
        let digits = (f64::from(bits.min(MAX_BITS)) * LOG10_2) as u32;
        Some(digits)
    }
}

/// I(D) to `bits` significant bits.
///
/// A closed form is evaluated at two precisions and must agree with itself; without one, see
/// [`spectral_radiance`].
///
/// ```
/// use volver::case::SineSquared;
/// use volver::reference::{Source, radiance, spectral_radiance};
///
/// let exact = radiance(&SineSquared, 340)?;
/// let found = spectral_radiance(&SineSquared, 340)?;
/// assert_eq!((exact.source, found.source), (Source::ClosedForm, Source::Spectral));
/// assert!((exact.value - &found.value).abs() <= found.error);
/// # Ok::<(), volver::reference::ReferenceError>(())
/// ```
///
/// # Errors
/// [`ReferenceError`] where the digits cannot be had.
pub fn radiance<C: Case>(case: &C, bits: u32) -> Result<Reference, ReferenceError> {
    best(case, Quantity::Radiance, bits)
}

/// t(D) to `bits` significant bits, in the same way.
///
/// # Errors
/// [`ReferenceError`] where the digits cannot be had.
pub fn optical_depth<C: Case>(case: &C, bits: u32) -> Result<Reference, ReferenceError> {
    best(case, Quantity::Depth, bits)
}

/// I(D) to `bits` significant bits from C and τ alone, whether there is a closed form or not.
///
/// Clenshaw–Curtis points, panel by panel between the breaks of the case, with the integrals of Chebyshev
/// series; analytic media cost some digits to the power of 1 evaluations, and a place where they are not
/// analytic that nobody told of as many panels as there are bits.
///
/// # Errors
/// [`ReferenceError`] where the digits cannot be had.
pub fn spectral_radiance<C: Case>(case: &C, bits: u32) -> Result<Reference, ReferenceError> {
    check_bits(bits)?;
    spectral::integrate(case, Quantity::Radiance, bits)
}

fn best(case: &dyn Medium, quantity: Quantity, bits: u32) -> Result<Reference, ReferenceError> {
    check_bits(bits)?;
    match closed_form::evaluate(case, quantity, bits) {
        Some(reference) => reference,
        None => spectral::integrate(case, quantity, bits),
    }
}

/// Leaves room for guard bits.
fn check_bits(bits: u32) -> Result<(), ReferenceError> {
    if (MIN_BITS..=MAX_BITS / 4).contains(&bits) {
        return Ok(());
    }
    Err(ReferenceError::Bits { bits })
}

/// −log₂ of the relative error, at least 0.
fn believed_bits(value: &Float, error: &Float) -> u32 {
    let bits = (log2_abs(value) - log2_abs(error)).floor();
    // NaN, of 0 that is exact, becomes 0, and what u32 does not hold its nearest end.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let bits = bits as u32;
    bits
}
