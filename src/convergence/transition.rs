//! Two terms of an error at once: where one order hands over to another.

use super::fit::FLOOR_MARGIN;
use super::sample::{Sample, log2_abs, serialize_float};
use rug::Float;
use rug::ops::Pow;
use serde::Serialize;
use statrs::distribution::{ContinuousCDF, StudentsT};

/// Levels used: the finest ones above the floor.
const LEVELS: usize = 4;
/// Working precision in bits; the errors' own, where that is more.
const BITS: u32 = 128;
/// Steps are binary64, so that no term is known better than this, relative to the error.
const STEP_ROUNDING: f64 = 1.0 / (1_u64 << 46) as f64;

/// e(d) ≈ a·dᴾ + b·dᑫ with P > Q: the second term takes over below the crossover step.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Transition {
    /// a, the coefficient of dᴾ.
    #[serde(serialize_with = "serialize_float")]
    pub high: Float,
    /// b, the coefficient of dᑫ.
    #[serde(serialize_with = "serialize_float")]
    pub low: Float,
    /// Root mean square of (model − e)/e over the levels used.
    pub residual: f64,
    /// The step d* with |a|·d*ᴾ = |b|·d*ᑫ; `None` where a or b is not significant
    /// (95 % t-interval of the regression, plus what the floors and the rounding of steps allow).
    pub crossover: Option<f64>,
}

/// A transition that cannot be fitted.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TransitionError {
    /// The orders are not two finite numbers, the higher one first.
    #[error(
        "orders {high} and {low} are not allowed (allowed: finite, the first above the second)"
    )]
    Orders {
        /// P.
        high: f64,
        /// Q.
        low: f64,
    },
    /// Not enough levels stand above the floor.
    #[error(
        "{usable} levels above the floor are too few for a transition (allowed: {LEVELS} or more)"
    )]
    TooFewLevels {
        /// Levels above the floor.
        usable: usize,
    },
    /// The equations have no unique solution.
    #[error("the two terms cannot be told apart at these steps")]
    Singular,
}

/// Fits e(d) = a·dᴾ + b·dᑫ to the signed errors of the finest four levels with |e| > 30·floor.
///
/// Each equation is divided by its error, so that levels count alike: least squares of
/// (a·dᴾ + b·dᑫ)/e − 1. Valid where the next term is small at these levels; `residual` tells.
///
/// # Errors
///
/// [`TransitionError`] where P > Q does not hold, fewer than four levels are usable, or the two terms
/// are not independent at the steps given (equal or non-positive steps).
pub fn transition(samples: &[Sample], high: f64, low: f64) -> Result<Transition, TransitionError> {
    if !high.is_finite() || !low.is_finite() || high <= low {
        return Err(TransitionError::Orders { high, low });
    }
    let above = |s: &&Sample| {
        let margin = Float::with_val(s.floor.prec() + 8, &s.floor * FLOOR_MARGIN);
        s.error.is_finite() && Float::with_val(s.error.prec(), s.error.abs_ref()) > margin
    };
    let usable = samples.iter().filter(above).count();
    if usable < LEVELS {
        return Err(TransitionError::TooFewLevels { usable });
    }
    let finest: Vec<&Sample> = samples.iter().filter(above).skip(usable - LEVELS).collect();
    let bits = finest.iter().map(|s| s.error.prec()).fold(BITS, u32::max);
    let column = |order: f64| -> Vec<Float> {
        finest
            .iter()
            .map(|s| Float::with_val(bits, s.step).pow(order) / &s.error)
            .collect()
    };
    let (u, v) = (column(high), column(low));
    let dot = |x: &[Float], y: &[Float]| {
        let products = x.iter().zip(y).map(|(x, y)| Float::with_val(bits, x * y));
        products.fold(Float::new(bits), |sum, product| sum + product)
    };
    let (uu, uv, vv) = (dot(&u, &u), dot(&u, &v), dot(&v, &v));
    let determinant = Float::with_val(bits, &uu * &vv) - Float::with_val(bits, &uv * &uv);
    // 1 − cos² of the angle between the columns: they must differ by more than the steps' rounding.
    let apart = Float::with_val(bits, &uu * &vv) * STEP_ROUNDING * STEP_ROUNDING;
    if !determinant.is_finite() || determinant <= apart {
        return Err(TransitionError::Singular);
    }
    // Rows of the pseudo-inverse: a = Σ gᵢ·1, b = Σ hᵢ·1.
    let row = |near: &[Float], far: &[Float], own: &Float| -> Vec<Float> {
        let numerators = near.iter().zip(far).map(|(near, far)| {
            Float::with_val(bits, near * own) - Float::with_val(bits, far * &uv)
        });
        numerators.map(|x| x / &determinant).collect()
    };
    let (for_high, for_low) = (row(&u, &v, &vv), row(&v, &u, &uu));
    let sum = |row: &[Float]| row.iter().fold(Float::new(bits), |sum, x| sum + x);
    let (a, b) = (sum(&for_high), sum(&for_low));

    let squares: f64 = u
        .iter()
        .zip(&v)
        .map(|(u, v)| {
            let model = Float::with_val(bits, u * &a) + Float::with_val(bits, v * &b);
            (model - 1_u32).to_f64().powi(2)
        })
        .sum();
    let freedom = (LEVELS - 2) as f64;
    let spread = (squares / freedom).sqrt();
    let quantile =
        StudentsT::new(0.0, 1.0, freedom).map_or(f64::INFINITY, |t| t.inverse_cdf(0.975));
    let significant = |coefficient: &Float, row: &[Float]| {
        let scale = log2_abs(coefficient);
        let relative = |x: &Float| (log2_abs(x) - scale).exp2();
        let regression =
            quantile * spread * row.iter().map(|x| relative(x).powi(2)).sum::<f64>().sqrt();
        let known: f64 = row
            .iter()
            .zip(&finest)
            .map(|(x, s)| {
                let floor = (log2_abs(&s.floor) - log2_abs(&s.error)).exp2();
                relative(x) * (floor + STEP_ROUNDING)
            })
            .sum();
        regression + known < 1.0
    };
    let crossover = (significant(&a, &for_high) && significant(&b, &for_low))
        .then(|| ((log2_abs(&b) - log2_abs(&a)) / (high - low)).exp2())
        .filter(|d| d.is_normal());
    Ok(Transition {
        high: a,
        low: b,
        residual: (squares / LEVELS as f64).sqrt(),
        crossover,
    })
}
