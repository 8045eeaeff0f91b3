//! Formats by name: `f16`, `bf16`, `f32`, `f64`, `f32-lanes`, `f64-lanes`, `tf32`, `fp8-e4m3`, `fp8-e5m2`, `ieee:24,-126,127`,
//! `fixed:15`, `fixed:8.24`, `mpfr:256`.

mod error;
pub use error::FormatError;

use super::lanes::LaneFormat;
use super::{Fixed, Format, Ieee, MAX_INTEGER, Mpfr, Native};
use std::fmt;
use std::str::FromStr;

/// Fewest bits an MPFR format may have.
pub const MIN_BITS: u32 = 2;
/// Most bits an MPFR format may have here: a number then takes 128 KiB.
pub const MAX_BITS: u32 = 1 << 20;

/// A format chosen at run time; itself a [`Format`], of [`AnyReal`](super::AnyReal)s. Without the feature `half`, `f16` and
/// `bf16` are emulated: the same numbers, with functions rounded correctly.
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
    /// binary32 in [lanes](super::lanes).
    F32Lanes,
    /// binary64 in [lanes](super::lanes).
    F64Lanes,
    /// An emulated format after IEEE 754.
    Ieee(Ieee),
    /// A fixed-point format.
    Fixed(Fixed),
    /// MPFR with that many significant bits.
    Mpfr(u32),
}

impl FromStr for FormatName {
    type Err = FormatError;

    fn from_str(name: &str) -> Result<Self, FormatError> {
        match name {
            "f16" => Ok(FormatName::F16),
            "bf16" => Ok(FormatName::Bf16),
            "f32" => Ok(FormatName::F32),
            "f64" => Ok(FormatName::F64),
            "f32-lanes" => Ok(FormatName::F32Lanes),
            "f64-lanes" => Ok(FormatName::F64Lanes),
            "tf32" => Ok(FormatName::Ieee(Ieee::TF32)),
            "fp8-e4m3" => Ok(FormatName::Ieee(Ieee::E4M3)),
            "fp8-e5m2" => Ok(FormatName::Ieee(Ieee::E5M2)),
            _ => match name.split_once(':') {
                Some(("ieee", parameters)) => ieee(parameters).map(FormatName::Ieee),
                Some(("fixed", parameters)) => fixed(parameters).map(FormatName::Fixed),
                Some(("mpfr", bits)) => mpfr(bits).map(FormatName::Mpfr),
                _ => Err(FormatError::Unknown { name: name.into() }),
            },
        }
    }
}

/// An integer; a plus sign is no part of a name, though Rust's integers take one.
fn integer<T: FromStr>(digits: &str) -> Option<T> {
    let digits = Some(digits).filter(|digits| !digits.starts_with('+'))?;
    digits.parse().ok()
}

fn mpfr(bits: &str) -> Result<u32, FormatError> {
    integer(bits)
        .filter(|bits| (MIN_BITS..=MAX_BITS).contains(bits))
        .ok_or_else(|| FormatError::Precision { bits: bits.into() })
}

fn ieee(parameters: &str) -> Result<Ieee, FormatError> {
    let three = || {
        let mut parts = parameters.split(',');
        let bits = integer(parts.next()?)?;
        let emin = integer(parts.next()?)?;
        let emax = integer(parts.next()?)?;
        parts.next().is_none().then_some((bits, emin, emax))
    };
    let (bits, emin, emax) = three().ok_or_else(|| FormatError::Ieee {
        parameters: parameters.into(),
    })?;
    Ieee::new(bits, emin, emax)
}

fn fixed(parameters: &str) -> Result<Fixed, FormatError> {
    let places = match parameters.split_once('.') {
        Some((before, after)) => integer(before).zip(integer(after)),
        None => integer(parameters).map(|after| (MAX_INTEGER, after)),
    };
    let (integer, fraction) = places.ok_or_else(|| FormatError::Fixed {
        parameters: parameters.into(),
    })?;
    Fixed::new(integer, fraction)
}

impl fmt::Display for FormatName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FormatName::F16 => f.pad("f16"),
            FormatName::Bf16 => f.pad("bf16"),
            FormatName::F32 => f.pad("f32"),
            FormatName::F64 => f.pad("f64"),
            FormatName::F32Lanes => f.pad("f32-lanes"),
            FormatName::F64Lanes => f.pad("f64-lanes"),
            FormatName::Ieee(format) => format.fmt(f),
            FormatName::Fixed(format) => format.fmt(f),
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
    /// Significant bits, as [`Format::bits`] counts them.
    #[must_use]
    pub fn bits(self) -> u32 {
        Format::bits(self)
    }

    /// The smallest normal number, 2^emin; `None` of a fixed-point format, and of MPFR, whose numbers end out of reach.
    #[must_use]
    pub fn smallest_normal(self) -> Option<f64> {
        self.emin().map(|emin| f64::from(emin).exp2())
    }

    /// What one rounding to nearest takes of a number of that size at most: 2^(−bits) |x|, and half the least positive number
    /// where that is more; of a fixed-point format half its quantum.
    #[must_use]
    pub fn half_unit(self, size: f64) -> f64 {
        let bits = f64::from(self.bits());
        match (self, self.emin()) {
            (FormatName::Fixed(format), _) => (-f64::from(format.fraction_bits()) - 1.0).exp2(),
            (_, Some(emin)) => ((-bits).exp2() * size.abs()).max((f64::from(emin) - bits).exp2()),
            (_, None) => (-bits).exp2() * size.abs(),
        }
    }

    /// The exponent of the smallest normal number.
    pub(crate) fn emin(self) -> Option<i32> {
        match self {
            FormatName::F16 => Some(-14),
            FormatName::Bf16 | FormatName::F32 | FormatName::F32Lanes => Some(-126),
            FormatName::F64 | FormatName::F64Lanes => Some(-1022),
            FormatName::Ieee(format) => Some(format.emin()),
            FormatName::Fixed(_) | FormatName::Mpfr(_) => None,
        }
    }

    /// Does `action` in this format. What is done in binary32, binary64, both in lanes, and MPFR is compiled for each of them;
    /// in all other formats the numbers are [`AnyReal`](super::AnyReal)s, so that it is compiled once for them together.
    pub fn with<W: WithFormat>(self, action: W) -> W::Output {
        match self {
            FormatName::F32 => action.run(Native::<f32>::new()),
            FormatName::F64 => action.run(Native::<f64>::new()),
            FormatName::F32Lanes => action.run(LaneFormat::<f32>::new()),
            FormatName::F64Lanes => action.run(LaneFormat::<f64>::new()),
            FormatName::Mpfr(bits) => action.run(Mpfr { bits }),
            FormatName::F16 | FormatName::Bf16 | FormatName::Ieee(_) | FormatName::Fixed(_) => {
                action.run(self)
            }
        }
    }
}
