//! What is made of the units of a study, against closed forms.

use super::fixture::results;
use super::fixture::{A, B, P, Q, unit};
use rug::Float;
use volver::convergence::Verdict;
use volver::study::sweep::{Errors, LevelRecord, State, Theory, Unit};
use volver::study::sweep::{Results, TOLERANCES, summarize};

/// The least of √(D² + R²) for D = A n^−P and R = B u n^Q, where P D² = Q R².
fn least(bits: f64) -> (f64, f64) {
    let u = (-bits).exp2();
    let n = ((P / Q).sqrt() * A / (B * u)).powf(1.0 / (P + Q));
    (n, (A * n.powf(-P)).hypot(B * u * n.powf(Q)))
}

#[test]
fn powers_give_orders_laws_crossing_and_least_error_in_closed_form() {
    for bits in [24_u32, 53, 100] {
        let unit = unit("f", bits);
        let summary = summarize(&unit, &unit.rows[0], 1.0, Errors::Split).unwrap();
        let summary = summary.split.unwrap();
        let found = &summary.discretization;
        assert_eq!(found.verdict, Verdict::Confirmed);
        assert!((found.order.unwrap() - P).abs() < 1e-9);
        let law = summary.laws.arithmetic.unwrap();
        assert!((law.exponent - Q).abs() < 1e-9 && law.half_width < 1e-6);
        assert!((law.log2_constant - B.log2()).abs() < 1e-6);
        assert_eq!(summary.laws.input, None);
        assert_eq!(summary.laws.of_depth, None);
        // A n^−P = B u n^Q; n is looked for in steps of 1/32 octave.
        let crossing = (A / B * f64::from(bits).exp2()).powf(1.0 / (P + Q));
        let ratio = (summary.crossing.unwrap() / crossing).log2();
        assert!(ratio.abs() <= 1.0 / 32.0, "{bits} bits: {ratio}");
        let best = summary.best.unwrap();
        let (n, error) = least(f64::from(bits));
        assert!((best.log2_n - n.log2()).abs() <= 1.0 / 32.0);
        assert!((best.log2_error - error.log2()).abs() < 1e-3);
        for (needed, tolerance) in summary.bits_needed.iter().zip(TOLERANCES) {
            let fewest = (1..200_u32).find(|bits| least(f64::from(*bits)).1 <= tolerance);
            assert_eq!((needed.tolerance, needed.bits), (tolerance, fewest));
        }
    }
}

#[test]
fn the_total_is_limited_by_the_floor_that_rounding_is() {
    let unit = unit("f", 16);
    let summary = summarize(&unit, &unit.rows[0], 1.0, Errors::Split).unwrap();
    assert_eq!(summary.total.verdict, Verdict::FloorLimited);
    assert_eq!(summary.total.cut.unwrap().level, 1);
}

fn refused(n: u64) -> LevelRecord {
    LevelRecord {
        n,
        state: State::Refused("no".into()),
        total: None,
        floor: None,
        discretization: None,
        truncation: None,
        input: None,
        arithmetic: None,
        of_depth: None,
        resolution: None,
        oracle_bits: None,
    }
}

#[test]
fn levels_without_errors_are_left_out() {
    let mut unit: Unit = unit("f", 24);
    unit.rows[0].levels[0] = refused(8);
    let summary = summarize(&unit, &unit.rows[0], 1.0, Errors::Split).unwrap();
    let discretization = summary.split.unwrap().discretization;
    assert_eq!(discretization.verdict, Verdict::Confirmed);
    assert_eq!(discretization.pairs.len(), 8);
    for level in &mut unit.rows[0].levels {
        *level = refused(level.n);
    }
    unit.rows[0].between.clear();
    let nothing = summarize(&unit, &unit.rows[0], 1.0, Errors::Split).unwrap();
    let nothing = nothing.split.unwrap();
    assert_eq!(nothing.discretization.verdict, Verdict::TooFewLevels);
    assert_eq!((nothing.crossing, nothing.best), (None, None));
    assert!(
        nothing
            .bits_needed
            .iter()
            .all(|needed| needed.bits.is_none())
    );
}

#[test]
fn a_level_that_is_not_finite_spoils_the_total_alone() {
    let mut unit: Unit = unit("f", 24);
    let level = &mut unit.rows[0].levels[9];
    *level = LevelRecord {
        state: State::NotFinite,
        total: Some(Float::with_val(80, rug::float::Special::Nan)),
        ..refused(level.n)
    };
    let summary = summarize(&unit, &unit.rows[0], 1.0, Errors::Split).unwrap();
    assert_eq!(summary.total.verdict, Verdict::NotFinite);
    let discretization = summary.split.unwrap().discretization;
    assert_eq!(discretization.verdict, Verdict::Confirmed);
}

#[test]
fn a_wrong_theory_is_contradicted_and_a_lack_of_levels_is_not() {
    let contradicts = |expected: Theory| {
        let mut unit = unit("f32", 24);
        unit.rows[0].expected = expected;
        let header = results().header;
        let results = Results::new(header, None, vec![unit], &[false]).unwrap();
        results.lines[0].contradicts_theory()
    };
    assert!(contradicts(Theory::Order(3.0)));
    assert!(contradicts(Theory::Order(1.0)));
    assert!(contradicts(Theory::Exact));
    assert!(!contradicts(Theory::Order(2.0)));
    assert!(!contradicts(Theory::Blind(3.0, 2.0)));
    assert!(!contradicts(Theory::Unknown));
}

#[test]
fn digits_are_relative_to_the_radiance_and_no_more_than_the_format_has() {
    let results = results();
    let line = &results.lines[0];
    let level = |total: f64| LevelRecord {
        total: Some(Float::with_val(80, total)),
        ..refused(8)
    };
    assert!((line.digits(&level(-1e-3)).unwrap() - 3.0).abs() < 1e-12);
    assert_eq!(line.digits(&level(5.0)), Some(0.0));
    assert!((line.digits(&level(0.0)).unwrap() - 24.0 * 2_f64.log10()).abs() < 1e-12);
    assert_eq!(line.digits(&level(f64::NAN)), None);
    assert_eq!(line.digits(&refused(8)), None);
}

#[test]
fn maps_have_the_swept_formats_and_groups_the_others() {
    let results = results();
    let formats = |lines: Vec<&volver::study::sweep::Line>| -> Vec<String> {
        lines.iter().map(|line| line.format.clone()).collect()
    };
    let groups: Vec<_> = results
        .groups()
        .map(|(case, method, lines)| (case, method, formats(lines)))
        .collect();
    assert_eq!(groups, [("made-up", "a × b", vec!["f32".to_string()])]);
    let maps: Vec<_> = results.maps().map(|(_, _, lines)| formats(lines)).collect();
    assert_eq!(maps, [["mpfr:10", "mpfr:11", "mpfr:12"]]);
}
