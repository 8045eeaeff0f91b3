//! Cases whose closed forms are compared with the integral.
//!
//! Statements that are proved leave nothing to compare, unless a proof is wrong. So whenever a case is made of a
//! user's file, t(D) and I(D) are integrated without their closed forms: two ways that share next to nothing.

use crate::case::manufacture::{self, Contradiction, ManufactureError, Manufactured};
use crate::case::{Case, Description, SymbolicCase};
use crate::reference::{self, Reference};
use crate::symbolic::{Expr, Interval};

/// The significant bits asked of the integral; where it disagrees, it is asked for more before that counts.
const BITS: [u32; 2] = [48, 160];
/// The precisions at which closed forms are enclosed.
const CLOSED_BITS: [u32; 4] = [128, 256, 1024, 4096];

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Quantity {
    Depth,
    Radiance,
}

/// Derives the case of each channel, checks it, and compares it with the integral.
///
/// # Errors
/// [`ManufactureError`] as of [`manufacture`](manufacture::manufacture), and where a closed form is not
/// the integral, whatever was proved of it.
pub fn manufacture(description: &Description) -> Result<Vec<Manufactured>, ManufactureError> {
    let cases = manufacture::manufacture(description)?;
    cases.iter().try_for_each(confirm)?;
    Ok(cases)
}

/// Compares t(D) and I(D) by closed form with the integral. Where one of both has no value to compare,
/// nothing is said.
///
/// # Errors
/// [`ManufactureError::Contradicted`] where they differ by more than both errors.
pub fn confirm(made: &Manufactured) -> Result<(), ManufactureError> {
    let formulas = made.case.formulas();
    let both = [
        ("t(D)", Quantity::Depth, &formulas.optical_depth),
        ("I(D)", Quantity::Radiance, &formulas.radiance),
    ];
    for (name, quantity, formula) in both {
        let Some(closed) = formula.as_ref().and_then(|formula| at_end(made, formula)) else {
            continue;
        };
        let mut contradiction = None;
        for bits in BITS {
            let integral = integral(&made.case, quantity, bits);
            contradiction = integral.filter(|integral| closed.intersection(integral).is_none());
            if contradiction.is_none() {
                break;
            }
        }
        if let Some(integral) = contradiction {
            return Err(ManufactureError::Contradicted(Box::new(Contradiction {
                quantity: name,
                closed,
                integral,
                is_proved: made.is_proved(),
            })));
        }
    }
    Ok(())
}

/// A closed form at the far end, as narrow as it has to be.
fn at_end(made: &Manufactured, formula: &Expr) -> Option<Interval> {
    let length = made.case.length();
    let mut best = None;
    for bits in CLOSED_BITS {
        let at = |name: &str| (name == "lambda").then(|| Interval::point(bits, &length));
        let value = formula.enclose(bits, &at).ok()?;
        let is_narrow = value.width() <= value.midpoint().abs() >> BITS[1];
        best = Some(value);
        if is_narrow {
            break;
        }
    }
    best
}

/// The integral without a closed form, enclosed; `None` where it is not: an estimate may have missed what the closed
/// form has.
fn integral(case: &SymbolicCase, quantity: Quantity, bits: u32) -> Option<Interval> {
    let medium = case.without_closed_form().ok()?;
    let found = match quantity {
        Quantity::Depth => reference::optical_depth(&medium, bits),
        Quantity::Radiance => reference::radiance(&medium, bits),
    };
    let found = found.ok().filter(Reference::is_enclosed)?;
    let (value, error) = (
        Interval::exactly(&found.value),
        Interval::exactly(&found.error),
    );
    Some((&value - &error).union(&(&value + &error)))
}
