//! Orders of errors that scatter from level to level.

use rug::Float;
use volver::convergence::{Sample, Verdict};
use volver::method::Expected;
use volver::study::nonsmooth::{Measured, Place, STARTS, judge, level, numbers};

/// Errors of a moving place: `error` of n, with a floor.
fn measured(error: impl Fn(f64) -> f64, floor: f64, expected: Expected) -> Measured {
    let place = Place::Moving;
    let samples: Vec<Sample> = STARTS
        .iter()
        .flat_map(|&start| numbers(place, start))
        .map(|n| Sample {
            n: Some(n),
            step: 1.0 / n as f64,
            error: Float::with_val(53, error(n as f64)),
            floor: Float::with_val(53, floor),
        })
        .collect();
    let levels: Vec<_> = STARTS
        .iter()
        .filter_map(|&start| level(place, start, &samples))
        .collect();
    assert_eq!(levels.len(), STARTS.len());
    judge(&levels, expected)
}

#[test]
fn a_power_is_found_exactly_although_coarse_levels_span_a_factor_of_two() {
    let found = measured(|n| 3.0 * n.powi(-6), 0.0, Expected::Order(6.0));
    assert!((found.order.unwrap() - 6.0).abs() < 1e-9, "{found:?}");
    let seventh = measured(|n| n.powi(-6), 0.0, Expected::Order(7.0));
    assert_eq!(seventh.verdict, Verdict::TooLow);
    let fifth = measured(|n| n.powi(-6), 0.0, Expected::Order(5.0));
    assert_eq!(fifth.verdict, Verdict::TooHigh);
}

#[test]
fn a_coefficient_that_scatters_in_sign_and_size_hides_no_order() {
    let golden = |n: f64| (n * 0.618_033_988_749_894_8).fract() - 0.5;
    let found = measured(|n| golden(n) * n.powi(-2), 0.0, Expected::Order(2.0));
    assert_eq!(found.verdict, Verdict::Confirmed, "{found:?}");
    assert!(found.half_width.unwrap() < 0.15, "{found:?}");
}

#[test]
fn drift_widens_the_interval() {
    let found = measured(|n| n.powi(-1) + 4.0 * n.powi(-2), 0.0, Expected::Order(1.0));
    assert_eq!(found.verdict, Verdict::Confirmed, "{found:?}");
    let wild = measured(|n| n.powi(-1) + 1e6 * n.powi(-4), 0.0, Expected::Order(1.0));
    assert_eq!(wild.verdict, Verdict::PreAsymptotic, "{wild:?}");
}

#[test]
fn floors_and_what_is_not_finite_are_verdicts_of_their_own() {
    let second = Expected::Order(2.0);
    let verdict = |found: Measured| (found.order, found.verdict);
    let floor = measured(|n| n.powi(-2), 1e-7, second);
    assert_eq!(verdict(floor), (None, Verdict::FloorLimited));
    let exact = measured(|_| 0.0, 1e-30, Expected::Exact);
    assert_eq!(verdict(exact), (None, Verdict::Exact));
    let nan = measured(|n| if n == 512.0 { f64::NAN } else { 1.0 }, 0.0, second);
    assert_eq!(verdict(nan), (None, Verdict::NotFinite));
    assert_eq!(judge(&[], second).verdict, Verdict::TooFewLevels);
    let unknown = measured(|n| n.powi(-2), 0.0, Expected::Unknown);
    assert_eq!(unknown.verdict, Verdict::Fitted);
}
