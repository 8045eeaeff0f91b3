//! Formats by name: `f16`, `bf16`, `f32`, `f64`, `mpfr:256`.

use super::{Format, Mpfr, Native};
use half::{bf16, f16};
use std::fmt;
use std::str::FromStr;

/// Fewest bits an MPFR format may have.
pub const MIN_BITS: u32 = 2;
/// Most bits an MPFR format may have here: a number then takes 128 KiB.
pub const MAX_BITS: u32 = 1 << 20;

/// A format chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FormatName {
    /// IEEE binary16.
    F16,
    /// bfloat16.
    Bf16,
    /// IEEE binary32.
    F32,
    /// IEEE binary64.
    F64,
    /// MPFR with that many significant bits.
    Mpfr(u32),
}

/// Text that names no format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FormatError {
    /// Not one of the names.
    #[error("unknown format '{name}' (allowed: f16, bf16, f32, f64, mpfr:BITS)")]
    Unknown {
        /// The text given.
        name: String,
    },
    /// MPFR's precision is no number or out of range.
    #[error(
        "precision '{bits}' of format 'mpfr:{bits}' is out of range (allowed: mpfr:{MIN_BITS} … mpfr:{MAX_BITS})"
    )]
    Precision {
        /// The text after `mpfr:`.
        bits: String,
    },
}

impl FromStr for FormatName {
    type Err = FormatError;

    fn from_str(name: &str) -> Result<Self, FormatError> {
        match name {
            "f16" => Ok(FormatName::F16),
            "bf16" => Ok(FormatName::Bf16),
            "f32" => Ok(FormatName::F32),
            "f64" => Ok(FormatName::F64),
            _ => {
                let Some(bits) = name.strip_prefix("mpfr:") else {
                    return Err(FormatError::Unknown { name: name.into() });
                };
                match bits.parse() {
                    // A sign is no part of a precision, though Rust's integers take one.
                    Ok(b) if (MIN_BITS..=MAX_BITS).contains(&b) && !bits.starts_with('+') => {
                        Ok(FormatName::Mpfr(b))
                    }
                    _ => Err(FormatError::Precision { bits: bits.into() }),
                }
            }
        }
    }
}

impl fmt::Display for FormatName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FormatName::F16 => f.pad("f16"),
            FormatName::Bf16 => f.pad("bf16"),
            FormatName::F32 => f.pad("f32"),
            FormatName::F64 => f.pad("f64"),
            FormatName::Mpfr(bits) => f.pad(&format!("mpfr:{bits}")),
        }
    }
}

/// Something to do in a format known only at run time: a closure generic over [`Format`].
pub trait WithFormat {
    /// What comes out.
    type Output;
    /// Does it in `format`.
    fn run<F: Format>(self, format: F) -> Self::Output;
}

impl FormatName {
    /// Does `action` in this format.
    pub fn with<W: WithFormat>(self, action: W) -> W::Output {
        match self {
            FormatName::F16 => action.run(Native::<f16>::new()),
            FormatName::Bf16 => action.run(Native::<bf16>::new()),
            FormatName::F32 => action.run(Native::<f32>::new()),
            FormatName::F64 => action.run(Native::<f64>::new()),
            FormatName::Mpfr(bits) => action.run(Mpfr { bits }),
        }
    }
}

#[cfg(test)]
mod tests;
