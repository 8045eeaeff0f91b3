//! Orders from values alone, where no exact result is known.

use super::fit::check_steps;
use super::verdict::Verdict;
use super::{Fit, FitError, Note, Sample, fit};
use crate::method::Expected;
use rug::Float;
use serde::Serialize;

/// Rounds of the fixed point before it counts as unsettled.
const ROUNDS: usize = 60;
/// A change of the order smaller than this is settled.
const SETTLED: f64 = 1e-9;
/// Orders between −this and this count as this: at order 0 differences say nothing of errors.
const SMALLEST_ORDER: f64 = 1e-3;
/// Orders looked at.
const ORDERS: (f64, f64) = (-40.0, 40.0);

/// The value of one run at one level.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueSample {
    /// Number of segments, where the step divides the ray.
    pub n: Option<u64>,
    /// Step d > 0.
    pub step: f64,
    /// The value, with all the digits it has.
    pub value: Float,
    /// Magnitude of the roundoff in the value; 0 where none is known.
    pub floor: Float,
}

/// A fit to the errors that differences of values imply.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DifferenceFit {
    /// The fit.
    pub fit: Fit,
    /// The implied errors, one fewer than the values.
    pub samples: Vec<Sample>,
}

/// Values that no fit can take.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RichardsonError {
    /// As for errors.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// Differences cannot show exactness: a constant wrong value has none either.
    #[error(
        "an exact method cannot be told from differences of values (allowed: an expected order, or an exact value)"
    )]
    Exact,
}

/// Fits the order to which values converge, from the differences of neighbouring levels.
///
/// With e = c·dᵖ, vᵢ − vᵢ₊₁ = eᵢ·(1 − (dᵢ₊₁/dᵢ)ᵖ). The p of the last three values starts a fixed point:
/// eᵢ from the differences and p, p from [`fit`](fit()). For a constant ratio the factor is the same at
/// every level, and the order that of the differences. One level is lost.
///
/// The limit is not seen: values that converge to a wrong limit pass. Equal values are
/// `Stalled`, never `Exact`.
///
/// # Errors
///
/// [`RichardsonError`]: the errors of [`fit`](fit()), or `Exact` expected.
pub fn fit_differences(
    values: &[ValueSample],
    expected: Option<Expected>,
) -> Result<DifferenceFit, RichardsonError> {
    if expected == Some(Expected::Exact) {
        return Err(RichardsonError::Exact);
    }
    check_steps(values.iter().map(|v| v.step))?;
    let mut order = start(values).unwrap_or(1.0);
    let mut samples = errors(values, order);
    let mut result = fit(&samples, expected)?;
    let mut settled = false;
    for _ in 0..ROUNDS {
        let next = result.order.unwrap_or(order).clamp(ORDERS.0, ORDERS.1);
        settled = (next - order).abs() <= SETTLED;
        if settled {
            break;
        }
        order = next;
        samples = errors(values, order);
        result = fit(&samples, expected)?;
    }
    if result.verdict == Verdict::Exact {
        result.verdict = if result.floor.is_zero() {
            Verdict::Stalled
        } else {
            Verdict::FloorLimited
        };
    }
    if !settled && result.order.is_some() {
        result.notes.push(Note::Unsettled);
        if result.window.is_some() {
            result.verdict = Verdict::PreAsymptotic;
        }
    }
    result.notes.push(Note::FromDifferences);
    Ok(DifferenceFit {
        fit: result,
        samples,
    })
}

/// Errors that the differences imply if the order is `order`.
fn errors(values: &[ValueSample], order: f64) -> Vec<Sample> {
    let magnitude = order.abs().max(SMALLEST_ORDER);
    let order = if order < 0.0 { -magnitude } else { magnitude };
    values
        .windows(2)
        .map(|pair| {
            let bits = pair[0].value.prec().max(pair[1].value.prec());
            // 1 − ρᵖ without cancellation near ρ = 1.
            let factor = -(order * (pair[1].step / pair[0].step).ln()).exp_m1();
            let difference = Float::with_val(bits, &pair[0].value - &pair[1].value);
            let floor = Float::with_val(bits, &pair[0].floor + &pair[1].floor);
            Sample {
                n: pair[0].n,
                step: pair[0].step,
                error: difference / factor,
                floor: floor / factor.abs(),
            }
        })
        .collect()
}

/// The order of the last three values, by bisection of
/// (d₁ᵖ − d₂ᵖ)/(d₂ᵖ − d₃ᵖ) = |v₁ − v₂|/|v₂ − v₃|, which grows with p.
fn start(values: &[ValueSample]) -> Option<f64> {
    let [.., a, b, c] = values else { return None };
    let bits = a.value.prec().max(b.value.prec()).max(c.value.prec());
    let coarse = Float::with_val(bits, &a.value - &b.value).abs();
    let fine = Float::with_val(bits, &b.value - &c.value).abs();
    let target = (coarse / fine).to_f64().ln();
    let (x, y) = ((b.step / a.step).ln(), (c.step / b.step).ln());
    if !target.is_finite() || !x.is_normal() || !y.is_normal() {
        return None;
    }
    // ln of the left side: ln(1 − ρ₁ᵖ) − ln(1 − ρ₂ᵖ) − p·ln ρ₁.
    let left = |p: f64| (-(p * x).exp_m1() / -(p * y).exp_m1()).ln() - p * x;
    let (mut low, mut high) = ORDERS;
    for _ in 0..100 {
        let middle = low + (high - low) / 2.0;
        // At p = 0 both factors vanish; their quotient does not.
        let at = if middle.abs() < 1e-12 { 1e-12 } else { middle };
        if left(at) < target {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(low)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::ops::Pow;

    fn values(steps: &[f64], bits: u32, value: impl Fn(Float) -> Float) -> Vec<ValueSample> {
        steps
            .iter()
            .map(|step| ValueSample {
                n: None,
                step: *step,
                value: value(Float::with_val(bits, *step)),
                floor: Float::new(53),
            })
            .collect()
    }

    fn fit_differences(
        values: &[ValueSample],
        expected: Option<Expected>,
    ) -> Result<Fit, RichardsonError> {
        super::fit_differences(values, expected).map(|f| f.fit)
    }

    fn powers(ratio: f64, count: i32) -> Vec<f64> {
        (0..count).map(|k| ratio.powi(-k)).collect()
    }

    const SECOND: Option<Expected> = Some(Expected::Order(2.0));

    #[test]
    fn constant_ratios_give_the_order_and_the_constant_of_the_error() {
        for ratio in [2.0, 3.0, 1.5] {
            let samples = values(&powers(ratio, 8), 200, |h| 5_u32 - 0.25 * h.pow(2));
            let fit = fit_differences(&samples, SECOND).unwrap();
            assert_eq!(fit.verdict, Verdict::Confirmed, "{ratio}");
            // |e| = h²/4: the differences alone would give a constant smaller by 1 − r⁻².
            assert!((fit.log2_constant.unwrap() + 2.0).abs() < 1e-9);
            assert_eq!(fit.pairs.len(), 6);
            let errors = super::fit_differences(&samples, None).unwrap().samples;
            assert!((errors[0].error.to_f64() + 0.25).abs() < 1e-9);
            assert_eq!(fit.notes, [Note::FromDifferences]);
        }
    }

    #[test]
    fn changing_ratios_are_solved_for() {
        let steps = [1.0, 0.7, 0.41, 0.3, 0.18, 0.1, 0.07, 0.02];
        for p in [0.5, 1.0, 2.0, 4.0] {
            let samples = values(&steps, 300, |h| 1_u32 + 3_u32 * h.pow(p));
            let fit = fit_differences(&samples, Some(Expected::Order(p))).unwrap();
            assert_eq!(fit.verdict, Verdict::Confirmed, "{p}: {fit:?}");
            assert!(
                (fit.order.unwrap() - p).abs() < 1e-6,
                "{p}: {:?}",
                fit.order
            );
            assert!((fit.log2_constant.unwrap() - 3_f64.log2()).abs() < 1e-6);
            // The differences as they stand do not have one order at all.
            let raw = fit_ordinary_differences(&samples);
            assert!(raw.window.is_none() || (raw.order.unwrap() - p).abs() > 0.01);
        }
    }

    fn fit_ordinary_differences(samples: &[ValueSample]) -> Fit {
        let raw: Vec<Sample> = samples
            .windows(2)
            .map(|w| Sample {
                n: None,
                step: w[0].step,
                error: Float::with_val(300, &w[0].value - &w[1].value),
                floor: Float::new(53),
            })
            .collect();
        fit(&raw, None).unwrap()
    }

    #[test]
    fn the_start_solves_its_equation() {
        for p in [-2.0, -0.5, 0.3, 1.0, 6.0] {
            let samples = values(&[1.0, 0.6, 0.2], 200, |h| h.pow(p));
            assert!((start(&samples).unwrap() - p).abs() < 1e-9, "{p}");
        }
        let logarithm = values(&[1.0, 0.6, 0.2], 200, Float::ln);
        assert!(start(&logarithm).unwrap().abs() < 1e-6);
        assert_eq!(start(&logarithm[1..]), None);
        let constant = values(&[1.0, 0.6, 0.2], 200, |_| Float::with_val(53, 1));
        assert_eq!(start(&constant), None);
    }

    #[test]
    fn values_that_do_not_change_are_stalled_and_never_exact() {
        let constant = values(&powers(2.0, 6), 53, |_| Float::with_val(53, 0.5));
        assert_eq!(
            fit_differences(&constant, SECOND).unwrap().verdict,
            Verdict::Stalled
        );
        let mut rounded = constant.clone();
        for value in &mut rounded {
            value.floor = Float::with_val(53, 1e-6);
        }
        let fit = fit_differences(&rounded, SECOND).unwrap();
        assert_eq!(fit.verdict, Verdict::FloorLimited);
        assert_eq!(fit.floor, 2e-6 / (1.0 - 0.5_f64));
        assert_eq!(
            fit_differences(&constant, Some(Expected::Exact)),
            Err(RichardsonError::Exact)
        );
    }

    #[test]
    fn values_that_run_away_have_diverged() {
        for steps in [
            powers(2.0, 8),
            vec![1.0, 0.7, 0.41, 0.3, 0.18, 0.1, 0.07, 0.02],
        ] {
            let away = values(&steps, 100, |h| 1_u32 / h);
            let fit = fit_differences(&away, SECOND).unwrap();
            assert_eq!(fit.verdict, Verdict::Diverged);
            assert!((fit.order.unwrap() + 1.0).abs() < 1e-6);
        }
        let slowly = values(&powers(2.0, 8), 100, Float::ln);
        assert_eq!(
            fit_differences(&slowly, SECOND).unwrap().verdict,
            Verdict::Stalled
        );
    }

    #[test]
    fn too_few_values_and_bad_steps_are_named() {
        let four = values(&powers(2.0, 4), 53, |h| h.pow(2));
        assert_eq!(
            fit_differences(&four, SECOND).unwrap().verdict,
            Verdict::TooFewLevels
        );
        assert_eq!(
            fit_differences(&[], None).unwrap().verdict,
            Verdict::TooFewLevels
        );
        let rising = values(&[0.5, 0.25, 1.0, 0.1], 53, |h| h);
        assert!(matches!(
            fit_differences(&rising, None),
            Err(RichardsonError::Fit(FitError::NotDecreasing {
                level: 2,
                ..
            }))
        ));
        let last = values(&[1.0, 0.5, 0.25, 0.5], 53, |h| h);
        assert!(matches!(
            fit_differences(&last, None),
            Err(RichardsonError::Fit(FitError::NotDecreasing {
                level: 3,
                ..
            }))
        ));
        let mut nan = values(&powers(2.0, 6), 53, |h| h.pow(2));
        nan[2].value = Float::with_val(53, f64::NAN);
        assert_eq!(
            fit_differences(&nan, SECOND).unwrap().verdict,
            Verdict::NotFinite
        );
    }

    #[test]
    fn an_order_that_does_not_settle_confirms_nothing() {
        // Steps in alternating ratios, values in a pattern that no power fits.
        let steps = [1.0, 0.9, 0.3, 0.27, 0.09, 0.081, 0.027];
        let samples: Vec<ValueSample> = steps
            .iter()
            .zip([0.0, 1.0, 1.4, 1.7, 1.71, 1.9, 1.93])
            .map(|(step, v)| ValueSample {
                n: None,
                step: *step,
                value: Float::with_val(53, v),
                floor: Float::new(53),
            })
            .collect();
        let fit = fit_differences(&samples, SECOND).unwrap();
        assert!(!fit.verdict.passes(SECOND), "{fit:?}");
    }
}
