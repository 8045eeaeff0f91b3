//! Rules that methods state, against the methods' own loops.

use rug::{Float, Rational};
use std::sync::Arc;
use volver::case::catalogue;
use volver::case::manufacture::manufacture;
use volver::case::{Column, Fresh, Nodes, PolynomialTransfer, SymbolicCase, Transfer};
use volver::identify::{Rule, stated};
use volver::kernel::{Cut, Samples, Segments, Subject};
use volver::method::Method;
use volver::real::{Format, Mpfr, MpfrReal, Native, Real};

/// Methods that state a rule.
const STATED: [&str; 29] = [
    "front-to-back/front/subtraction",
    "front-to-back/middle/expm1",
    "front-to-back/back/relative/neumaier",
    "front-to-back/middle/expm1/depths/pairwise",
    "front-to-back/front/linear",
    "front-to-back/middle/linear/depths",
    "front-to-back/back/expm1/stop=1:3",
    "front-to-back/middle/linear/depths/stop=1:2",
    "back-to-front/middle/subtraction",
    "back-to-front/back/linear",
    "tree/front/relative",
    "riemann-left/riemann-left",
    "riemann-left/riemann-left/linear",
    "riemann-left/riemann-left/quadratic",
    "riemann-right/riemann-right",
    "riemann-right/riemann-right/linear",
    "riemann-right/riemann-right/quadratic",
    "riemann-right/riemann-left",
    "trapezoid/trapezoid",
    "trapezoid/trapezoid/exact-per-segment",
    "simpson/trapezoid",
    "midpoint/riemann-right",
    "trapezoid/midpoint",
    "layers/linear",
    "layers/mean",
    "layers/half-cells",
    "layers/middle",
    "layers/half-own",
    "layers/whole-own",
];

/// Methods whose nodes are not all at the ends and in the middle of one segment, whose T is no product, or whose
/// radiance is no sum of emissions.
const UNSTATED: [&str; 14] = [
    "simpson/simpson",
    "trapezoid/boole",
    "gauss-3/trapezoid",
    "trapezoid/gauss-2",
    "midpoint/midpoint",
    "simpson-pairs-parabola/trapezoid",
    "monte-carlo@1/trapezoid",
    "trapezoid/trapezoid/linear",
    "riemann-left/riemann-left/linear-whole",
    "riemann-left/riemann-left/cubic",
    "preintegrated/linear/linear",
    "layers/logarithmic",
    "layers/bezier-quadratic",
    "layers/bezier-cubic-monotone",
];

const CASES: [&str; 5] = ["thick", "cloud", "sine-squared", "emission-bump", "faint"];

const SEGMENTS: u64 = 8;

fn method(name: &str) -> Method {
    name.parse().unwrap()
}

fn rule(name: &str) -> Rule {
    stated(&method(name)).unwrap_or_else(|| panic!("{name} states no rule"))
}

fn case(name: &str) -> SymbolicCase {
    let description = catalogue::find(name).unwrap().unwrap();
    manufacture(&description).unwrap().remove(0).case
}

fn segments(name: &str) -> Segments {
    let subject = Subject::new(name, vec![(None, case(name))]).unwrap();
    subject.segments(Cut::Segments(SEGMENTS)).unwrap()
}

fn step(segments: &Segments) -> f64 {
    segments.edges.lambda[1]
}

#[test]
fn methods_are_the_rules_that_they_state() {
    let format = Native::<f64>::new();
    for case_name in CASES {
        let case = case(case_name);
        let ray = segments(case_name);
        for name in STATED {
            let by_rule = rule(name).answers(&ray, step(&ray), format)[0];
            let nodes = Fresh::new(&case, format);
            let by_method: f64 = method(name).radiance(&nodes, SEGMENTS).unwrap();
            let error = (by_rule - by_method).abs();
            // 1 − e^(−x) loses half a unit of 1 in every segment.
            let rounding = SEGMENTS as f64 * f64::EPSILON;
            assert!(
                error <= 1e-13 * by_method.abs() + rounding,
                "{name} on {case_name}: {by_rule} is not {by_method}"
            );
        }
    }
}

/// What a kernel is given, as nodes.
#[derive(Debug)]
struct Given {
    segments: Segments,
    length: Rational,
    format: Mpfr,
}

impl Given {
    fn column(&self, of: &Samples) -> Arc<Column<MpfrReal>> {
        let numbers = |values: &[f64]| values.iter().map(|x| self.format.binary64(*x)).collect();
        Arc::new(Column {
            field: numbers(&of.lambda),
            emission: numbers(&of.emission[0]),
            extinction: numbers(&of.extinction),
        })
    }
}

impl Nodes for Given {
    type Format = Mpfr;

    fn format(&self) -> Mpfr {
        self.format
    }

    fn length(&self) -> &Rational {
        &self.length
    }

    fn boundaries(&self, n: u64) -> Arc<Column<MpfrReal>> {
        assert_eq!(n, SEGMENTS);
        self.column(&self.segments.edges)
    }

    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<MpfrReal>> {
        let column = self.boundaries(n);
        (0..column.field.len()).map(move |i| Transfer {
            extinction: column.extinction[i].clone(),
            emission: column.emission[i].clone(),
        })
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<MpfrReal>> {
        assert_eq!((n, offset), (SEGMENTS, &Rational::from((1, 2))));
        self.column(&self.segments.middles)
    }

    fn beyond(&self, _: u64) -> MpfrReal {
        unreachable!("no method of these follows the field")
    }

    fn extinction_at(&self, _: &MpfrReal) -> MpfrReal {
        unreachable!("no method of these looks elsewhere")
    }

    fn transfer(&self, _: &MpfrReal) -> Transfer<MpfrReal> {
        unreachable!("no method of these interpolates the field")
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        None
    }
}

/// On the very same values both are one formula.
#[test]
fn in_many_bits_methods_are_the_rules_that_they_state() {
    let format = Mpfr { bits: 400 };
    for case_name in CASES {
        let mut segments = segments(case_name);
        // Steps that are the same in binary64 and as rationals.
        segments.edges.lambda = (0..=SEGMENTS).map(|i| i as f64 / 8.0).collect();
        let given = Given {
            segments,
            length: Rational::from(1),
            format,
        };
        for name in STATED {
            let by_rule = rule(name).answers(&given.segments, 0.125, format).remove(0);
            let by_method = method(name).radiance(&given, SEGMENTS).unwrap().to_float();
            let error = Float::with_val(400, by_rule.to_float() - &by_method).abs();
            assert!(
                error <= by_method.clone().abs() * 1e-60,
                "{name} on {case_name}: off by {error}"
            );
        }
    }
}

#[test]
fn methods_with_other_nodes_state_no_rule() {
    for name in UNSTATED {
        assert_eq!(stated(&method(name)), None, "{name}");
    }
}

/// 1.1 − 0.001 is no binary64: at 400 bits a length is the difference itself.
#[test]
fn lengths_are_differences_in_the_format() {
    let samples = |lambda: Vec<f64>| Samples {
        extinction: vec![0.7; lambda.len()],
        emission: vec![vec![1.0; lambda.len()]],
        lambda,
    };
    let ray = Segments {
        edges: samples(vec![0.0, 1e-3, 1.1]),
        middles: samples(vec![5e-4, 0.55]),
    };
    let exact = |x: f64| Float::with_val(400, x);
    // Of an even medium 1 − e^(−τD), in however many segments.
    let depth = exact(0.7) * exact(1.1);
    let want = -Float::exp_m1(-depth);
    let format = Mpfr { bits: 400 };
    let got = Rule::default().answers(&ray, 1.1, format)[0].to_float();
    let off = (got - want).abs().to_f64();
    assert!(off < 1e-110, "{off:e}");
}
