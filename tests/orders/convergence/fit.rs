//! The mechanics of a fit: floor, pairwise orders, window, half-width, input errors.

mod coverage;
mod families;
mod shapes;
mod uncertain;

use rug::Float;
use volver::convergence::{Fit, FitError, Sample, Verdict, fit};
use volver::method::Expected;

/// (step, error, floor), coarse to fine.
fn samples(rows: &[(f64, f64, f64)]) -> Vec<Sample> {
    rows.iter()
        .map(|(step, error, floor)| Sample {
            n: None,
            step: *step,
            error: Float::with_val(53, *error),
            floor: Float::with_val(53, *floor),
        })
        .collect()
}

fn doubling(errors: &[f64]) -> Vec<Sample> {
    let row = |(k, e): (usize, &f64)| (0.5_f64.powi(i32::try_from(k).unwrap()), *e, 0.0);
    samples(&errors.iter().enumerate().map(row).collect::<Vec<_>>())
}

fn orders(fit: &Fit) -> Vec<f64> {
    fit.pairs.iter().map(|p| p.order).collect()
}

#[test]
fn pairwise_orders_use_the_true_ratios_and_keep_the_sign_of_growth() {
    // Ratios 3, 2 and 5/4.
    let fit = fit(
        &samples(&[
            (3.0, -9.0, 0.0),
            (1.0, 1.0, 0.0),
            (0.5, 2.0, 0.0),
            (0.4, 1.28, 0.0),
        ]),
        None,
    )
    .unwrap();
    for (found, expected) in orders(&fit).into_iter().zip([2.0, -1.0, 2.0]) {
        assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    }
    let changes: Vec<bool> = fit.pairs.iter().map(|p| p.sign_change).collect();
    assert_eq!(changes, [true, false, false]);
}

#[test]
fn the_floor_is_a_running_maximum_and_drops_everything_finer() {
    // Floors 1e-6, 1e-3, then smaller ones: 30·1e-3 stays the limit.
    let fit = fit(
        &samples(&[
            (1.0, 1.0, 1e-6),
            (0.5, 0.25, 1e-3),
            (0.25, 0.0625, 1e-6),
            (0.125, 0.03, 1e-6),
            (0.0625, 1.0, 1e-6),
        ]),
        None,
    )
    .unwrap();
    let cut = fit.cut.unwrap();
    assert_eq!((cut.level, cut.step, cut.floor.to_f64()), (3, 0.125, 1e-3));
    assert_eq!(fit.floor, 1e-3_f64);
    let above: Vec<bool> = fit.pairs.iter().map(|p| p.above_floor).collect();
    assert_eq!(above, [true, true, false, false]);
}

#[test]
fn thirty_floors_exactly_are_roundoff() {
    let at = |error: f64| {
        let rows = [(1.0, 64.0, 1.0), (0.5, error, 1.0)];
        fit(&samples(&rows), None).unwrap().cut.map(|c| c.level)
    };
    assert_eq!(at(30.0), Some(1));
    assert_eq!(at(-30.0), Some(1));
    assert_eq!(at(30.000_000_000_000_004), None);
}

#[test]
fn window_and_half_width_of_a_worked_example() {
    // Pairwise orders 3, 2.015, 2, 1.99 at ratio 2, the last error at 2⁻¹³ floor/|e|.
    let exponents = [0.0_f64, 3.0, 5.015, 7.015, 9.005];
    let rows: Vec<(f64, f64, f64)> = exponents
        .iter()
        .enumerate()
        .map(|(k, x)| {
            let step = 0.5_f64.powi(i32::try_from(k).unwrap());
            (step, 4.0 * (-x).exp2(), (-20.0_f64).exp2())
        })
        .collect();
    let fit = fit(&samples(&rows), Some(Expected::Order(2.0))).unwrap();
    let window = fit.window.unwrap();
    assert_eq!((window.first, window.last), (1, 4));
    assert_eq!((window.coarsest_step, window.finest_step), (0.5, 0.0625));
    assert_eq!(window.tolerance, 0.05);
    // Drifts of 0.015 and 0.01: r^q = 1.5, and 0.01/(1.5 − 1) is left of 1.99.
    assert!((fit.order.unwrap() - 1.97).abs() < 1e-12);
    // c through the finest level: 2 − 9.005 + 4·1.97.
    assert!((fit.log2_constant.unwrap() - 0.875).abs() < 1e-12);
    // δ/(2^¼ − 1), with what floors may add to two neighbouring orders, and the floors' share of the last.
    let floor =
        |levels: [f64; 2]| levels.map(|x| (x - 22.0).exp2()).iter().sum::<f64>() / 2_f64.ln();
    let noise = floor([5.015, 7.015]) + floor([7.015, 9.005]);
    let half_width = (0.01 + noise) / (2_f64.powf(0.25) - 1.0) + floor([7.015, 9.005]);
    assert!((fit.half_width.unwrap() - half_width).abs() < 1e-7);
    assert_eq!(fit.verdict, Verdict::Confirmed);
    let inside: Vec<bool> = fit.pairs.iter().map(|p| p.in_window).collect();
    assert_eq!(inside, [false, true, true, true]);
}

#[test]
fn the_scatter_of_pairwise_orders_bounds_the_half_width_from_below() {
    // 2.09 2.0 2.0 2.0 … within 0.1 only through the first pair; the last two agree to the digit.
    let fit = fit(
        &doubling(&[
            1.0,
            0.5,
            0.5_f64.powf(1.98),
            0.5_f64.powf(3.0),
            0.5_f64.powf(4.0),
        ]),
        None,
    );
    let fit = fit.unwrap();
    let scatter = fit
        .pairs
        .iter()
        .filter(|p| p.in_window)
        .map(|p| (p.order - fit.order.unwrap()).abs())
        .fold(0.0, f64::max);
    assert!(scatter > 0.01);
    assert!(fit.half_width.unwrap() >= scatter);
}

#[test]
fn a_hidden_last_drift_counts_by_the_one_before() {
    // 2.04, 2.00, 2.00: roundoff may hide the last drift, which a next power ½ away would make 0.04/√2.
    let drift = doubling(&[
        1.0,
        0.5_f64.powf(2.04),
        0.5_f64.powf(4.04),
        0.5_f64.powf(6.04),
    ]);
    let fit_of = fit(&drift, None).unwrap();
    let left = 0.04 / 2_f64.sqrt() / (2_f64.powf(0.25) - 1.0);
    let half_width = (fit_of.order.unwrap() - 2.0).abs() + left;
    assert!((fit_of.half_width.unwrap() - half_width).abs() < 1e-9);
    // At a ratio of 1.25 a drift of 0.01 has much more to go.
    let rows: Vec<(f64, f64, f64)> = [0.0, 2.0, 4.0, 6.01]
        .iter()
        .enumerate()
        .map(|(k, x)| {
            (
                0.8_f64.powi(i32::try_from(k).unwrap()),
                0.8_f64.powf(*x),
                0.0,
            )
        })
        .collect();
    let dense = fit(&samples(&rows), None).unwrap();
    let left = 0.01 / (1.25_f64.powf(0.25) - 1.0);
    let half_width = (dense.order.unwrap() - 2.01).abs() + left;
    assert!((dense.half_width.unwrap() - half_width).abs() < 1e-9);
}

#[test]
fn without_a_window_the_last_order_and_its_spread_are_reported() {
    // Pairwise 5, 1, 3, 2.8.
    let drifting = doubling(&[
        1.0,
        0.5_f64.powi(5),
        0.5_f64.powi(6),
        0.5_f64.powi(9),
        0.5_f64.powf(11.8),
    ]);
    let fit_of = fit(&drifting, Some(Expected::Order(2.0))).unwrap();
    assert_eq!(fit_of.window, None);
    assert!((fit_of.order.unwrap() - 2.8).abs() < 1e-12);
    assert!((fit_of.half_width.unwrap() - 1.8).abs() < 1e-12);
    // |e| = c·d^2.8 through the last level: log₂ c = −11.8 + 2.8·4.
    assert!((fit_of.log2_constant.unwrap() + 0.6).abs() < 1e-12);
    // Twice the last difference where that is more: pairwise 3, 2.
    let two = fit(&doubling(&[1.0, 0.125, 0.031_25]), None).unwrap();
    assert_eq!((two.order, two.half_width), (Some(2.0), Some(2.0)));
    // One pair alone.
    let one = fit(&doubling(&[1.0, 0.125]), None).unwrap();
    assert_eq!((one.order, one.half_width), (Some(3.0), Some(3.0)));
    let none = fit(&doubling(&[1.0]), None).unwrap();
    assert_eq!(
        (none.order, none.half_width, none.log2_constant),
        (None, None, None)
    );
    let empty = fit(&[], None).unwrap();
    assert_eq!((empty.order, empty.pairs.len()), (None, 0));
}

#[test]
fn a_fit_is_json_without_null_where_a_number_is_known() {
    let fit = fit(&doubling(&[1.0, 0.25, 0.0625, 0.015_625]), None).unwrap();
    let json: serde_json::Value = serde_json::to_value(&fit).unwrap();
    assert_eq!(json["verdict"], "Fitted");
    assert_eq!(json["window"]["first"], 0);
    assert_eq!(json["floor"], 0.0);
    assert!((json["order"].as_f64().unwrap() - 2.0).abs() < 1e-12);
    assert!(json["half_width"].is_f64() && json["log2_constant"].is_f64());
    assert_eq!(json["pairs"][0]["in_window"], true);
}

#[test]
fn bad_input_is_named() {
    let steps = |a: f64, b: f64| fit(&samples(&[(a, 1.0, 0.0), (b, 1.0, 0.0)]), None);
    assert_eq!(
        steps(0.0, 1.0),
        Err(FitError::Step {
            level: 0,
            step: 0.0
        })
    );
    assert_eq!(
        steps(1.0, -1.0),
        Err(FitError::Step {
            level: 1,
            step: -1.0
        })
    );
    assert_eq!(
        steps(f64::INFINITY, 1.0),
        Err(FitError::Step {
            level: 0,
            step: f64::INFINITY
        })
    );
    assert!(matches!(
        steps(1.0, f64::NAN),
        Err(FitError::Step { level: 1, .. })
    ));
    for finer in [1.0, 2.0] {
        let error = FitError::NotDecreasing {
            level: 1,
            step: finer,
            previous: 1.0,
        };
        assert_eq!(steps(1.0, finer), Err(error));
    }
    assert_eq!(
        fit(&samples(&[(1.0, 1.0, -0.5)]), None),
        Err(FitError::NegativeFloor {
            level: 0,
            floor: -0.5
        })
    );
    for order in [f64::INFINITY, f64::NEG_INFINITY] {
        let expected = Some(Expected::Order(order));
        assert_eq!(fit(&[], expected), Err(FitError::Expectation { order }));
    }
    assert!(fit(&[], Some(Expected::Order(f64::NAN))).is_err());
}

#[test]
fn steps_one_rounding_apart_give_numbers_all_the_same() {
    let mut step = 1.0_f64;
    let mut rows = Vec::new();
    for error in [5.0, 4.0, 3.0, 2.0, 1.0] {
        rows.push((step, error, 1e-3));
        step = step.next_down();
    }
    let fit = fit(&samples(&rows), Some(Expected::Order(2.0))).unwrap();
    assert!(orders(&fit).iter().all(|p| p.is_finite() && *p > 1e14));
    assert!(fit.order.unwrap().is_finite() && fit.half_width.unwrap().is_finite());
    assert!(!fit.verdict.passes(Some(Expected::Order(2.0))));
}

#[test]
fn orders_that_jitter_count_twice_their_last_steps() {
    // 2.05, 1.96, 2.03, 2.00: the larger of the last two is 0.07.
    let jitter = doubling(&[0.0, 2.05, 4.01, 6.04, 8.04].map(|x: f64| (-x).exp2()));
    let fit = fit(&jitter, None).unwrap();
    let half_width = (fit.order.unwrap() - 2.0).abs() + 2.0 * 0.07;
    assert!((fit.half_width.unwrap() - half_width).abs() < 1e-9);
}

#[test]
fn orders_that_turn_round_have_far_to_go() {
    // 2.000, 2.004, 2.005, 2.004: the drift passes through 0, and says little of what is left.
    let turn = doubling(&[0.0, 2.0, 4.004, 6.009, 8.013].map(|x: f64| (-x).exp2()));
    let fit = fit(&turn, None).unwrap();
    let left = 0.004 / 2_f64.sqrt() / (2_f64.powf(0.05) - 1.0);
    let half_width = (fit.order.unwrap() - 2.004).abs() + left;
    assert!(
        (fit.half_width.unwrap() - half_width).abs() < 1e-9,
        "{fit:?}"
    );
}

#[test]
fn the_rounding_of_logarithms_is_all_that_is_left_of_an_exact_power() {
    // |e| = 2⁻⁵⁰⁰⁰ d³ at ratios of 4: every logarithm is exact.
    let power: Vec<Sample> = (1..6_u32)
        .map(|k| Sample {
            n: None,
            step: 0.25_f64.powi(k.cast_signed()),
            error: Float::with_val(53, 1) >> (5000 + 6 * k),
            floor: Float::new(53),
        })
        .collect();
    let fit = fit(&power, None).unwrap();
    assert_eq!((fit.order, fit.log2_constant), (Some(3.0), Some(-5000.0)));
    // 8 ulps of the largest |log₂ e| + p·|log₂ d|, 5030 + 30, over log₂ 4.
    let rounding = 8.0 * f64::EPSILON * 5060.0 / 2.0;
    assert!((fit.half_width.unwrap() / rounding - 1.0).abs() < 1e-12);
}
