//! Each verdict from a set of errors whose behaviour is known by construction.

mod limits;

use rug::Float;
use rug::ops::Pow;
use volver::convergence::{Fit, Note, Sample, Verdict, fit};
use volver::method::Expected;

const DOUBLING: [u64; 8] = [8, 16, 32, 64, 128, 256, 512, 1024];

fn samples(levels: &[u64], floor: f64, error: impl Fn(f64) -> f64) -> Vec<Sample> {
    levels
        .iter()
        .map(|n| Sample {
            n: Some(*n),
            step: 1.0 / *n as f64,
            error: Float::with_val(53, error(1.0 / *n as f64)),
            floor: Float::with_val(53, floor),
        })
        .collect()
}

fn of(errors: &[f64], floor: f64) -> Vec<Sample> {
    errors
        .iter()
        .zip(DOUBLING)
        .map(|(e, n)| samples(&[n], floor, |_| *e).remove(0))
        .collect()
}

#[allow(clippy::unnecessary_wraps)] // What is expected is optional.
fn order(p: f64) -> Option<Expected> {
    Some(Expected::Order(p))
}

const BLIND: Option<Expected> = Some(Expected::Blind {
    general: 1.0,
    here: 2.0,
});

fn judged(samples: &[Sample], expected: Option<Expected>) -> Verdict {
    fit(samples, expected).unwrap().verdict
}

fn second_order() -> Vec<Sample> {
    samples(&DOUBLING, 1e-16, |d| -0.7 * d * d * (1.0 + 0.5 * d))
}

#[test]
fn an_order_within_a_narrow_interval_is_confirmed() {
    let fit = fit(&second_order(), order(2.0)).unwrap();
    assert_eq!(fit.verdict, Verdict::Confirmed);
    assert!((fit.order.unwrap() - 2.0).abs() < 0.01);
    assert!(fit.half_width.unwrap() < 0.03);
    assert!(fit.notes.is_empty());
    // |e| = 0.7 d² to leading order.
    assert!((fit.log2_constant.unwrap() - 0.7_f64.log2()).abs() < 0.05);
}

#[test]
fn orders_beside_the_interval_are_too_low_or_too_high() {
    assert_eq!(judged(&second_order(), order(2.5)), Verdict::TooLow);
    assert_eq!(judged(&second_order(), order(1.5)), Verdict::TooHigh);
    assert_eq!(
        judged(&second_order(), Some(Expected::Exact)),
        Verdict::TooLow
    );
    assert_eq!(judged(&second_order(), None), Verdict::Fitted);
}

#[test]
fn an_exact_power_is_confirmed_in_spite_of_rounded_logarithms() {
    for p in [1.0, 2.0, 3.0, 4.0, 0.5] {
        for levels in [
            &DOUBLING[..],
            &[9, 27, 81, 243, 729],
            &[10, 17, 23, 41, 97, 100],
        ] {
            let samples = samples(levels, 0.0, |d| 1.7 * d.powf(p));
            let fit = fit(&samples, order(p)).unwrap();
            assert_eq!(fit.verdict, Verdict::Confirmed, "{p} {levels:?} {fit:?}");
            assert!(fit.half_width.unwrap() < 1e-11);
        }
    }
}

#[test]
fn errors_far_below_binary64_are_fitted_all_the_same() {
    let samples: Vec<Sample> = DOUBLING
        .into_iter()
        .map(|n| Sample {
            n: Some(n),
            step: 1.0 / n as f64,
            error: Float::with_val(100, 10).pow(-2000) / n.pow(3),
            floor: Float::with_val(100, 10).pow(-2100),
        })
        .collect();
    let fit = fit(&samples, order(3.0)).unwrap();
    assert_eq!(fit.verdict, Verdict::Confirmed);
    assert!((fit.order.unwrap() - 3.0).abs() < 1e-9);
    assert!((fit.log2_constant.unwrap() + 2000.0 * 10_f64.log2()).abs() < 1e-6);
}

#[test]
fn a_window_that_never_comes_is_pre_asymptotic() {
    // From d⁴ to d²: pairwise orders fall from 3.9 to 3 and have not settled.
    let transition = samples(&DOUBLING, 1e-16, |d| d.powi(4) + 1e-6 * d * d);
    assert_eq!(judged(&transition, order(2.0)), Verdict::PreAsymptotic);
    assert_eq!(judged(&transition, order(4.0)), Verdict::PreAsymptotic);
    assert_eq!(judged(&transition, None), Verdict::PreAsymptotic);
    assert_eq!(judged(&transition, BLIND), Verdict::Blind);
}

#[test]
fn a_ladder_that_reaches_the_floor_too_early_is_floor_limited() {
    let early = samples(&DOUBLING, 1e-4, |d| d * d);
    let fit = fit(&early, order(2.0)).unwrap();
    // 30 floors are 3e-3; d² falls below that at n = 32.
    assert_eq!(fit.cut.as_ref().map(|c| c.level), Some(2));
    assert_eq!(fit.verdict, Verdict::FloorLimited);
    assert_eq!(judged(&early, BLIND), Verdict::Blind);
}

#[test]
fn a_floor_just_below_the_cut_widens_the_interval_too_far() {
    // |e| at the two finest levels is 40 and 160 floors: (1/40 + 1/160) / ln 1.25 = 0.14; at a
    // ratio of 1.1 it is 0.33.
    let narrow = [100, 125, 156, 195];
    let dense = [1000, 1100, 1210, 1331];
    let floor_of = |n: u64| 1.0 / (n * n) as f64 / 40.0;
    let wide = samples(&dense, floor_of(1331), |d| d * d);
    let fit = fit(&wide, order(2.0)).unwrap();
    assert!(fit.window.is_some() && fit.cut.is_none());
    assert!(fit.half_width.unwrap() > 0.25);
    assert_eq!(fit.verdict, Verdict::FloorLimited);
    let right = samples(&narrow, floor_of(195), |d| d * d);
    assert_eq!(judged(&right, order(2.0)), Verdict::Confirmed);
}

#[test]
fn nothing_above_the_floor_is_exact() {
    // Small errors may hide an order; zeros are exact whatever was expected.
    for (errors, with_order) in [
        ([0.0; 5], Verdict::Exact),
        ([1e-16, -3e-15, 2e-15, 0.0, 3e-15], Verdict::FloorLimited),
    ] {
        let exact = of(&errors, 1e-16);
        assert_eq!(judged(&exact, Some(Expected::Exact)), Verdict::Exact);
        assert_eq!(judged(&exact, order(2.0)), with_order);
        assert_eq!(judged(&exact, None), with_order);
        assert_eq!(judged(&exact, BLIND), Verdict::Blind);
    }
    let zeros = of(&[0.0; 5], 0.0);
    assert_eq!(judged(&zeros, Some(Expected::Exact)), Verdict::Exact);
    // One floor and a bit more than 30 of them.
    let not_quite = of(&[1e-16, 3.1e-15, 1e-16, 1e-16, 1e-16], 1e-16);
    assert_ne!(judged(&not_quite, Some(Expected::Exact)), Verdict::Exact);
}

#[test]
fn a_zero_ends_the_ladder_even_without_a_floor() {
    let zero = of(&[1e-2, 1e-3, 1e-4, 0.0, 0.0], 0.0);
    let fit = fit(&zero, order(2.0)).unwrap();
    assert_eq!(fit.verdict, Verdict::FloorLimited);
    assert_eq!(fit.cut.map(|c| c.level), Some(3));
    assert_eq!(fit.pairs.len(), 2);
}

#[test]
fn an_error_that_stays_is_stalled() {
    // VTK at 15 bits: the error falls and then stays near 3e-3, far above its floor.
    let plateau = samples(&DOUBLING, 1e-7, |d| 3e-3 + d.powi(3));
    assert_eq!(judged(&plateau, order(2.0)), Verdict::Stalled);
    assert_eq!(judged(&plateau, order(0.0)), Verdict::Stalled);
    assert_eq!(judged(&plateau, BLIND), Verdict::Stalled);
    // Without a window: pairwise 2, 0.09, −0.05, 0.06.
    let uneven = of(
        &[
            1.0,
            0.25,
            0.25 * 2_f64.powf(-0.09),
            0.25 * 2_f64.powf(-0.04),
            0.25 * 2_f64.powf(-0.1),
        ],
        1e-7,
    );
    let fit = fit(&uneven, order(2.0)).unwrap();
    assert_eq!((fit.verdict, fit.window), (Verdict::Stalled, None));
}

#[test]
fn growth_is_a_verdict() {
    // Order −1 throughout, and after a good start.
    let opacity = samples(&DOUBLING, 1e-7, |d| 1e-4 / d);
    assert_eq!(judged(&opacity, order(1.0)), Verdict::Diverged);
    assert_eq!(judged(&opacity, BLIND), Verdict::Diverged);
    let late = samples(&DOUBLING, 0.0, |d| d * d + 1e-6 / d);
    assert_eq!(judged(&late, order(2.0)), Verdict::Diverged);
    // No window: pairwise 2, −0.3, −0.8, −0.5.
    let uneven = of(&[4.0, 1.0, 1.23, 2.14, 3.03], 1e-7);
    let fit = fit(&uneven, order(2.0)).unwrap();
    assert_eq!((fit.verdict, fit.window), (Verdict::Diverged, None));
    // Taking |order| would call this order 1.
    assert!(fit.order.unwrap() < -0.4);
}

#[test]
fn growth_beyond_an_understated_floor_is_growth_still() {
    // Confirmed up to the cut, if that were the end: d² meets 30 floors at n = 128.
    let understated = samples(&DOUBLING, 3e-6, |d| d * d);
    let mut cut = understated.clone();
    cut.truncate(5);
    assert_eq!(judged(&cut, order(2.0)), Verdict::Confirmed);
    for (level, error) in [(5, 1e-4), (6, 2e-4), (7, 4e-4)] {
        cut.push(Sample {
            error: Float::with_val(53, error),
            ..understated[level].clone()
        });
    }
    let grown = fit(&cut, order(2.0)).unwrap();
    assert_eq!(grown.verdict, Verdict::Diverged);
    assert!(grown.window.is_some());
    assert_eq!(
        grown.notes,
        [Note::RisesBeyondCut {
            level: 5,
            step: 1.0 / 256.0
        }]
    );
    // Above the floor once and back: neither growth nor a confirmation.
    cut[7].error = Float::with_val(53, 1e-6);
    assert_eq!(judged(&cut, order(2.0)), Verdict::PreAsymptotic);
    assert_eq!(judged(&cut, BLIND), Verdict::Blind);
    // A plateau beyond an exact zero is no growth, though any number is more than 0.
    let plateau = of(&[1.0, 0.25, 0.0625, 0.0, 0.1, 0.1, 0.1], 0.0);
    assert_eq!(judged(&plateau, order(2.0)), Verdict::PreAsymptotic);
    let growth = of(&[1.0, 0.25, 0.0625, 0.0, 0.1, 0.2, 0.4], 0.0);
    assert_eq!(judged(&growth, order(2.0)), Verdict::Diverged);
}

#[test]
fn a_sign_change_inside_the_window_is_oscillation() {
    let sign = |n: u64| {
        if n.trailing_zeros().is_multiple_of(2) {
            1.0
        } else {
            -1.0
        }
    };
    let alternating: Vec<Sample> = DOUBLING
        .into_iter()
        .map(|n| samples(&[n], 1e-16, |d| sign(n) * d * d).remove(0))
        .collect();
    let fitted = fit(&alternating, order(2.0)).unwrap();
    assert_eq!(fitted.verdict, Verdict::Oscillatory);
    assert_eq!(fitted.notes, []);
    assert_eq!(judged(&alternating, BLIND), Verdict::Blind);
    // No window: pairwise 3, 1, 3, 1 with changing signs; with one late change it is not yet oscillation.
    let uneven = of(&[1.0, 0.125, -0.0625, 0.0078, -0.0039], 1e-16);
    assert_eq!(judged(&uneven, order(2.0)), Verdict::Oscillatory);
    let once = of(&[1.0, 0.125, 0.0625, 0.0078, -0.0039], 1e-16);
    assert_eq!(judged(&once, order(2.0)), Verdict::PreAsymptotic);
    // Two changes, but before the last four levels.
    for early in [
        &[1.0, -0.125, 0.0625, 0.0078, 0.00195, 0.0005][..],
        &[1.0, 0.125, 0.0625, -0.0078, 0.0039, 0.0013, 0.0003, 0.00009],
    ] {
        let early = of(early, 1e-16);
        assert_eq!(judged(&early, order(2.0)), Verdict::PreAsymptotic);
    }
}

#[test]
fn growing_oscillation_is_growth_and_an_oscillating_plateau_is_oscillation() {
    let alternate = |base: f64| -> Vec<Sample> {
        let errors: Vec<f64> = (0..6).map(|k| 0.01 * base.powi(k)).collect();
        of(&errors, 1e-16)
    };
    assert_eq!(judged(&alternate(-2.0), order(1.0)), Verdict::Diverged);
    assert_eq!(judged(&alternate(-1.0), order(1.0)), Verdict::Oscillatory);
}

#[test]
fn a_sign_change_before_the_window_is_a_note() {
    // d²(1 − 40 d) changes sign at n = 40.
    let levels: Vec<u64> = (3..15).map(|k| 1 << k).collect();
    let fit = fit(
        &samples(&levels, 1e-16, |d| d * d * (1.0 - 40.0 * d)),
        order(2.0),
    )
    .unwrap();
    assert_eq!(fit.verdict, Verdict::Confirmed);
    let change = Note::SignChange {
        level: 2,
        step: 1.0 / 32.0,
    };
    // Both powers are as large where they cancel.
    let [first, Note::GivesWay { from, to, step }] = &fit.notes[..] else {
        panic!("{:?}", fit.notes);
    };
    assert_eq!((first, *from, *to), (&change, 3.0, 2.0));
    assert!((step * 40.0 - 1.0).abs() < 1e-9, "{step}");
}

#[test]
fn three_levels_are_too_few() {
    let mut few = second_order();
    few.truncate(3);
    for expected in [order(2.0), BLIND, None] {
        assert_eq!(judged(&few, expected), Verdict::TooFewLevels);
    }
    assert_eq!(
        judged(&of(&[0.0; 3], 0.0), Some(Expected::Exact)),
        Verdict::TooFewLevels
    );
    assert_eq!(judged(&[], order(2.0)), Verdict::TooFewLevels);
}

#[test]
fn one_value_that_is_not_finite_decides() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for level in [0, 3, 7] {
            let mut errors = second_order();
            errors[level].error = Float::with_val(53, bad);
            assert_eq!(judged(&errors, order(2.0)), Verdict::NotFinite);
            assert_eq!(judged(&errors, BLIND), Verdict::NotFinite);
            let mut floors = second_order();
            floors[level].floor = Float::with_val(53, bad.abs());
            assert_eq!(judged(&floors, order(2.0)), Verdict::NotFinite);
        }
    }
    assert_eq!(judged(&of(&[f64::NAN], 0.0), None), Verdict::NotFinite);
}

#[test]
fn blind_cases_neither_pass_nor_fail() {
    let fit: Fit = fit(&second_order(), BLIND).unwrap();
    assert_eq!(fit.verdict, Verdict::Blind);
    assert!((fit.order.unwrap() - 2.0).abs() < 0.01);
    assert!(!fit.verdict.passes(BLIND));
}

#[test]
fn only_confirmed_and_expected_exactness_pass() {
    let all = [
        Verdict::Confirmed,
        Verdict::TooLow,
        Verdict::TooHigh,
        Verdict::PreAsymptotic,
        Verdict::FloorLimited,
        Verdict::Exact,
        Verdict::Stalled,
        Verdict::Oscillatory,
        Verdict::Diverged,
        Verdict::TooFewLevels,
        Verdict::NotFinite,
        Verdict::Blind,
        Verdict::Fitted,
    ];
    let passing =
        |expected| -> Vec<Verdict> { all.into_iter().filter(|v| v.passes(expected)).collect() };
    assert_eq!(passing(order(2.0)), [Verdict::Confirmed]);
    assert_eq!(passing(None), [Verdict::Confirmed]);
    assert_eq!(passing(BLIND), [Verdict::Confirmed]);
    assert_eq!(
        passing(Some(Expected::Exact)),
        [Verdict::Confirmed, Verdict::Exact]
    );
    for verdict in all {
        let json = serde_json::to_string(&verdict).unwrap();
        assert_eq!(json, format!("\"{verdict}\""));
    }
}

#[test]
fn a_missing_floor_is_remarked_where_it_may_matter() {
    let stalled = samples(&DOUBLING, 0.0, |_| 1e-3);
    assert_eq!(fit(&stalled, None).unwrap().notes, [Note::FloorUnknown]);
    let known = samples(&DOUBLING, 1e-9, |_| 1e-3);
    assert_eq!(fit(&known, None).unwrap().notes, []);
    let fine = samples(&DOUBLING, 0.0, |d| d * d);
    assert_eq!(fit(&fine, None).unwrap().notes, []);
}
