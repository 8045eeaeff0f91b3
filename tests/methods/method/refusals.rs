//! What methods refuse, and how they say so.

use super::{
    BACKWARD, CLOSED, LINEAR, MIDDLE, QUADRATIC, nested, preintegrated, rules, sub_intervals,
    unattenuated,
};
use rug::Float;
use volver::case::{Fresh, HomogeneousSlab, SineSquared};
use volver::method::{Exponential, Filling, Inner, Method, MethodError, Scope};
use volver::quadrature::{Rule, RuleError, Sampling};
use volver::real::Mpfr;

fn refused(method: &Method, n: u64) -> MethodError {
    let nodes = Fresh::new(&SineSquared, Mpfr { bits: 64 });
    method.radiance(&nodes, n).unwrap_err()
}

#[test]
fn levels_that_do_not_suit_a_rule_are_refused() {
    let pairs = Inner::SimpsonPairs(Filling::Parabola);
    let exact = |inner, outer| nested(inner, outer, Exponential::Exact, Scope::Whole);
    let random = Inner::MonteCarlo {
        sampling: Sampling::Shared,
        seed: 1,
    };
    let segments = |rule: &str, n, multiple| MethodError::Segments {
        rule: rule.into(),
        n,
        multiple,
    };
    for (method, n, error) in [
        (
            rules(Rule::Trapezoid, Rule::Simpson),
            3,
            segments("simpson", 3, 2),
        ),
        (
            rules(Rule::GaussLegendre(3), Rule::Simpson),
            3,
            segments("simpson", 3, 2),
        ),
        (
            rules(Rule::Trapezoid, Rule::Trapezoid),
            0,
            segments("trapezoid", 0, 1),
        ),
        (
            rules(Rule::Simpson, Rule::Boole),
            6,
            segments("boole", 6, 4),
        ),
        (
            exact(pairs, Rule::Trapezoid),
            5,
            segments("simpson-pairs-parabola", 5, 2),
        ),
        (
            exact(pairs, Rule::Midpoint),
            3,
            segments("simpson-pairs-parabola", 3, 2),
        ),
        (
            exact(Inner::BooleFours, Rule::Trapezoid),
            6,
            segments("boole-fours", 6, 4),
        ),
    ] {
        assert_eq!(refused(&method, n), error, "{method}");
    }
    // Which of two rules that refuse 0 is named is no promise.
    let sub_intervals = sub_intervals(1, Rule::Simpson);
    for method in [
        rules(Rule::GaussLegendre(3), Rule::Midpoint),
        rules(Rule::RiemannLeft, Rule::Boole),
        exact(pairs, Rule::Midpoint),
        exact(random, Rule::Midpoint),
        preintegrated(LINEAR, MIDDLE, sub_intervals),
        preintegrated(QUADRATIC, BACKWARD, sub_intervals),
    ] {
        let refusal = refused(&method, 0).to_string();
        assert!(
            refusal.starts_with("n = 0 segments "),
            "{method}: {refusal}"
        );
    }
    assert_eq!(
        refused(&preintegrated(BACKWARD, LINEAR, sub_intervals), 1).to_string(),
        "n = 1 segments are too few for quadratic-backward (allowed: 2 or more)"
    );
    assert_eq!(
        refused(&rules(Rule::Simpson, Rule::Boole), 6).to_string(),
        "n = 6 segments do not suit boole (allowed: positive multiples of 4)"
    );
}

/// Asking first tells the same as running.
#[test]
fn a_level_is_refused_before_it_is_run_just_as_when_it_is() {
    let simpson = sub_intervals(1, Rule::Simpson);
    let random = Inner::MonteCarlo {
        sampling: Sampling::Stratified,
        seed: 1,
    };
    let exact = |inner, outer| nested(inner, outer, Exponential::Exact, Scope::Whole);
    let nodes = Fresh::new(&SineSquared, Mpfr { bits: 64 });
    for method in [
        rules(Rule::RiemannLeft, Rule::Trapezoid),
        rules(Rule::Boole, Rule::Simpson),
        rules(Rule::Trapezoid, Rule::Boole),
        rules(Rule::Simpson, Rule::GaussLegendre(2)),
        exact(Inner::SimpsonPairs(Filling::Parabola), Rule::Midpoint),
        exact(Inner::SimpsonPairs(Filling::Trapezoid), Rule::Boole),
        exact(random, Rule::Simpson),
        preintegrated(LINEAR, LINEAR, simpson),
        preintegrated(QUADRATIC, MIDDLE, simpson),
        preintegrated(BACKWARD, LINEAR, simpson),
        preintegrated(LINEAR, BACKWARD, simpson),
    ] {
        for n in 0..=8 {
            let run = method.radiance(&nodes, n).map(drop);
            assert_eq!(
                method.check_segments(n).is_ok(),
                run.is_ok(),
                "{method}, n = {n}"
            );
        }
    }
}

#[test]
fn what_a_case_cannot_give_is_refused() {
    assert_eq!(
        refused(&preintegrated(LINEAR, LINEAR, CLOSED), 4),
        MethodError::NoClosedForm
    );
    assert_eq!(refused(&unattenuated(LINEAR), 4), MethodError::NoClosedForm);
    let none = preintegrated(LINEAR, LINEAR, sub_intervals(0, Rule::Simpson));
    assert_eq!(refused(&none, 4), MethodError::NoSubIntervals);
    let points = RuleError::Points { points: "0".into() };
    for method in [
        rules(Rule::GaussLegendre(0), Rule::Simpson),
        rules(Rule::Simpson, Rule::GaussLegendre(0)),
        preintegrated(LINEAR, LINEAR, sub_intervals(1, Rule::GaussLegendre(0))),
    ] {
        assert_eq!(refused(&method, 4), MethodError::Rule(points.clone()));
    }
}

/// Depth 70000 in one segment; cut in two it is within reach.
#[test]
fn a_segment_too_thick_for_the_series_is_refused() {
    let slab = HomogeneousSlab {
        length: 1.into(),
        extinction: 70000.into(),
        emission: 1.into(),
    };
    let nodes = Fresh::new(&slab, Mpfr { bits: 64 });
    let method = preintegrated(LINEAR, LINEAR, CLOSED);
    let error = method.radiance(&nodes, 1).unwrap_err();
    let depth = "70000".to_string();
    assert_eq!(error, MethodError::ThickSegment { depth });
    let radiance = Float::from(method.radiance(&nodes, 2).unwrap());
    assert!((radiance - 1_u32).abs() < 1e-12);
}
