//! Exact numbers and exact answers, evaluated and written.

use rug::float::Special;
use rug::{Float, Rational};
use volver::case::Case;
use volver::case::manufacture::{Manufactured, Outcome};
use volver::real::{Format, Mpfr};
use volver::reference::{self, ReferenceError};
use volver::symbolic::{Expr, Interval};

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
pub(crate) fn total_depth(case: &Manufactured) -> Result<Float, ReferenceError> {
    let length = case.case.length();
    let Some(depth) = &case.case.formulas().optical_depth else {
        return Ok(reference::optical_depth(&case.case, REFERENCE_BITS)?.value);
    };
    let at_end = || Some(case.case.optical_depth(&SHOWN.ratio(&length))?.into());
    let value = enclosed(depth, &length).or_else(at_end);
    Ok(value.unwrap_or_else(|| Float::with_val(SHOWN.bits, Special::Nan)))
}

/// I(D).
pub(crate) fn radiance(case: &Manufactured) -> Result<Float, ReferenceError> {
    let length = case.case.length();
    let Some(radiance) = &case.case.formulas().radiance else {
        return Ok(reference::radiance(&case.case, REFERENCE_BITS)?.value);
    };
    let at_end = || Some(case.case.radiance(&SHOWN.ratio(&length))?.into());
    let value = enclosed(radiance, &length).or_else(at_end);
    Ok(value.unwrap_or_else(|| Float::with_val(SHOWN.bits, Special::Nan)))
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
pub(crate) fn decimal(x: &Float) -> String {
    decimal_of(x, DIGITS)
}

/// So many significant digits.
pub(crate) fn decimal_of(x: &Float, digits: usize) -> String {
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
pub(crate) fn rational(q: &Rational) -> String {
    let text = q.to_string();
    if text.len() <= LONGEST {
        return text;
    }
    format!("about {}", decimal(&Float::with_val(SHOWN.bits, q)))
}

/// "refuted at lambda = 1/3: value in […]".
pub(crate) fn outcome(outcome: &Outcome) -> String {
    match outcome {
        Outcome::Proved => "proved".into(),
        Outcome::Refuted { witness, value } => {
            let value = match value {
                Some(value) => format!("value in {value}"),
                None => "no value".into(),
            };
            format!("refuted at lambda = {}: {value}", rational(witness))
        }
        Outcome::Undecided { near: Some(near) } => {
            format!("undecided near lambda = {}", rational(near))
        }
        Outcome::Undecided { near: None } => "undecided".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_have_six_digits() {
        for (text, written) in [
            ("0.130613993", "0.130614"),
            ("-0.000123456789", "-0.000123457"),
            ("0.0000123456789", "1.23457e-5"),
            ("50", "50.0000"),
            ("123456", "123456"),
            ("1234567", "1.23457e6"),
            ("-1e400", "-1.00000e400"),
            ("0", "0"),
            ("nan", "NaN"),
            ("-inf", "-inf"),
        ] {
            let x = Float::with_val(128, Float::parse(text).unwrap());
            assert_eq!(decimal(&x), written);
        }
    }

    #[test]
    fn values_are_right_however_much_cancels() {
        let expr: Expr = "1 - (1 + lambda)*exp(-lambda)".parse().unwrap();
        let tiny = volver::symbolic::parse_number("1e-400").unwrap();
        assert_eq!(decimal(&enclosed(&expr, &tiny).unwrap()), "5.00000e-801");
        let zero: Expr = "sin(lambda)^2 + cos(lambda)^2 - 1".parse().unwrap();
        assert!(enclosed(&zero, &tiny).is_none());
    }

    #[test]
    fn long_fractions_are_shortened() {
        assert_eq!(rational(&Rational::from((1, 3))), "1/3");
        let long = Rational::from((1, 1_000_000_007)).square();
        assert_eq!(rational(&Rational::from(&long + 1)), "about 1.00000");
    }
}
