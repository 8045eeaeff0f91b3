//! A rule as JSON: rationals as text, exponents as numbers.

use super::Power;
use rug::Rational;
use serde::ser::SerializeSeq as _;
use serde::{Serialize, Serializer};

/// As `["1/2", "0", "1/2"]`.
pub(super) fn ratios<S: Serializer>(
    parts: &[Rational; 3],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut sequence = serializer.serialize_seq(Some(parts.len()))?;
    for part in parts {
        sequence.serialize_element(&part.to_string())?;
    }
    sequence.end()
}

impl Serialize for Power {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.exponent())
    }
}
