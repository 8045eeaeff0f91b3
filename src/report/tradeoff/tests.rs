//! What has no place on a logarithmic axis is named, and names are safe.

use super::words::{error, figure_file, states, time};
use super::{csv, latex, markdown, text};
use crate::real::FormatName;
use crate::real::counted::{Counts, Kind};
use crate::study::sweep::Header;
use crate::study::tradeoff::{Cost, Outcome, Point, Results, Timing, Unit};
use rug::Float;

fn point(n: u64, outcome: Outcome) -> Point {
    let timing = Timing {
        median: 100.0 * n as f64,
        spread: 3.0,
        repeats: 5,
    };
    Point {
        method: "front-to-back/front/subtraction".parse().unwrap(),
        n,
        outcome,
        counts: Counts::of(Kind::Transfer, n),
        modelled: Some(130.0 * n as f64),
        measured: Some(timing),
        only_usual: false,
    }
}

fn results(case: &str, outcomes: &[Outcome]) -> Results {
    let header = Header {
        volver: "0".into(),
        cases: vec![[case, "1", "lambda", "s", "s"].map(String::from)],
        methods: vec!["front-to-back/front/subtraction".into()],
        formats: vec!["f32".into()],
        levels: (1..=outcomes.len() as u64).collect(),
    };
    let points = (1..)
        .zip(outcomes)
        .map(|(n, outcome)| point(n, outcome.clone()));
    let unit = Unit {
        case: case.into(),
        format: FormatName::F32,
        bits: 24,
        radiance: Float::with_val(64, 2),
        points: points.collect(),
        calibration: None,
    };
    Results::new(header, Cost::Modelled, Some(false), vec![unit])
}

fn all_states() -> Vec<Outcome> {
    let reason = "n = 4 is odd".into();
    vec![
        Outcome::Error {
            error: Float::with_val(64, 1) >> 4_u32,
        },
        Outcome::NotFinite,
        Outcome::Exact,
        Outcome::Refused { reason },
        Outcome::Error {
            error: Float::with_val(64, 1) >> 4000_u32,
        },
    ]
}

#[test]
fn what_has_no_logarithm_is_named() {
    let results = results("a_b & <c>", &all_states());
    let case = &results.cases[0];
    assert_eq!(
        states(case),
        "5 runs: 2 with an error, 1 exact, 1 not finite, 1 refused"
    );
    assert_eq!(error(&case.units[0].points[2]), "exact");
    assert_eq!(error(&case.units[0].points[1]), "not-finite");
    assert_eq!(figure_file(&results, 0), "tradeoff-a-b-c.svg");
}

#[test]
fn every_form_has_the_cheapest_way_and_the_model() {
    let results = results("a_b", &all_states());
    let text = text(&results, 80, false);
    assert!(
        text.contains("  1e-2 … 1e-30  f32 ") && text.contains("by front-to-back/front/"),
        "{text}"
    );
    // Modelled 1.3 times as long as measured, everywhere it ran.
    assert!(
        text.contains("within 1.5 times of measured: f32 100 % of 5, all 100 % of 5."),
        "{text}"
    );
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let latex = latex(&results);
    assert!(
        latex
            .contains("a\\_b & $10^{-2}$ & front-to-back/front/subtraction & f32 & 3 & 3 & 390 ns"),
        "{latex}"
    );
    let markdown = markdown(&results);
    assert!(
        markdown.contains("![Error against cost](tradeoff-a-b.svg)"),
        "{markdown}"
    );
    let csv = csv(&results).unwrap();
    assert_eq!(csv.lines().count(), 6);
    assert!(csv.contains(",n = 4 is odd\n"), "{csv}");
}

#[test]
fn times_are_told_in_fitting_units() {
    assert_eq!(time(0.42), "0.4 ns");
    assert_eq!(time(99.6), "100 ns");
    assert_eq!(time(999.6), "1.0 µs");
    assert_eq!(time(12_345.0), "12 µs");
    assert_eq!(time(2.5e10), "25 s");
}
