//! Decimal numbers from text, with all the digits they have.

use rug::Float;

/// Bits kept beyond those the digits need.
const GUARD_BITS: u32 = 64;
/// Most characters a number may have.
const MAX_CHARACTERS: usize = 1_000_000;

/// A decimal number and the place of its last digit.
#[derive(Clone, Debug, PartialEq)]
pub struct Decimal {
    /// The value, rounded once to log₂10 bits a digit and 64 more.
    pub value: Float,
    /// Power of ten of the last digit written: −3 for `1.250`.
    pub last_place: i64,
}

impl Decimal {
    /// Reads `[+-]digits[.digits][e[+-]digits]`; `None` for anything else, NaN and infinity included,
    /// and where the value leaves MPFR's range (some 10^±323,000,000).
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        if text.len() > MAX_CHARACTERS {
            return None;
        }
        let unsigned = text.strip_prefix(['+', '-']).unwrap_or(text);
        let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, parse_exponent(exponent)?),
            None => (unsigned, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = whole.len() + fraction.len();
        let all_digits = |s: &str| s.bytes().all(|b| b.is_ascii_digit());
        if digits == 0 || !all_digits(whole) || !all_digits(fraction) {
            return None;
        }
        // log₂10 < 10/3.
        let bits = u32::try_from(digits * 10 / 3 + 1).ok()? + GUARD_BITS;
        let value = Float::with_val(bits, Float::parse(text).ok()?);
        let written_zero = mantissa.bytes().all(|b| matches!(b, b'0' | b'.'));
        if !value.is_finite() || (value.is_zero() && !written_zero) {
            return None;
        }
        Some(Decimal {
            value,
            last_place: exponent - i64::try_from(fraction.len()).ok()?,
        })
    }
}

/// An exponent that fits 32 bits: MPFR's own range ends long before.
fn parse_exponent(text: &str) -> Option<i64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    let valid = !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit());
    text.parse::<i32>().ok().filter(|_| valid).map(i64::from)
}
