//! Numbers that a kernel writes: JSON's own, or text for what these cannot hold.

use rug::float::Special;
use rug::ops::Pow;
use rug::{Float, Integer};
use serde::de::{Deserialize, Deserializer, Error, Visitor};
use std::fmt;

/// So many decimal digits are told apart by binary64.
const DIGITS_OF_BINARY64: usize = 17;
/// The most bits that a text is read with.
const MAX_BITS: u32 = 1 << 20;
/// The largest exponent of two: well inside what a number can hold.
const MAX_EXPONENT: u32 = 1 << 28;

/// A number, before it is known how many bits are wanted.
#[derive(Clone, Debug)]
pub(super) enum Number {
    /// As exact as it was written.
    Float(Float),
    /// Decimal text, checked to be such.
    Decimal { text: String, digits: usize },
}

impl Number {
    /// The number to at least that many bits; a decimal of more digits than binary64 has gets enough to hold
    /// them all with some to spare.
    pub(super) fn to_float(&self, bits: u32) -> Float {
        match self {
            Number::Float(float) => float.clone(),
            Number::Decimal { text, digits } => {
                let needed = if *digits > DIGITS_OF_BINARY64 {
                    // log₂ 10 < 3.33.
                    u32::try_from(digits.saturating_mul(333) / 100 + 64).unwrap_or(MAX_BITS)
                } else {
                    f64::MANTISSA_DIGITS
                };
                let bits = needed.max(bits).min(MAX_BITS);
                match Float::parse(text) {
                    Ok(value) => Float::with_val(bits, value),
                    Err(_) => Float::with_val(bits, Special::Nan),
                }
            }
        }
    }

    pub(super) fn to_f64(&self) -> f64 {
        self.to_float(f64::MANTISSA_DIGITS).to_f64()
    }

    fn binary64(value: f64) -> Self {
        Number::Float(Float::with_val(f64::MANTISSA_DIGITS, value))
    }

    fn parse(text: &str) -> Option<Self> {
        let (negative, unsigned) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        let lower = unsigned.to_ascii_lowercase();
        let special = |special| Some(Float::with_val(f64::MANTISSA_DIGITS, special));
        let float = match lower.as_str() {
            "nan" => special(Special::Nan)?,
            "inf" | "infinity" => special(Special::Infinity)?,
            _ => match lower.strip_prefix("0x") {
                Some(digits) => hexadecimal(digits)?,
                None => return decimal(text, &lower),
            },
        };
        Some(Number::Float(if negative { -float } else { float }))
    }
}

/// DIGITS[.DIGITS][eEXPONENT], with a digit at least before the exponent.
fn decimal(text: &str, unsigned: &str) -> Option<Number> {
    let (mantissa, exponent) = match unsigned.split_once('e') {
        Some((mantissa, exponent)) => (mantissa, Some(exponent)),
        None => (unsigned, None),
    };
    let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = whole.len() + part.len();
    let all = |digits: &str| digits.bytes().all(|byte| byte.is_ascii_digit());
    if digits == 0 || !all(whole) || !all(part) {
        return None;
    }
    if let Some(exponent) = exponent {
        let digits = exponent.strip_prefix(['-', '+']).unwrap_or(exponent);
        if digits.is_empty() || !all(digits) {
            return None;
        }
    }
    Float::parse(text).ok()?;
    Some(Number::Decimal {
        text: text.into(),
        digits,
    })
}

/// DIGITS[.DIGITS][pEXPONENT] in base 16, the exponent of 2 in decimal; exactly, up to so many digits as nobody writes.
fn hexadecimal(text: &str) -> Option<Float> {
    let (mantissa, exponent) = text.split_once('p').unwrap_or((text, "0"));
    let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = format!("{whole}{part}");
    if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_hexdigit()) {
        return None;
    }
    let exponent: i32 = exponent.parse().ok()?;
    let exponent = exponent.checked_sub(i32::try_from(part.len()).ok()?.checked_mul(4)?)?;
    if exponent.unsigned_abs() > MAX_EXPONENT {
        return None;
    }
    let mantissa = Integer::from_str_radix(&digits, 16).ok()?;
    let bits = mantissa
        .significant_bits()
        .clamp(f64::MANTISSA_DIGITS, MAX_BITS);
    let scale = Float::with_val(f64::MANTISSA_DIGITS, 2).pow(exponent);
    Some(Float::with_val(bits, &mantissa) * scale)
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Read;
        impl Visitor<'_> for Read {
            type Value = Number;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, or text such as \"0.1\", \"0x1.8p-3\", \"nan\", \"inf\"")
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<Number, E> {
                Ok(Number::binary64(value))
            }

            fn visit_u64<E: Error>(self, value: u64) -> Result<Number, E> {
                Ok(Number::binary64(value as f64))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<Number, E> {
                Ok(Number::binary64(value as f64))
            }

            fn visit_str<E: Error>(self, text: &str) -> Result<Number, E> {
                Number::parse(text)
                    .ok_or_else(|| E::invalid_value(serde::de::Unexpected::Str(text), &self))
            }
        }
        deserializer.deserialize_any(Read)
    }
}
