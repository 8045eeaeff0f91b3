//! The truth: t(D) and I(D) of a case to any number of digits, as a ball that is proved to contain them wherever
//! that can be had.
//!
//! A closed form is evaluated in intervals; without one the integral is enclosed. Where neither can be done, because
//! the medium is code and no formula or because it has no bound, there is an estimate by Chebyshev series, which says
//! that it is one, and why.

pub(crate) mod chebyshev;
mod closed_form;
pub(crate) mod enclosure;
mod error;
mod medium;
#[cfg(feature = "studies")]
mod picture;
mod spectral;

pub use enclosure::NotEnclosed;
pub use error::ReferenceError;
#[cfg(feature = "studies")]
pub use picture::{ExactPicture, Seen};
pub use spectral::Work;

use crate::case::{Case, SymbolicCase, Unproved};
use crate::real::{MAX_BITS, MIN_BITS};
use crate::symbolic::Interval;
use chebyshev::log2_abs;
use medium::Medium;
use rug::Float;
use rug::float::Round;
use std::f64::consts::LOG10_2;

/// Bits beyond those asked for with which values are held.
pub const GUARD_BITS: u32 = 64;

/// Where a value comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// The closed form of the case, evaluated.
    ClosedForm,
    /// The integral, enclosed.
    Enclosure,
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
    /// What |value − exact| is at most: proved, or an estimate.
    pub error: Float,
    /// Why the error is an estimate; `None` where it is proved.
    pub not_enclosed: Option<NotEnclosed>,
    /// Where the value comes from.
    pub source: Source,
    /// What was done for it; nothing is counted of a closed form.
    pub work: Work,
}

impl Reference {
    /// The middle of an interval, and how far its ends are from it; 0 where that is within.
    fn enclosed(interval: &Interval, bits: u32, source: Source, work: Work) -> Reference {
        let value = if interval.contains_zero() {
            Float::new(bits + GUARD_BITS)
        } else {
            Float::with_val(bits + GUARD_BITS, interval.midpoint())
        };
        let off = |bound: &Float| {
            Float::with_val_round(64, bound - &value, Round::AwayZero)
                .0
                .abs()
        };
        let (below, above) = (off(interval.lower()), off(interval.upper()));
        Reference {
            error: if below > above { below } else { above },
            value,
            not_enclosed: None,
            source,
            work,
        }
    }

    /// Whether the error is proved, and with it all digits.
    #[must_use]
    pub fn is_enclosed(&self) -> bool {
        self.not_enclosed.is_none()
    }

    /// What I(D) of that case rests on and is not proved: statements of the case, and the integral where it is an
    /// estimate.
    #[must_use]
    pub fn unproved(&self, case: &SymbolicCase) -> Vec<Unproved> {
        self.unproved_of("I(D)", case)
    }

    /// The same of a value by another name.
    pub(crate) fn unproved_of(&self, name: &str, case: &SymbolicCase) -> Vec<Unproved> {
        let estimate = self.not_enclosed.iter().map(|reason| Unproved {
            claim: name.into(),
            reason: format!("an estimate: {reason}"),
        });
        case.unproved().iter().cloned().chain(estimate).collect()
    }

    /// The significant decimal digits that the error leaves: −log₁₀ of the relative error, rounded down; `None` for a
    /// 0 without error.
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
/// From the closed form where there is one, else as [`enclosed_radiance`], and where that cannot be had as
/// [`estimated_radiance`], which [`Reference::not_enclosed`] then tells.
///
/// ```
/// use volver::case::SineSquared;
/// use volver::reference::{Source, enclosed_radiance, radiance};
///
/// let exact = radiance(&SineSquared, 340)?;
/// let found = enclosed_radiance(&SineSquared, 340)?;
/// assert_eq!((exact.source, found.source), (Source::ClosedForm, Source::Enclosure));
/// assert!(exact.is_enclosed() && found.is_enclosed());
/// assert!((exact.value - &found.value).abs() <= found.error + exact.error);
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

/// I(D) to `bits` significant bits, proved, from C and τ alone, whether there is a closed form or not.
///
/// C τ e^(−t) is integrated panel by panel between kinks and jumps, with what its Chebyshev series leave out bounded
/// on ellipses in the complex plane: nothing hides between points. See [`Case::integrand`].
///
/// # Errors
/// [`ReferenceError::Bits`], or [`ReferenceError::NotEnclosed`] with the reason.
pub fn enclosed_radiance<C: Case>(case: &C, bits: u32) -> Result<Reference, ReferenceError> {
    check_bits(bits)?;
    let found = enclosed(case, Quantity::Radiance, bits);
    found.map_err(|reason| ReferenceError::NotEnclosed { reason })
}

/// I(D) to `bits` significant bits by an estimate, from C and τ at points alone; formulas tell where to cut.
///
/// Clenshaw–Curtis points, panel by panel between the breaks of the case, with the integrals of Chebyshev
/// series; analytic media cost some digits to the power of 1 evaluations, and a place where they are not
/// analytic that neither formulas nor the structure tell of as many panels as there are bits. What is narrower
/// than the distance of points can be missed.
///
/// # Errors
/// [`ReferenceError`] where the digits cannot be had.
pub fn estimated_radiance<C: Case>(case: &C, bits: u32) -> Result<Reference, ReferenceError> {
    check_bits(bits)?;
    spectral::integrate(case, Quantity::Radiance, bits, NotEnclosed::NotTried)
}

fn enclosed(case: &dyn Medium, quantity: Quantity, bits: u32) -> Result<Reference, NotEnclosed> {
    let program = case.integrand().ok_or(NotEnclosed::NoFormulas)?;
    let breaks = |bits| case.break_places(bits).into_iter().flatten().collect();
    let medium = enclosure::Medium {
        program,
        length: case.length(),
        breaks: &breaks,
    };
    let (interval, work) = enclosure::enclose(&medium, quantity, bits)?;
    Ok(Reference::enclosed(
        &interval,
        bits,
        Source::Enclosure,
        work,
    ))
}

fn best(case: &dyn Medium, quantity: Quantity, bits: u32) -> Result<Reference, ReferenceError> {
    check_bits(bits)?;
    match closed_form::evaluate(case, quantity, bits) {
        Some(reference) => reference,
        None => enclosed(case, quantity, bits).or_else(|reason| match reason {
            // Certain, and no matter of how it is integrated.
            NotEnclosed::NegativeExtinction { lambda } => {
                Err(ReferenceError::NegativeExtinction { lambda })
            }
            reason => spectral::integrate(case, quantity, bits, reason),
        }),
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
