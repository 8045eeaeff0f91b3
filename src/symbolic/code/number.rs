//! Constants as text that a compiler rounds once.

use super::layout::Layout;
use super::text::{Strength, Text};
use crate::real::{Format, Native};
use crate::symbolic::parse_number;
use rug::Rational;

/// Integers up to here are values of binary64.
const EXACT: u64 = 1 << 53;

/// The number as it is rounded to binary64.
pub(super) fn rounded(q: &Rational) -> f64 {
    Native::<f64>::new().ratio(q)
}

/// A decimal where that is the exact number; otherwise a quotient of exact integers, which is rounded
/// once like the number; otherwise the shortest decimal that is read as the rounded number.
pub(super) fn rational(q: &Rational, layout: &dyn Layout) -> Text {
    let value = rounded(q);
    if value.is_infinite() {
        let sign = if value < 0.0 { "-" } else { "" };
        return signed(format!("{sign}{}", layout.infinity()));
    }
    let decimal = format!("{value:?}");
    if parse_number(&decimal).is_ok_and(|decimal| decimal == *q) {
        return signed(decimal);
    }
    let (numerator, denominator) = (q.numer(), q.denom());
    if *numerator.as_abs() <= EXACT && *denominator <= EXACT {
        return Text {
            text: format!("{numerator}.0 / {denominator}.0"),
            strength: Strength::Product,
        };
    }
    signed(decimal)
}

fn signed(text: String) -> Text {
    let strength = if text.starts_with('-') {
        Strength::Sign
    } else {
        Strength::Atom
    };
    Text { text, strength }
}
