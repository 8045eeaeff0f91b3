//! Decimal numbers as exact rationals.

use rug::{Integer, Rational};

/// The greatest power of ten, either way.
const MAX_POWER: i32 = 1000;
/// The most digits.
const MAX_DIGITS: usize = 1000;

/// The exact value of digits with an optional point and exponent; `None` where it is too large or too
/// small to be meant.
pub(super) fn read(text: &str) -> Option<Rational> {
    let (mantissa, power) = match text.split_once(['e', 'E']) {
        Some((mantissa, power)) => (mantissa, power.parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    if whole.len() + fraction.len() > MAX_DIGITS || !(-MAX_POWER..=MAX_POWER).contains(&power) {
        return None;
    }
    let digits = Integer::parse(format!("{whole}{fraction}")).ok()?;
    let power = power - i32::try_from(fraction.len()).ok()?;
    let scale = Integer::u_pow_u(10, power.unsigned_abs());
    let mut value = Rational::from(Integer::from(digits));
    if power < 0 {
        value /= Integer::from(scale);
    } else {
        value *= Integer::from(scale);
    }
    Some(value)
}
