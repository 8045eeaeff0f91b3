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

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(bits: u32, floor: f64, error: impl Fn(Float) -> Float) -> Vec<Sample> {
        (3..10)
            .map(|k| {
                let step = 0.5_f64.powi(k);
                Sample {
                    n: Some(1 << k),
                    step,
                    error: error(Float::with_val(bits, step)),
                    floor: Float::with_val(53, floor),
                }
            })
            .collect()
    }

    fn two_terms(d: Float) -> Float {
        -3_i32 * d.clone().pow(3_u32) + Float::with_val(200, 0.01) * d.pow(2_u32)
    }

    #[test]
    fn both_terms_and_their_crossover_are_found() {
        let found = transition(&samples(200, 0.0, two_terms), 3.0, 2.0).unwrap();
        assert!((found.high.to_f64() + 3.0).abs() < 1e-12);
        assert!((found.low.to_f64() - 0.01).abs() < 1e-12);
        assert!(found.residual < 1e-12);
        // 3 d³ = 0.01 d²: n* = 300.
        assert!((1.0 / found.crossover.unwrap() - 300.0).abs() < 1e-6);
    }

    #[test]
    fn magnitudes_do_not_matter() {
        let tiny = Float::with_val(200, 10).pow(-2000_i32);
        let found = transition(&samples(200, 0.0, |d| two_terms(d) * &tiny), 3.0, 2.0).unwrap();
        assert!((1.0 / found.crossover.unwrap() - 300.0).abs() < 1e-6);
        assert!((log2_abs(&found.high) - (3_f64.log2() - 2000.0 * 10_f64.log2())).abs() < 1e-6);
    }

    #[test]
    fn a_third_term_shows_in_the_residual_and_moves_the_crossover_little() {
        let third = |d: Float| two_terms(d.clone()) + 0.3 * d.pow(4_u32);
        let found = transition(&samples(200, 0.0, third), 3.0, 2.0).unwrap();
        assert!(
            found.residual > 1e-5 && found.residual < 1e-2,
            "{}",
            found.residual
        );
        assert!((1.0 / found.crossover.unwrap() - 300.0).abs() < 6.0);
    }

    #[test]
    fn a_single_term_has_no_crossover() {
        let cubic = transition(&samples(53, 0.0, |d| 3_u32 * d.pow(3_u32)), 3.0, 2.0).unwrap();
        assert_eq!(cubic.crossover, None);
        assert!((cubic.high.to_f64() - 3.0).abs() < 1e-12);
        let quadratic = transition(&samples(53, 0.0, |d| 3_u32 * d.pow(2_u32)), 3.0, 2.0).unwrap();
        assert_eq!(quadratic.crossover, None);
        // Scatter that the low term could explain is no proof of it.
        let mut sign = 1.0;
        let mut noisy = samples(53, 0.0, |d| 3_u32 * d.pow(3_u32));
        for sample in &mut noisy {
            sample.error *= 1.0 + 0.02 * sign;
            sign = -sign;
        }
        assert_eq!(transition(&noisy, 3.0, 2.0).unwrap().crossover, None);
    }

    #[test]
    fn a_term_as_small_as_the_floor_is_not_significant() {
        // At d = 1/512 the low term is 2e-9 d², 7e-15, and the error 2e-8.
        let hidden = |d: Float| 3_u32 * d.clone().pow(3_u32) + 2e-9 * d.pow(2_u32);
        let seen = transition(&samples(200, 0.0, hidden), 3.0, 2.0).unwrap();
        assert!(seen.crossover.is_some());
        let masked = transition(&samples(200, 1e-14, hidden), 3.0, 2.0).unwrap();
        assert_eq!(masked.crossover, None);
    }

    #[test]
    fn only_the_finest_four_levels_above_the_floor_count() {
        let mut disturbed = samples(200, 1e-12, two_terms);
        // Coarse levels and those at the floor say anything.
        disturbed[0].error = Float::with_val(53, 100);
        disturbed[5].error = Float::with_val(53, 2.9e-11);
        disturbed[6].error = Float::with_val(53, f64::NAN);
        let found = transition(&disturbed, 3.0, 2.0).unwrap();
        assert!((1.0 / found.crossover.unwrap() - 300.0).abs() < 1e-3);
        disturbed.remove(1);
        disturbed.remove(1);
        assert_eq!(
            transition(&disturbed, 3.0, 2.0),
            Err(TransitionError::TooFewLevels { usable: 3 })
        );
    }

    #[test]
    fn orders_and_steps_that_say_nothing_are_refused() {
        let good = samples(53, 0.0, two_terms);
        for (high, low) in [
            (2.0, 3.0),
            (2.0, 2.0),
            (f64::NAN, 1.0),
            (f64::INFINITY, 1.0),
        ] {
            assert!(matches!(
                transition(&good, high, low),
                Err(TransitionError::Orders { .. })
            ));
        }
        let mut same = good.clone();
        for sample in &mut same {
            sample.step = 0.1;
        }
        assert_eq!(transition(&same, 3.0, 2.0), Err(TransitionError::Singular));
        for sample in &mut same {
            sample.step = 0.0;
        }
        assert_eq!(transition(&same, 3.0, 2.0), Err(TransitionError::Singular));
    }
}
