//! One run at one refinement level.

use crate::real::{MpfrReal, Real};
use rug::Float;
use serde::{Serialize, Serializer};

/// The smallest nonzero magnitude that [`serialize_float`] writes as a number.
pub const JSON_NUMBER_MIN: f64 = 1e-300;

/// One run at one level: its step, its signed error, and the roundoff floor there.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
pub struct Sample {
    /// Number of segments, where the step divides the ray.
    pub n: Option<u64>,
    /// Step d > 0.
    pub step: f64,
    /// Signed error, approximation − exact, of any precision and magnitude.
    #[serde(serialize_with = "serialize_float")]
    #[cfg_attr(feature = "studies", schemars(schema_with = "float_schema"))]
    pub error: Float,
    /// Magnitude below which the error is roundoff; 0 where none is known.
    #[serde(serialize_with = "serialize_float")]
    #[cfg_attr(feature = "studies", schemars(schema_with = "float_schema"))]
    pub floor: Float,
}

/// log₂|x|, −∞ for 0; magnitudes far outside binary64's range are fine.
pub(super) fn log2_abs(x: &Float) -> f64 {
    MpfrReal::from(x.clone()).log2_abs()
}

/// Writes `x` as a JSON number where binary64 holds it well (0, or 1e-300 ≤ |x| ≤ binary64's
/// largest), otherwise as a string: decimal with 17 digits, or `NaN`, `inf`, `-inf`.
///
/// # Errors
///
/// Those of the serializer.
pub fn serialize_float<S: Serializer>(x: &Float, serializer: S) -> Result<S::Ok, S::Error> {
    let narrow = x.to_f64();
    if x.is_zero() || (narrow.is_finite() && narrow.abs() >= JSON_NUMBER_MIN) {
        serializer.serialize_f64(narrow)
    } else {
        serializer.serialize_str(&x.to_string_radix(10, Some(17)))
    }
}

/// What [`serialize_float`] writes, as a JSON Schema; null where it is optional.
#[cfg(feature = "studies")]
pub(crate) fn float_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    schemars::json_schema!({ "type": ["number", "string"] })
}
