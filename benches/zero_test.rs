//! How long the zero test takes to decide identities, true ones and false ones, reading them included.
#![allow(missing_docs, clippy::expect_used)]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use volver::symbolic::{Expr, ZeroTest, zero_test};

/// Left-hand side minus right-hand side, and whether that is 0.
const IDENTITIES: [(&str, &str, bool); 8] = [
    ("pythagoras", "sin(x)^2 + cos(x)^2 - 1", true),
    ("double angle", "sin(2*x) - 2*sin(x)*cos(x)", true),
    ("wrong double angle", "sin(2*x) - 2*sin(x)*sin(x)", false),
    ("fractions", "1/(1 + x) + x/(1 + x) - 1", true),
    ("root", "sqrt(x)*sqrt(x) - x", true),
    (
        "nested fractions",
        "1/(1 + 1/(1 + x)) - (1 + x)/(2 + x)",
        true,
    ),
    ("logarithm", "exp(x - 2*ln(y)) - exp(x)/y^2", true),
    ("wrong sign", "-exp(-x) - exp(-x)", false),
];

fn parse(text: &str) -> Expr {
    text.parse().expect("an expression")
}

/// The derivatives of ln(1 + x²) and √(1 + x) against what they should be.
fn derivatives() -> [(&'static str, Expr); 2] {
    [
        (
            "derivative of ln",
            parse("ln(1 + x^2)").differentiate("x") - parse("2*x/(1 + x^2)"),
        ),
        (
            "derivative of a root",
            parse("sqrt(1 + x)").differentiate("x") - parse("1/2/sqrt(1 + x)"),
        ),
    ]
}

/// I′ against I times its logarithmic derivative, with `three` = 3 if it is to be right.
fn long(three: i32) -> Expr {
    let radiance = parse("((l^3 + 3*l)^6*exp(-l)*sin(3*l)^6)/((1 + l)*(2 + cos(w*l)))");
    let logarithmic = parse(&format!(
        "6*(3*l^2 + {three})/(l^3 + 3*l) - 1 + 18*cos(3*l)/sin(3*l) - 1/(1 + l) \
         + w*sin(w*l)/(2 + cos(w*l))"
    ));
    radiance.differentiate("l") - radiance * logarithmic
}

fn decides(expr: &Expr, is_zero: bool) -> bool {
    match zero_test(expr, &[]) {
        ZeroTest::Proved => is_zero,
        ZeroTest::Refuted(_) => !is_zero,
        ZeroTest::Unknown => false,
    }
}

fn identities(c: &mut Criterion) {
    let mut group = c.benchmark_group("zero test");
    for (name, text, is_zero) in IDENTITIES {
        assert!(decides(&parse(text), is_zero), "{name}");
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| decides(&parse(black_box(text)), is_zero));
        });
    }
    for (name, difference) in derivatives() {
        assert!(decides(&difference, true), "{name}");
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| decides(black_box(&difference), true));
        });
    }
    for (name, difference, is_zero) in [("long", long(3), true), ("wrong long", long(4), false)] {
        assert!(decides(&difference, is_zero), "{name}");
        group.sample_size(10);
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| decides(black_box(&difference), is_zero));
        });
    }
    group.finish();
}

criterion_group!(benches, identities);
criterion_main!(benches);
