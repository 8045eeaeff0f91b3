//! What became of one method at one level in one format.

use crate::convergence::serialize_float;
use rug::Float;
use serde::Serialize;

/// The signed parts of an error; they add up to `total`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Split {
    /// `Q_f` − I.
    #[serde(serialize_with = "serialize_float")]
    pub total: Float,
    /// Q_∞ − I, of the whole ray.
    #[serde(serialize_with = "serialize_float")]
    pub discretization: Float,
    /// Q_∞ stopped where f stopped, less Q_∞ of the whole ray; 0 for a method that never stops early.
    #[serde(serialize_with = "serialize_float")]
    pub truncation: Float,
    /// Q_∞(the inputs f used) − Q_∞.
    #[serde(serialize_with = "serialize_float")]
    pub input: Float,
    /// `Q_f` − Q_∞(the inputs f used).
    #[serde(serialize_with = "serialize_float")]
    pub arithmetic: Float,
    /// The share of `arithmetic` that comes of the transmittances; `None` where a method has none of its own.
    #[serde(serialize_with = "serialize_optional")]
    pub of_depth: Option<Float>,
    /// Magnitude below which the oracle's own rounding hides a part.
    #[serde(serialize_with = "serialize_float")]
    pub resolution: Float,
    /// Bits of the oracle.
    pub bits: u32,
}

impl Split {
    /// Input and arithmetic rounding together.
    #[must_use]
    pub fn rounding(&self) -> Float {
        Float::with_val(self.arithmetic.prec(), &self.input + &self.arithmetic)
    }

    /// The share of arithmetic rounding that comes of summing the radiance.
    #[must_use]
    pub fn of_radiance(&self) -> Float {
        match &self.of_depth {
            Some(of_depth) => Float::with_val(self.arithmetic.prec(), &self.arithmetic - of_depth),
            None => self.arithmetic.clone(),
        }
    }
}

/// What became of one method at one level in one format.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "cell", rename_all = "kebab-case")]
pub enum Cell {
    /// The error and its parts.
    Split(Split),
    /// The run in f stood on another side of a jump, or stopped elsewhere, than the same code in MPFR: its
    /// inputs belong to another problem.
    BranchDiverged {
        /// `Q_f` − I.
        #[serde(serialize_with = "serialize_float")]
        total: Float,
    },
    /// NaN or ∞ in the run or in its oracle.
    NotFinite {
        /// `Q_f` − I, not finite where the run is not.
        #[serde(serialize_with = "serialize_float")]
        total: Float,
    },
    /// Some part stayed within what the oracle cannot tell, up to so many bits.
    Unsettled {
        /// `Q_f` − I.
        #[serde(serialize_with = "serialize_float")]
        total: Float,
        /// The most bits that were tried.
        bits: u32,
    },
}

impl Cell {
    /// `Q_f` − I.
    #[must_use]
    pub fn total(&self) -> &Float {
        match self {
            Cell::Split(split) => &split.total,
            Cell::BranchDiverged { total }
            | Cell::NotFinite { total }
            | Cell::Unsettled { total, .. } => total,
        }
    }

    /// The parts, where there are.
    #[must_use]
    pub fn split(&self) -> Option<&Split> {
        match self {
            Cell::Split(split) => Some(split),
            _ => None,
        }
    }
}

#[expect(clippy::ref_option, reason = "the shape that serde asks for")]
fn serialize_optional<S: serde::Serializer>(
    x: &Option<Float>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match x {
        Some(x) => serialize_float(x, serializer),
        None => serializer.serialize_none(),
    }
}
