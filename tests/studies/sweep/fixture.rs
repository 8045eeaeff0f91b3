//! Studies made up for tests.

use rug::Float;
use volver::case::{SymbolicCase, catalogue, manufacture::manufacture};
use volver::method::{Exponential, Inner, Method, Nested, Outer, Scope};
use volver::quadrature::Rule;
use volver::real::FormatName;
use volver::study::sweep::{
    Errors, Header, LevelRecord, Results, Row, State, Sweep, Theory, Unit, between,
};

/// Discretization A·n^−P, arithmetic rounding B·u·n^Q, nothing else.
pub(crate) const A: f64 = 0.3;
pub(crate) const P: f64 = 2.0;
pub(crate) const B: f64 = 2.0;
pub(crate) const Q: f64 = 0.5;

/// n = 8 … 4096.
pub(crate) fn levels() -> Vec<u64> {
    (3..=12).map(|k| 1 << k).collect()
}

/// As a journal holds it: with twenty digits.
fn rounded(x: &Float) -> Float {
    let text = x.to_string_radix(10, Some(20));
    Float::with_val(80, Float::parse(&text).unwrap())
}

fn level(n: u64, bits: u32) -> LevelRecord {
    let x = n as f64;
    let number = |x: f64| rounded(&Float::with_val(80, x));
    let discretization = number(A * x.powf(-P));
    let arithmetic = number(B * (-f64::from(bits)).exp2() * x.powf(Q));
    LevelRecord {
        n,
        state: State::Split,
        total: Some(rounded(&Float::with_val(80, &discretization + &arithmetic))),
        floor: None,
        discretization: Some(discretization),
        truncation: Some(number(0.0)),
        input: Some(number(0.0)),
        arithmetic: Some(arithmetic),
        of_depth: None,
        resolution: Some(number(1e-60)),
        oracle_bits: Some(256),
    }
}

/// Of I = 1.
pub(crate) fn unit(format: &str, bits: u32) -> Unit {
    Unit {
        case: "made-up".into(),
        format: format.into(),
        bits,
        radiance: Float::with_val(80, 1),
        unproved: Vec::new(),
        rows: vec![Row {
            method: "a × b".into(),
            expected: Theory::Order(P),
            levels: levels().into_iter().map(|n| level(n, bits)).collect(),
            between: between(&levels())
                .into_iter()
                .map(|n| level(n, bits))
                .collect(),
        }],
    }
}

/// Binary32, and a sweep over 10 to 12 bits.
pub(crate) fn results() -> Results {
    let units: Vec<Unit> = [
        ("f32", 24),
        ("mpfr:10", 10),
        ("mpfr:11", 11),
        ("mpfr:12", 12),
    ]
    .map(|(name, bits)| unit(name, bits))
    .into();
    let header = Header {
        volver: "0".into(),
        cases: vec![["made-up", "1", "lambda", "1", "s"].map(String::from)],
        methods: vec!["a × b".into()],
        formats: units.iter().map(|unit| unit.format.clone()).collect(),
        levels: levels(),
        errors: Errors::Split,
    };
    let swept = [false, true, true, true];
    Results::new(header, Some(10..=12), units, &swept).unwrap()
}

pub(crate) fn case(name: &str) -> SymbolicCase {
    let description = catalogue::find(name).unwrap().unwrap();
    manufacture(&description).unwrap().remove(0).case
}

/// Two cases, two methods, two formats, four levels, of which Boole's rule does not take the first.
pub(crate) fn sweep() -> Sweep {
    let method = |inner, outer| {
        Method::Nested(Nested {
            inner: Inner::PerSegment(inner),
            outer: Outer(outer),
            exponential: Exponential::Exact,
            scope: Scope::Whole,
        })
    };
    Sweep {
        cases: ["sine-squared", "homogeneous"]
            .map(|name| (name.into(), case(name)))
            .into(),
        methods: vec![
            method(Rule::Trapezoid, Rule::Trapezoid),
            method(Rule::Simpson, Rule::Boole),
        ],
        formats: vec![FormatName::F32, FormatName::Mpfr(70)],
        levels: vec![2, 4, 8, 16],
        errors: Errors::Split,
    }
}
