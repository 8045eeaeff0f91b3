//! Errors as a whole: those of the split, at the evaluations that they take.

use super::fixture::{case, sweep};
use rug::Float;
use volver::case::Shared;
use volver::convergence::Verdict;
use volver::method::Method;
use volver::real::{Native, Real};
use volver::reference;
use volver::study::Silent;
use volver::study::sweep::{
    Errors, Estimate, Header, Journal, JournalError, Results, State, Sweep, Theory, Unit, run,
};

fn units(sweep: &Sweep, threads: usize) -> Vec<Unit> {
    ran(sweep, threads).0
}

/// The units, and how often a medium was evaluated.
fn ran(sweep: &Sweep, threads: usize) -> (Vec<Unit>, u64) {
    let directory = tempfile::tempdir().unwrap();
    let header = Header::new(sweep);
    let path = directory.path().join("j");
    let mut journal = Journal::begin(&path, &header).unwrap();
    let statistics = run(sweep, &mut journal, threads, &Silent).unwrap();
    if !sweep.errors.is_split() {
        assert_eq!(statistics.oracle_evaluations, 0);
    }
    let units = journal.finish(&header).unwrap();
    // What is read again is what was written.
    let read = Journal::resume(&path, &header).unwrap();
    assert_eq!(read.ordered(&header).len(), units.len());
    (units, statistics.evaluations)
}

fn total(sweep: Sweep) -> Sweep {
    Sweep {
        errors: Errors::Total,
        ..sweep
    }
}

fn methods(names: &[&str]) -> Vec<Method> {
    names.iter().map(|name| name.parse().unwrap()).collect()
}

/// As a journal holds it.
fn text(x: Option<&Float>) -> Option<String> {
    x.map(|x| x.to_string_radix(10, Some(20)))
}

#[test]
fn totals_are_those_of_the_split_to_the_last_digit() {
    let split = Sweep {
        cases: ["sine-squared", "homogeneous", "jump-off-node", "vacuum"]
            .map(|name| (name.into(), case(name)))
            .into(),
        methods: methods(&[
            "trapezoid/trapezoid",
            "simpson/boole",
            "midpoint/gauss-2/cubic",
            "simpson-pairs-parabola/simpson",
            "front-to-back/middle/expm1/neumaier",
            "front-to-back/front/subtraction/stop=1:16",
            "back-to-front/back/relative",
            "preintegrated/linear-by-2-midpoint/linear-by-2-midpoint",
            "layers/half-own",
        ]),
        formats: [
            "f16",
            "f32",
            "f64",
            "mpfr:9",
            "mpfr:300",
            "fp8-e4m3",
            "fixed:4.20",
        ]
        .map(|name| name.parse().unwrap())
        .into(),
        levels: vec![2, 4, 8, 20],
        errors: Errors::Split,
    };
    let parts = units(&split, 2);
    let whole = units(&total(split), 2);
    assert_eq!(parts.len(), whole.len());
    let (mut equal, mut refused) = (0, 0);
    for (a, b) in parts.iter().zip(&whole) {
        assert_eq!((&a.case, &a.format, a.bits), (&b.case, &b.format, b.bits));
        assert_eq!(text(Some(&a.radiance)), text(Some(&b.radiance)));
        for (a_row, b_row) in a.rows.iter().zip(&b.rows) {
            assert_eq!(
                (&a_row.method, a_row.expected),
                (&b_row.method, b_row.expected)
            );
            assert!(b_row.between.is_empty());
            for (x, y) in a_row.levels.iter().zip(&b_row.levels) {
                let what = format!("{} on {} in {} at {}", a_row.method, a.case, a.format, x.n);
                assert_eq!(text(x.total.as_ref()), text(y.total.as_ref()), "{what}");
                match (&x.state, &y.state) {
                    (State::Refused(a), State::Refused(b)) => {
                        assert_eq!(a, b, "{what}");
                        refused += 1;
                    }
                    (_, State::Total) => {
                        assert!(y.floor.as_ref().unwrap().is_finite(), "{what}");
                        assert!(y.split().is_none() && y.discretization.is_none());
                        equal += 1;
                    }
                    (State::NotFinite, State::NotFinite) => {}
                    other => panic!("{what}: {other:?}"),
                }
            }
        }
    }
    // 4 cases × 7 formats; Boole's rule takes no 2 segments.
    assert_eq!(refused, 28);
    assert!(equal > 900, "{equal}");
}

#[test]
fn units_do_not_depend_on_threads() {
    let sweep = total(sweep());
    let one = units(&sweep, 1);
    assert_eq!(one, units(&sweep, 2));
    assert_eq!(one, units(&sweep, 7));
}

#[test]
fn every_distinct_node_of_the_finest_level_is_evaluated_once() {
    let evaluations = |names: &[&str], levels: &[u64]| {
        let sweep = Sweep {
            cases: vec![("sine-squared".into(), case("sine-squared"))],
            methods: methods(names),
            formats: vec!["f64".parse().unwrap()],
            levels: levels.to_vec(),
            errors: Errors::Total,
        };
        ran(&sweep, 1).1
    };
    let ends = [
        "riemann-left/boole",
        "trapezoid/trapezoid",
        "front-to-back/back/expm1",
    ];
    assert_eq!(evaluations(&ends, &[8, 16, 32, 64]), 65);
    // Middles are boundaries of twice as many.
    let middles = [&ends[..], &["simpson/simpson", "midpoint/boole"]].concat();
    assert_eq!(evaluations(&middles, &[8, 16, 32, 64]), 129);
    // 24 and 16 have gcd 8 boundaries' parts in common.
    assert_eq!(evaluations(&ends, &[16, 24]), 17 + 25 - 9);
}

#[test]
fn a_long_ray_is_gone_along_without_keeping_it_and_to_the_same_bits() {
    const SHORT: u64 = 1 << 15;
    const LONG: u64 = 1 << 16;
    let names = [
        "trapezoid/trapezoid",
        "simpson/simpson",
        "midpoint/midpoint",
    ];
    let sweep = Sweep {
        cases: vec![("sine-squared".into(), case("sine-squared"))],
        methods: methods(&names),
        formats: vec!["f32".parse().unwrap()],
        levels: vec![1 << 10, LONG],
        errors: Errors::Total,
    };
    let (units, evaluations) = ran(&sweep, 1);
    let unit = &units[0];
    let case = &sweep.cases[0].1;
    let exact = reference::radiance(case, 128).unwrap().value;
    let nodes = Shared::new(case, Native::<f32>::new());
    for (method, row) in sweep.methods.iter().zip(&unit.rows) {
        let radiance = method.radiance(&nodes, LONG).unwrap().to_float();
        let error = Float::with_val(128, &radiance - &exact);
        assert_eq!(
            text(Some(&error)),
            text(row.levels[1].total.as_ref()),
            "{method}"
        );
    }
    // Boundaries, quarters and middles shared by 2¹⁰; then a pass for each method: boundaries; boundaries and middles;
    // middles and quarters.
    let shared = 4 * (1 << 10) + 1 - (1 << 10);
    let alone = (LONG + 1) + (2 * LONG + 1) + 2 * LONG;
    assert_eq!(evaluations, shared + alone);
    // One method alone is shared among levels as long as that is little.
    let alone = Sweep {
        methods: methods(&names[..1]),
        levels: vec![SHORT / 2, SHORT],
        ..sweep
    };
    assert_eq!(ran(&alone, 1).1, SHORT + 1);
}

#[test]
fn what_it_takes_is_foreseen() {
    const MIB: f64 = (1 << 20) as f64;
    let one = |method: &str, format: &str, n: u64| {
        let sweep = Sweep {
            cases: vec![("homogeneous".into(), case("homogeneous"))],
            methods: methods(&[method]),
            formats: vec![format.parse().unwrap()],
            levels: vec![n / 2, n],
            errors: Errors::Total,
        };
        let split = Sweep {
            errors: Errors::Split,
            ..sweep.clone()
        };
        (Estimate::new(&sweep, 1), Estimate::new(&split, 1))
    };
    // Whatever is gone along: no more than a unit shares.
    for n in [1 << 12, 1 << 22, 1 << 40] {
        let (whole, split) = one("simpson/simpson", "f64", n);
        assert!(whole.bytes <= 8.0 * MIB, "{n}: {}", whole.bytes);
        assert!(20.0 * whole.seconds(1) < split.seconds(1), "{n}");
    }
    // Samples from the far end are kept: three numbers of eight bytes a segment at least.
    let (kept, _) = one("back-to-front/middle/expm1", "f64", 1 << 22);
    assert!(kept.bytes >= 96.0 * MIB, "{}", kept.bytes);
    let (wide, _) = one("trapezoid/trapezoid", "mpfr:4096", 1 << 12);
    assert!(
        wide.bytes > MIB && wide.bytes < 129.0 * MIB,
        "{}",
        wide.bytes
    );
}

#[test]
fn journals_of_one_kind_are_not_gone_on_with_as_the_other() {
    let (split, whole) = (sweep(), total(sweep()));
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("j");
    let mut journal = Journal::begin(&path, &Header::new(&whole)).unwrap();
    for unit in units(&whole, 1) {
        journal.append(unit).unwrap();
    }
    let text = std::fs::read_to_string(&path).unwrap();
    let error = Journal::resume(&path, &Header::new(&split)).unwrap_err();
    assert!(
        error
            .to_string()
            .contains("its errors are total, not split (allowed: "),
        "{error}"
    );
    assert_eq!(std::fs::read_to_string(&path).unwrap(), text);
    // No part of an error is so much as named.
    for part in ["discretization", "arithmetic", "of_depth", "oracle_bits"] {
        assert!(text.lines().count() == 5, "{text}");
        let totals = text.matches("\"state\":\"total\"").count();
        assert!(totals > 20 && text.matches(part).count() < 8, "{part}");
    }
    // Nor is a unit of the one taken under the header of the other.
    let mut mixed = Journal::begin(&directory.path().join("k"), &Header::new(&whole)).unwrap();
    mixed.append(units(&split, 1).remove(0)).unwrap();
    drop(mixed);
    let error = Journal::resume(&directory.path().join("k"), &Header::new(&whole)).unwrap_err();
    assert!(
        matches!(&error, JournalError::Line { line: 2, .. }),
        "{error}"
    );
}

/// What rounding and a short range do is no contradiction of theory: terms that cancel, depths that are lost, opacities and
/// radiances near a format's smallest number, errors that swing until rounding hides them, sums that saturate.
#[test]
fn rounding_is_no_contradiction_and_a_wrong_order_is_one() {
    let names = [
        "emission-cubic",
        "thick-back",
        "faint",
        "spike-sech",
        "steep-ramp",
        "cloud",
    ];
    let sweep = Sweep {
        cases: names.map(|name| (name.into(), case(name))).into(),
        methods: methods(&[
            "trapezoid/trapezoid",
            "simpson/simpson",
            "gauss-2/boole",
            "front-to-back/middle/subtraction",
        ]),
        formats: ["f16", "bf16", "f32", "f64", "fp8-e4m3", "fixed:4.20"]
            .map(|name| name.parse().unwrap())
            .into(),
        levels: (3..=12).map(|k| 1 << k).collect(),
        errors: Errors::Total,
    };
    let all = units(&sweep, 2);
    let of = |units: Vec<Unit>| {
        let header = Header::new(&sweep);
        Results::new(header, None, units, &[false; 6]).unwrap()
    };
    let mut confirmed = 0;
    for line in &of(all.clone()).lines {
        let fit = &line.summary.total;
        let what = format!("{} on {} in {}", line.row.method, line.case, line.format);
        assert!(!line.contradicts_theory(), "{what}: {fit:?}");
        confirmed += usize::from(fit.verdict == Verdict::Confirmed);
    }
    assert!(confirmed > 10, "{confirmed}");
    // With another theory what was confirmed is contradicted.
    let mut wrong = all;
    let rows = wrong.iter_mut().flat_map(|unit| unit.rows.iter_mut());
    for row in rows {
        row.expected = Theory::Order(3.0);
    }
    let contradictions = of(wrong);
    let contradictions = contradictions
        .lines
        .iter()
        .filter(|line| line.contradicts_theory());
    assert!(contradictions.count() >= confirmed);
}
