//! Orders from the differences of values, without an exact one.

use rug::Float;
use rug::ops::Pow;
use volver::convergence::{
    Fit, FitError, Note, RichardsonError, Sample, ValueSample, Verdict, fit,
    fit_differences as fit_both,
};
use volver::inside::convergence::start;
use volver::method::Expected;

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
    fit_both(values, expected).map(|f| f.fit)
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
        let errors = fit_both(&samples, None).unwrap().samples;
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
