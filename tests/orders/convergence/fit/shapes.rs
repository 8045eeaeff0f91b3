//! What is said of ladders of one shape each: drifts, floors that nobody gave, two powers, two sequences.

use super::{doubling, samples};
use rug::Float;
use volver::convergence::{Fit, Note, Sample, Verdict, fit};
use volver::method::Expected;

fn of(levels: i32, error: impl Fn(f64) -> f64) -> Fit {
    let errors: Vec<f64> = (0..levels)
        .map(|k| error(0.125 * 0.5_f64.powi(k)))
        .collect();
    let mut samples = doubling(&errors);
    for sample in &mut samples {
        sample.step *= 0.125;
    }
    fit(&samples, None).unwrap()
}

fn holds(fit: &Fit, order: f64) -> bool {
    (fit.order.unwrap() - order).abs() <= fit.half_width.unwrap()
}

#[test]
fn an_order_that_still_drifts_is_extrapolated() {
    // 0.02·√d is left: two drifts tell.
    let half = of(8, |d| d * d * (1.0 + d.sqrt()));
    assert!(half.window.is_some() && holds(&half, 2.0));
    let last = half.pairs.last().unwrap().order;
    assert!((half.order.unwrap() - 2.0).abs() < 0.2 * (last - 2.0));
}

#[test]
fn a_slow_drift_is_no_order() {
    for q in [0.1, 0.2, 0.25, 0.35] {
        let slow = of(10, |d| d * d * (1.0 + d.powf(q)));
        assert_eq!(
            (slow.verdict, slow.window),
            (Verdict::PreAsymptotic, None),
            "{q}"
        );
        let near = |note: &Note| matches!(note, Note::SlowDrift { next } if *next < 0.4);
        assert!(slow.notes.iter().any(near), "{q}: {:?}", slow.notes);
    }
}

#[test]
fn a_drift_that_grows_makes_no_window() {
    // The cube leads at these levels.
    let growing = of(5, |d| d * d + 800.0 * d.powi(3));
    assert_eq!(
        (growing.verdict, growing.window),
        (Verdict::PreAsymptotic, None)
    );
    assert!(growing.notes.contains(&Note::GrowingDrift));
    // So small a drift is seen by its direction alone.
    let early = of(8, |d| d.powi(4) * (1.0 + 1e-7 / d));
    assert_eq!(early.window, None, "{early:?}");
}

#[test]
fn one_order_gives_way_to_another() {
    let change = |fit: &Fit| {
        fit.notes.iter().find_map(|note| match note {
            Note::GivesWay { from, to, step } => Some((*from, *to, *step)),
            _ => None,
        })
    };
    for sign in [1.0, -1.0] {
        // A gradient that is wrong in its first order.
        let found = change(&of(10, |d| d * d + sign * d / 100.0));
        let (from, to, step) = found.unwrap();
        assert_eq!((from, to), (2.0, 1.0));
        assert!((step * 100.0 - 1.0).abs() < 1e-9);
    }
    let halves = change(&of(10, |d| d.powf(2.5) + d.powf(1.5) / 100.0)).unwrap();
    assert_eq!((halves.0, halves.1), (2.5, 1.5));
    assert!((halves.2 * 100.0 - 1.0).abs() < 1e-9);
    // One order, and two whose change-over is beyond the ladder.
    assert_eq!(change(&of(10, |d| d * d)), None);
    assert_eq!(change(&of(10, |d| d * d + 1e-6 * d)), None);
    assert_eq!(change(&of(10, |d| d * d * (1.0 + d * d))), None);
    // Three powers are not two.
    assert_eq!(
        change(&of(10, |d| d.powi(3) + d * d / 16.0 + d / 2048.0)),
        None
    );
}

/// Roundoff as it comes: signs and sizes without a rule.
const NOISE: [f64; 12] = [
    0.3, -1.2, 0.7, 0.2, -0.5, 1.1, -0.8, 0.6, 1.4, -0.4, 0.9, -1.3,
];

#[test]
fn a_floor_shows_where_errors_stop_falling() {
    for growth in [0.0, 0.5] {
        let errors: Vec<f64> = (0..12)
            .map(|k| {
                let noise = 1e-13 * (growth * f64::from(k)).exp2() * NOISE[k as usize];
                0.125 * 0.5_f64.powi(5 * k) + noise
            })
            .collect();
        let fit = fit(&doubling(&errors), Some(Expected::Order(5.0))).unwrap();
        assert_eq!(fit.verdict, Verdict::Confirmed, "{fit:?}");
        assert!(fit.half_width.unwrap() < 0.1);
        let window = fit.window.unwrap();
        assert_eq!(window.first, 0);
        let cut = fit.cut.as_ref().unwrap();
        assert!((window.last + 1..=9).contains(&cut.level));
        let stops = fit.notes.iter().find_map(|note| match note {
            Note::StopsFalling { log2_error, .. } => Some(log2_error.exp2()),
            _ => None,
        });
        assert!((1e-14..1e-11).contains(&stops.unwrap()), "{stops:?}");
        assert!(fit.floor.is_zero());
    }
}

#[test]
fn a_floor_that_nobody_gave_is_none_where_errors_only_wait() {
    // A plateau is a plateau, smooth or not; growth that follows a rule is growth.
    let smooth = of(10, |d| d.powi(3) + 1e-6);
    assert_eq!(smooth.verdict, Verdict::Stalled);
    let errors: Vec<f64> = (0..12)
        .map(|k| 0.5_f64.powi(4 * k) + 1e-5 * (1.0 + 0.08 * NOISE[k as usize]))
        .collect();
    let jitter = fit(&doubling(&errors), None).unwrap();
    assert_eq!(jitter.verdict, Verdict::Stalled, "{jitter:?}");
    let late = of(10, |d| d.powi(4) + 1e-9 / d);
    assert_eq!(late.verdict, Verdict::Diverged);
}

#[test]
fn one_level_that_stands_apart_is_a_remark() {
    let mut errors = [4.0, 1.4, 3.1, 3.8, 3.4, 1.6, 2.1, 7e4].map(|e| e * 1e-15);
    let apart = |errors: &[f64]| fit(&doubling(errors), None).unwrap();
    let fit = apart(&errors);
    assert_ne!(fit.verdict, Verdict::Diverged);
    let of_level = |fit: &Fit| {
        fit.notes.iter().find_map(|note| match note {
            Note::StepsUp { level, .. } => Some(*level),
            _ => None,
        })
    };
    assert_eq!(of_level(&fit), Some(7));
    errors[7] = 2e-13;
    assert_eq!(of_level(&apart(&errors)), None);
}

#[test]
fn two_sequences_by_parity_are_told() {
    let levels = [8_u32, 9, 16, 17, 32, 33, 64, 65, 128, 129];
    let with = |odd: f64| {
        let samples: Vec<Sample> = levels
            .iter()
            .map(|n| {
                let d = 1.0 / f64::from(*n);
                let factor = if n % 2 == 1 { odd } else { 1.0 };
                Sample {
                    n: Some(u64::from(*n)),
                    step: d,
                    error: Float::with_val(53, factor * d * d * (1.0 + 0.1 * d)),
                    floor: Float::new(53),
                }
            })
            .collect();
        let fit = fit(&samples, None).unwrap();
        fit.notes.iter().find_map(|note| match note {
            Note::TwoSequences { factor } => Some(*factor),
            _ => None,
        })
    };
    assert!((with(3.0).unwrap() / 3.0 - 1.0).abs() < 0.01);
    assert!((with(0.5).unwrap() / 0.5 - 1.0).abs() < 0.01);
    assert_eq!(with(1.0), None);
    assert_eq!(with(1.05), None);
}

#[test]
fn a_coefficient_that_swings_from_level_to_level_is_oscillation() {
    let errors: Vec<f64> = (0..10)
        .map(|k| 0.25_f64.powi(k) * if k % 2 == 0 { 1.1 } else { 0.9 })
        .collect();
    let swings = fit(&doubling(&errors), Some(Expected::Order(2.0))).unwrap();
    assert_eq!(swings.verdict, Verdict::Oscillatory);
}

#[test]
fn what_floors_explain_is_no_drift() {
    // Orders that would drift slowly, if they were known to more than a hundredth.
    let rows = [0.0, 2.02, 4.035, 6.047, 8.057].map(|x: f64| (-x).exp2());
    let with = |floor: f64| {
        let rows: Vec<(f64, f64, f64)> = rows
            .iter()
            .zip(0..)
            .map(|(error, k)| (0.5_f64.powi(k), *error, floor))
            .collect();
        fit(&samples(&rows), Some(Expected::Order(2.0))).unwrap()
    };
    assert_eq!(with(1e-9).window, None);
    let known = with(0.01 * rows[4]);
    assert_eq!(known.verdict, Verdict::Confirmed, "{known:?}");
}
