//! Numbers as volver writes them.

use serde::ser::{Serialize, SerializeSeq, Serializer};
use std::fmt;

/// How a kernel wants its numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Numbers {
    /// The shortest decimal that is read as the same binary64.
    #[default]
    Decimal,
    /// Text such as `0x1.8p-3`.
    Hexadecimal,
}

/// One number.
#[derive(Clone, Copy, Debug)]
pub struct Written {
    /// The number.
    pub value: f64,
    /// How it is wanted.
    pub numbers: Numbers,
}

/// A row of them.
#[derive(Clone, Debug)]
pub enum Array<'a> {
    /// In the message.
    Here(&'a [f64], Numbers),
    /// In a file, as `numpy.save` writes it.
    File(String),
}

impl Serialize for Written {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let value = self.value;
        if value.is_nan() {
            serializer.serialize_str("nan")
        } else if value.is_infinite() {
            serializer.serialize_str(if value > 0.0 { "inf" } else { "-inf" })
        } else {
            match self.numbers {
                Numbers::Decimal => serializer.serialize_f64(value),
                Numbers::Hexadecimal => serializer.collect_str(&Hexadecimal(value)),
            }
        }
    }
}

impl Serialize for Array<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Array::Here(values, numbers) => {
                let mut row = serializer.serialize_seq(Some(values.len()))?;
                for value in *values {
                    row.serialize_element(&Written {
                        value: *value,
                        numbers: *numbers,
                    })?;
                }
                row.end()
            }
            Array::File(path) => serializer.collect_map([("npy", path)]),
        }
    }
}

/// A finite number as C's `%a` prints it.
struct Hexadecimal(f64);

impl fmt::Display for Hexadecimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let bits = self.0.to_bits();
        let sign = if self.0.is_sign_negative() { "-" } else { "" };
        let fraction = bits & ((1 << 52) - 1);
        let (whole, exponent) = match (bits >> 52) & 0x7ff {
            0 if fraction == 0 => (0, 0),
            0 => (0, -1022),
            biased => (1, biased.cast_signed() - 1023),
        };
        let digits = format!("{fraction:013x}");
        let digits = digits.trim_end_matches('0');
        let point = if digits.is_empty() { "" } else { "." };
        write!(f, "{sign}0x{whole}{point}{digits}p{exponent:+}")
    }
}
