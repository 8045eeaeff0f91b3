//! Exact numbers and exact answers, evaluated and written.

use crate::case::manufacture::Manufactured;
use crate::case::{Case, SymbolicCase};
use crate::real::{Format, Mpfr};
use crate::reference::{self, ReferenceError};
use crate::symbolic::{Expr, Interval};
use rug::float::Special;
use rug::{Float, Rational};

/// Bits of values without a closed form: more than binary64 has.
const REFERENCE_BITS: u32 = 64;
/// The precision that values are shown from where no enclosure is narrow.
const SHOWN: Mpfr = Mpfr { bits: 128 };
/// Enclosures are tried at powers of 2 from these bits to those.
const BITS: (u32, u32) = (128, 8192);
/// An enclosure is narrow if its width is below the value by so many bits: more than binary64 has.
const NARROW: u32 = 60;
const DIGITS: usize = 6;
/// Rational numbers of more characters are shown as decimals.
const LONGEST: usize = 24;

/// t(D).
pub(super) fn total_depth(case: &Manufactured) -> Result<Float, ReferenceError> {
    let case = &case.case;
    match &case.formulas().optical_depth {
        Some(depth) => Ok(closed_form(case, depth, |end| case.optical_depth(end))),
        None => Ok(reference::optical_depth(case, REFERENCE_BITS)?.value),
    }
}

/// I(D).
pub(super) fn radiance(case: &Manufactured) -> Result<Float, ReferenceError> {
    let case = &case.case;
    match &case.formulas().radiance {
        Some(radiance) => Ok(closed_form(case, radiance, |end| case.radiance(end))),
        None => Ok(reference::radiance(case, REFERENCE_BITS)?.value),
    }
}

type Number = <Mpfr as Format>::Real;

/// A closed form at the far end, as `plain` evaluates it where it cannot be enclosed.
fn closed_form(
    case: &SymbolicCase,
    formula: &Expr,
    plain: impl Fn(&Number) -> Option<Number>,
) -> Float {
    let length = case.length();
    let plain = || Some(plain(&SHOWN.ratio(&length))?.into());
    let value = enclosed(formula, &length).or_else(plain);
    value.unwrap_or_else(|| Float::with_val(SHOWN.bits, Special::Nan))
}

/// The value at λ, whatever cancels in it; `None` where it may be 0 and is not certainly.
fn enclosed(expr: &Expr, lambda: &Rational) -> Option<Float> {
    let mut bits = BITS.0;
    while bits <= BITS.1 {
        let at = |name: &str| (name == "lambda").then(|| Interval::point(bits, lambda));
        let value = expr.enclose(bits, &at).ok()?;
        let middle = value.midpoint();
        if value.is_zero() || value.width() < middle.clone().abs() >> NARROW {
            return Some(middle);
        }
        bits *= 2;
    }
    None
}

/// Six significant digits, without an exponent where that is short.
#[must_use]
pub fn decimal(x: &Float) -> String {
    decimal_of(x, DIGITS)
}

/// So many significant digits, without an exponent where that is short.
#[must_use]
pub fn decimal_of(x: &Float, digits: usize) -> String {
    let (negative, digits, exponent) = x.to_sign_string_exp(10, Some(digits));
    // The value is 0.digits · 10^exponent; 0, NaN and infinities have no exponent.
    let Some(exponent) = exponent else {
        let sign = if negative && !x.is_zero() { "-" } else { "" };
        return format!("{sign}{digits}");
    };
    let sign = if negative { "-" } else { "" };
    let (place, zeros) = (
        usize::try_from(exponent).unwrap_or(0),
        usize::try_from(-exponent).unwrap_or(0),
    );
    match digits.split_at_checked(place) {
        Some((whole, "")) => format!("{sign}{whole}"),
        Some(("", part)) if zeros <= 3 => format!("{sign}0.{}{part}", "0".repeat(zeros)),
        Some((whole, part)) if !whole.is_empty() => format!("{sign}{whole}.{part}"),
        _ => {
            let (first, rest) = digits.split_at_checked(1).unwrap_or((&digits, ""));
            format!("{sign}{first}.{rest}e{}", exponent - 1)
        }
    }
}

/// A rational number as it is, or nearly where that takes too many digits.
pub(super) fn rational(q: &Rational) -> String {
    let text = q.to_string();
    if text.len() <= LONGEST {
        return text;
    }
    format!("about {}", decimal(&Float::with_val(SHOWN.bits, q)))
}
