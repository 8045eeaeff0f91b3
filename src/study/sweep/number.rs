//! Numbers of any magnitude in JSON: decimal text of twenty digits.

use rug::Float;
use serde::{Deserialize, Deserializer, Serializer, de::Error};

/// Holds twenty digits with some to spare: what is read is written again with the same digits.
const BITS: u32 = 80;
const DIGITS: usize = 20;

/// The number as it is written.
pub(super) fn text(x: &Float) -> String {
    Float::with_val(BITS, x).to_string_radix(10, Some(DIGITS))
}

/// Only what a journal can hold: the number rounded to its digits.
pub(super) fn rounded(x: &Float) -> Float {
    parse(&text(x)).unwrap_or_else(|| Float::with_val(BITS, rug::float::Special::Nan))
}

fn parse(text: &str) -> Option<Float> {
    Some(Float::with_val(BITS, Float::parse(text).ok()?))
}

#[expect(clippy::ref_option, reason = "the shape that serde asks for")]
pub(super) mod optional {
    use super::{Deserialize, Deserializer, Error, Float, Serializer, parse, text};

    pub(in super::super) fn serialize<S: Serializer>(
        x: &Option<Float>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        match x {
            Some(x) => serializer.serialize_str(&text(x)),
            None => serializer.serialize_none(),
        }
    }

    pub(in super::super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<Float>, D::Error> {
        let Some(text) = Option::<String>::deserialize(deserializer)? else {
            return Ok(None);
        };
        let number = parse(&text);
        number
            .map(Some)
            .ok_or_else(|| D::Error::custom("not a decimal number"))
    }
}

pub(super) fn serialize<S: Serializer>(x: &Float, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&text(x))
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Float, D::Error> {
    let text = String::deserialize(deserializer)?;
    parse(&text).ok_or_else(|| D::Error::custom("not a decimal number"))
}
