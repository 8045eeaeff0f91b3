//! Errors with standard errors: how often a firm order is wrong, and what is refused.

use crate::convergence::random::Random;
use rug::Float;
use volver::convergence::{FitError, Sample, Verdict, fit_uncertain};
use volver::method::Expected;

fn floats(numbers: &[f64]) -> Vec<Float> {
    numbers.iter().map(|x| Float::with_val(53, *x)).collect()
}

fn samples(errors: &[f64]) -> Vec<Sample> {
    errors
        .iter()
        .zip(0..)
        .map(|(error, k)| Sample {
            n: None,
            step: 0.5_f64.powi(k),
            error: Float::with_val(53, *error),
            floor: Float::new(53),
        })
        .collect()
}

/// (firm, wrong) of ladders d^p(1 + a·d^q) with normal noise of 10⁻⁴ to a third of the error, falling or not.
fn measure(q: Option<f64>, trials: u32) -> (u32, u32) {
    let mut random = Random::new(5);
    let (mut firm, mut wrong) = (0, 0);
    for _ in 0..trials {
        let p = 0.5 * (1 + random.below(4)) as f64;
        let a = q.map_or(0.0, |_| random.uniform(-2.0, 2.0));
        let size = 10_f64.powf(random.uniform(-4.0, -0.5)) * 0.125_f64.powf(p);
        let fall = random.uniform(0.0, 1.5);
        let (mut levels, mut deviations) = (Vec::new(), Vec::new());
        for k in 0..i32::try_from(8 + random.below(3)).unwrap() {
            let relative = 0.5_f64.powi(k);
            let d = 0.125 * relative;
            let deviation = size * relative.powf(fall);
            let error = d.powf(p) * (1.0 + a * d.powf(q.unwrap_or(1.0)));
            levels.push(Sample {
                n: None,
                step: d,
                error: Float::with_val(53, error + deviation * random.normal()),
                floor: Float::new(53),
            });
            deviations.push(deviation);
        }
        let fit = fit_uncertain(&levels, &floats(&deviations), None).unwrap();
        if fit.verdict == Verdict::Fitted {
            firm += 1;
            wrong += u32::from((fit.order.unwrap() - p).abs() > fit.half_width.unwrap());
        }
    }
    println!("next power {q:?}: of {trials} firm {firm}, wrong {wrong}");
    (firm, wrong)
}

fn hold(trials: u32) {
    for (q, share) in [
        (None, 60),
        (Some(2.0), 60),
        (Some(1.0), 45),
        (Some(0.5), 30),
    ] {
        let (firm, wrong) = measure(q, trials);
        assert!(1000 * wrong <= trials, "{q:?}: {wrong} wrong");
        assert!(100 * firm >= share * trials, "{q:?}: {firm} firm");
    }
}

#[test]
fn orders_of_uncertain_errors_are_right() {
    hold(1000);
}

#[test]
#[ignore = "ten seconds: the figures of docs/trust.md; 1,000 of each run always"]
fn attack_orders_of_uncertain_errors_are_right() {
    hold(20_000);
}

#[test]
fn levels_that_may_be_zero_do_not_count() {
    // 2⁻ᵏ: significant up to |e| > 4σ.
    let errors: Vec<f64> = (0..8).map(|k| 0.5_f64.powi(k)).collect();
    let with = |size: f64| {
        let fit = fit_uncertain(
            &samples(&errors),
            &floats(&[size; 8]),
            Some(Expected::Order(1.0)),
        );
        let fit = fit.unwrap();
        (fit.window.map(|w| w.last), fit.verdict)
    };
    assert_eq!(with(0.001), (Some(7), Verdict::Confirmed));
    assert_eq!(with(0.5_f64.powi(9)), (Some(6), Verdict::Confirmed));
    assert_eq!(with(0.1).1, Verdict::FloorLimited);
    assert_eq!(with(2.0).1, Verdict::FloorLimited);
}

#[test]
fn levels_on_no_straight_line_make_no_order() {
    let errors: Vec<f64> = [0.0_f64, 1.5, 2.0, 3.5, 4.0, 5.5]
        .map(|x| (-x).exp2())
        .to_vec();
    let with = |share: f64| {
        let deviations: Vec<f64> = errors.iter().map(|e| share * e).collect();
        fit_uncertain(&samples(&errors), &floats(&deviations), None).unwrap()
    };
    assert_eq!(with(0.001).window, None);
    assert_eq!(with(0.001).verdict, Verdict::PreAsymptotic);
    // A fifth of every error is enough to make that a line.
    assert_eq!(with(0.2).window.map(|w| (w.first, w.last)), Some((0, 5)));
}

#[test]
fn standard_errors_that_are_none_are_named() {
    let of = |deviations: &[f64]| {
        fit_uncertain(&samples(&[4.0, 2.0, 1.0]), &floats(deviations), None).unwrap_err()
    };
    assert_eq!(
        of(&[0.1, 0.1]),
        FitError::StandardErrors {
            given: 2,
            levels: 3
        }
    );
    for size in [0.0, -1.0, f64::INFINITY] {
        assert_eq!(
            of(&[0.1, size, 0.1]),
            FitError::StandardError { level: 1, size }
        );
    }
    assert!(matches!(
        of(&[f64::NAN, 0.1, 0.1]),
        FitError::StandardError { level: 0, .. }
    ));
}
