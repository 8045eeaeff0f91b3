//! How many digits answers have.

use super::Identification;
use super::deviation::{Deviation, INNER};
use super::opacity::ROUNDINGS;
use crate::kernel::Declaration;
use crate::real::FormatName;
use serde::Serialize;
use std::fmt;

/// The digits that all answers make do with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Precision {
    /// So many significant bits: 24 in binary32.
    Bits(u32),
    /// So many significant decimal digits, as they are printed.
    Digits(u32),
}

/// Significant bits of the formats of renderers: bfloat16, binary16, binary32.
const FORMATS: [u32; 3] = [8, 11, 24];
/// Decimal digits that programs print fewer of than they have.
const PRINTED: std::ops::RangeInclusive<u32> = 3..=12;
/// An answer is a number of a format where it is nearer to one than this part of a unit: nine decimal digits, which tell
/// all numbers of binary32 apart, are no more than 0.084 of its unit off.
const NEAR: f64 = 1.0 / 8.0;
/// Fewer answers tell no digits apart from chance.
const FEWEST: usize = 8;
const DOUBLE: u32 = 53;

impl Precision {
    /// Of those answers; binary64 where nothing narrower holds them all.
    pub(super) fn of(answers: &[f64]) -> Precision {
        let known: Vec<f64> = answers
            .iter()
            .copied()
            .filter(|y| y.is_finite() && *y != 0.0)
            .collect();
        if known.is_empty() {
            return Precision::Bits(DOUBLE);
        }
        let all = |holds: &dyn Fn(f64) -> bool| known.iter().all(|y| holds(*y));
        let formats = FORMATS.into_iter().find(|bits| {
            all(&|y| {
                let rounded = rug::Float::with_val(*bits, y).to_f64();
                (rounded - y).abs() <= NEAR * unit(*bits) * y.abs()
            })
        });
        if let Some(bits) = formats {
            return Precision::Bits(bits);
        }
        let digits = PRINTED.into_iter().find(|digits| {
            let behind = *digits as usize - 1;
            all(&|y| format!("{y:.behind$e}").parse::<f64>() == Ok(y))
        });
        match digits {
            Some(digits) if known.len() >= FEWEST => Precision::Digits(digits),
            _ => Precision::Bits(DOUBLE),
        }
    }

    /// The largest part of a number that rounding takes.
    #[must_use]
    pub fn unit(self) -> f64 {
        match self {
            Precision::Bits(bits) => unit(bits),
            // Half of the last digit of a 1.
            Precision::Digits(digits) => 0.5 * 10_f64.powf(1.0 - f64::from(digits)),
        }
    }
}

fn unit(bits: u32) -> f64 {
    (-f64::from(bits)).exp2()
}

impl fmt::Display for Precision {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Precision::Bits(bits) => write!(f, "{bits} significant bits"),
            Precision::Digits(digits) => write!(f, "{digits} significant decimal digits"),
        }
    }
}

/// Fewer digits than the declared format has: in the answers, or where these have more, in what they are made of.
pub(super) fn deviation(found: &Identification, declaration: &Declaration) -> Option<Deviation> {
    of_answers(found, declaration).or_else(|| inside(found, declaration))
}

/// Segments that are off the rule, up and down, by more than answers are rounded: as roundings in a narrower format are.
fn inside(found: &Identification, declaration: &Declaration) -> Option<Deviation> {
    found.named()?;
    let is_of = |bits: &u32| (ROUNDINGS * unit(*bits) - found.parts.grain).abs() < 1e-12;
    let bits = FORMATS.into_iter().find(is_of)?;
    let declared = declaration.format.bits().min(DOUBLE);
    (bits < declared).then(|| Deviation {
        name: INNER,
        value: Some(f64::from(bits)),
        bracket: None,
        exact: true,
        probe: "segments between references",
        validated: Vec::new(),
        does: format!(
            "segments are off the rule, up and down, as by rounding to {bits} significant bits"
        ),
        instead_of: Some(format!("{declared} bits, of {}", declaration.format)),
    })
}

/// Answers in a narrower format than the one declared: no rays made for that show it, but all that were held out.
fn of_answers(found: &Identification, declaration: &Declaration) -> Option<Deviation> {
    let precision = found.hold_out.precision?;
    let has_quantum = |output: &super::rule::Output| output.quantum.is_some();
    // What is stored is what is seen.
    let output = declaration.output.unwrap_or(declaration.format);
    let is_fixed = |format| matches!(format, FormatName::Fixed(_));
    if is_fixed(declaration.format)
        || is_fixed(output)
        || declaration.quantum.is_some()
        || found.parts.output.as_ref().is_some_and(has_quantum)
    {
        return None;
    }
    let declared = declaration.format.bits().min(output.bits()).min(DOUBLE);
    // Of two formats of about the same size the printed one is no narrower.
    if precision.unit() <= 2.0 * unit(declared) {
        return None;
    }
    let (name, value) = match precision {
        Precision::Bits(bits) => ("format", bits),
        Precision::Digits(digits) => ("digits", digits),
    };
    Some(Deviation {
        name,
        value: Some(f64::from(value)),
        bracket: None,
        exact: true,
        probe: "all rays that were held out",
        validated: Vec::new(),
        does: format!("no answer has more than {precision}"),
        instead_of: Some(format!("{declared} bits, of {output}")),
    })
}
