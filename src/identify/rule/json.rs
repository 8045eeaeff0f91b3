//! A rule as JSON: rationals as text, exponents as numbers.

use super::Power;
use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// As `["1/2", "0", "1/2"]`.
pub(super) mod ratios {
    use rug::Rational;
    use serde::de::Error as _;
    use serde::ser::SerializeSeq as _;
    use serde::{Deserialize, Deserializer, Serializer};

    pub(in super::super) fn serialize<S: Serializer>(
        parts: &[Rational; 3],
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        let mut sequence = serializer.serialize_seq(Some(parts.len()))?;
        for part in parts {
            sequence.serialize_element(&part.to_string())?;
        }
        sequence.end()
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<[Rational; 3], D::Error> {
        let texts = <[String; 3]>::deserialize(deserializer)?;
        let mut parts = <[Rational; 3]>::default();
        for (part, text) in parts.iter_mut().zip(&texts) {
            *part = text.parse().map_err(D::Error::custom)?;
        }
        Ok(parts)
    }
}

impl Serialize for Power {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_f64(self.exponent())
    }
}

impl<'de> Deserialize<'de> for Power {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let halves = 2.0 * f64::deserialize(deserializer)?;
        let all = i8::MIN..=i8::MAX;
        let power = all.map(|halves| Power { halves });
        let mut found = power.filter(|power| f64::from(power.halves).to_bits() == halves.to_bits());
        found
            .next()
            .ok_or_else(|| D::Error::custom("no multiple of one half"))
    }
}
