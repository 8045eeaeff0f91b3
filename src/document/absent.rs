//! What JSON does not have: numbers that are none are written as `null` and read back as NaN, what is the rule is left out.

use serde::{Deserialize, Deserializer};

/// A number, or NaN for `null`.
pub(super) fn nullable<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::NAN))
}

/// Pairs of such numbers.
pub(super) fn nullable_pairs<'de, D: Deserializer<'de>>(
    from: D,
) -> Result<Vec<(f64, f64)>, D::Error> {
    let pairs: Vec<(Option<f64>, Option<f64>)> = Vec::deserialize(from)?;
    let number = |x: Option<f64>| x.unwrap_or(f64::NAN);
    Ok(pairs.iter().map(|&(x, y)| (number(x), number(y))).collect())
}

/// Whether something is as it is where nothing is said.
pub(super) fn is_default<T: Default + PartialEq>(is: &T) -> bool {
    *is == T::default()
}
