//! The limits of trends and verdicts, one number beside each.

use volver::convergence::Verdict;
use volver::inside::convergence::{Beyond, Estimate, Evidence, Trend, alternate, judge};
use volver::method::Expected;

#[test]
fn a_trend_goes_by_the_true_step_ratios() {
    // (log₂ step, log₂ |error|) at ratios of 16 and of 2^¼.
    let line = |ratio: f64, order: f64| -> Vec<(f64, f64)> {
        let point = |k: i32| (-ratio * f64::from(k), 7.0 - order * ratio * f64::from(k));
        (0..4).map(point).collect()
    };
    for ratio in [4.0, 1.0, 0.25] {
        for (order, trend) in [
            (2.0, Trend::Converging),
            (0.11, Trend::Converging),
            (0.09, Trend::Flat),
            (-0.09, Trend::Flat),
            (-0.11, Trend::Growing),
            (-3.0, Trend::Growing),
        ] {
            assert_eq!(Trend::of(&line(ratio, order)), trend, "{ratio} {order}");
        }
    }
    // Two levels are too few; of five, the coarsest does not count.
    let growing = line(1.0, -1.0);
    assert_eq!(Trend::of(&growing[..2]), Trend::Converging);
    assert_eq!(Trend::of(&growing[..3]), Trend::Growing);
    assert_eq!(Trend::of(&[]), Trend::Converging);
    let mut late = growing;
    late.insert(0, (1.0, 20.0));
    assert_eq!(Trend::of(&late), Trend::Growing);
}

#[test]
fn the_limits_of_convergence_and_of_the_interval_are_inclusive() {
    let verdict = |order: f64, half_width: f64, expected: f64| {
        let evidence = Evidence {
            levels: 4,
            finite: true,
            all_at_floor: false,
            all_zero: false,
            beyond: Beyond::Nothing,
            trend: Trend::Converging,
            late_sign_changes: 0,
            estimate: Some(Estimate {
                order,
                half_width,
                floor_share: 0.0,
                sign_change: false,
            }),
        };
        judge(&evidence, Some(Expected::Order(expected)))
    };
    assert_eq!(verdict(0.1, 0.01, 0.1), Verdict::Confirmed);
    assert_eq!(verdict(0.099, 0.01, 0.1), Verdict::Stalled);
    assert_eq!(verdict(-0.099, 0.01, 0.1), Verdict::Stalled);
    assert_eq!(verdict(-0.1, 0.01, 0.1), Verdict::Diverged);
    // Growth has an interval below 0.
    assert_eq!(verdict(-0.1, 0.099, 0.1), Verdict::Diverged);
    assert_ne!(verdict(-0.1, 0.1, 0.1), Verdict::Diverged);
    assert_eq!(verdict(2.0, 0.25, 2.25), Verdict::Confirmed);
    assert_eq!(verdict(2.0, 0.25, 1.75), Verdict::Confirmed);
    assert_eq!(verdict(2.0, 0.25, 2.251), Verdict::TooLow);
    assert_eq!(verdict(2.0, 0.25, 1.749), Verdict::TooHigh);
    assert_eq!(verdict(2.0, 0.250_001, 2.0), Verdict::PreAsymptotic);
}

/// (log₂ step, log₂ |error|) at a ratio of 2 with these pairwise orders.
fn points(orders: &[f64]) -> Vec<(f64, f64)> {
    let mut at = (0.0, 0.0);
    let mut points = vec![at];
    for order in orders {
        at = (at.0 - 1.0, at.1 - order);
        points.push(at);
    }
    points
}

#[test]
fn growth_shows_over_three_levels_and_not_by_one_step() {
    let trend = |orders: &[f64]| Trend::of(&points(orders));
    assert_eq!(trend(&[2.0, -1.0, -1.0]), Trend::Converging);
    assert_eq!(trend(&[2.0, 2.0, -0.3, -0.8, -0.5]), Trend::Growing);
    // Net −5.1, and 10 from it: one level that stands apart.
    assert_eq!(trend(&[-0.1, -0.2, -15.0]), Trend::Converging);
}

#[test]
fn five_orders_near_zero_stall_however_they_jitter() {
    let trend = |orders: &[f64]| Trend::of(&points(orders));
    let jitter = [0.34, -0.3, 0.3, -0.34, 0.2];
    assert_eq!(trend(&jitter), Trend::Flat);
    assert_eq!(trend(&[2.0, 0.34, -0.3, 0.3, -0.34, 0.2]), Trend::Flat);
    assert_eq!(trend(&jitter[1..]), Trend::Converging);
    assert_eq!(trend(&[0.36, -0.3, 0.3, -0.34, 0.2]), Trend::Converging);
    // An order of 0.3 is one.
    assert_eq!(trend(&[0.3, 0.3, 0.3, 0.3, 0.3]), Trend::Converging);
}

#[test]
fn a_coefficient_that_swings_shows_over_five_orders() {
    assert!(alternate(&[1.9, 2.1, 1.9, 2.1, 1.9]));
    assert!(alternate(&[7.0, 1.9, 2.1, 1.9, 2.1, 1.9]));
    assert!(!alternate(&[1.9, 2.1, 1.9, 2.1]));
    assert!(!alternate(&[1.9, 2.1, 2.3, 2.1, 1.9]));
    assert!(!alternate(&[1.95, 2.05, 1.95, 2.05, 1.96]));
}
