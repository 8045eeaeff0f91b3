//! The generic nested trapezoid in binary64 beside the loop one would write by hand.
//!
//! Both give the same bits, which is asserted before anything is timed.
#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use volver::case::{Fresh, SineSquared};
use volver::method::{Exponential, Inner, Nested, Outer, Scope};
use volver::quadrature::Rule;
use volver::real::Native;

const TRAPEZOID: Nested = Nested {
    inner: Inner::PerSegment(Rule::Trapezoid),
    outer: Outer(Rule::Trapezoid),
    exponential: Exponential::Exact,
    scope: Scope::Whole,
};

fn generic(n: u64) -> f64 {
    let nodes = Fresh::new(&SineSquared, Native::<f64>::new());
    TRAPEZOID.radiance(&nodes, n).unwrap()
}

fn by_hand(n: u64) -> f64 {
    let step = 1.0 / n as f64;
    let mut depth = 0.0;
    let mut previous = 0.0;
    let mut radiance = 0.0;
    for i in 0..=n {
        let s = i as f64 / n as f64;
        let (sin, cos) = (s * s).sin_cos();
        let extinction = cos * s;
        if i > 0 {
            depth += (previous * 0.5 + extinction * 0.5) * step;
        }
        previous = extinction;
        let weight = if i == 0 || i == n { 0.5 } else { 1.0 };
        radiance += sin * extinction * (-depth).exp() * weight;
    }
    radiance * step
}

fn nested_trapezoid(c: &mut Criterion) {
    let mut group = c.benchmark_group("nested trapezoid, binary64");
    for n in [256, 4096, 65536] {
        assert_eq!(generic(n).to_bits(), by_hand(n).to_bits());
        group.bench_with_input(BenchmarkId::new("by hand", n), &n, |b, &n| {
            b.iter(|| by_hand(black_box(n)));
        });
        group.bench_with_input(BenchmarkId::new("generic", n), &n, |b, &n| {
            b.iter(|| generic(black_box(n)));
        });
    }
    group.finish();
}

criterion_group!(benches, nested_trapezoid);
criterion_main!(benches);
