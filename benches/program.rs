//! Compiled expressions against the closure one would write by hand, on the paper's Table 1 medium.
//!
//! The bits are the same (asserted); what may differ is time.

#![allow(clippy::expect_used)]

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use volver::case::{Case, SineSquared};
use volver::real::{Format, Mpfr, Native, Real};
use volver::symbolic::{Expr, Program};

/// C and τ by the case's own generic code.
fn by_hand<R: Real>(s: &[R], values: &mut [Vec<R>; 2]) {
    for s in s {
        let transfer = SineSquared.transfer(s);
        values[0].push(transfer.emission);
        values[1].push(transfer.extinction);
    }
}

fn compare<F: Format>(c: &mut Criterion, format: F, n: u64) {
    let expressions: Vec<Expr> = ["sin(s^2)", "s*cos(s^2)"]
        .iter()
        .map(|text| text.parse().expect("an expression"))
        .collect();
    let program = Program::new(&expressions, &["s"]).expect("a program");
    let bound = program.bind(format);
    let s: Vec<F::Real> = (0..n).map(|i| format.fraction(i, n)).collect();
    let compiled = || {
        let mut values = [Vec::with_capacity(s.len()), Vec::with_capacity(s.len())];
        bound.run(&[black_box(&s)], &mut values);
        values
    };
    let hand_written = || {
        let mut values = [Vec::with_capacity(s.len()), Vec::with_capacity(s.len())];
        by_hand(black_box(&s), &mut values);
        values
    };
    assert!(compiled() == hand_written(), "other bits in {format}");
    let mut group = c.benchmark_group(format!("program/{format}"));
    group.throughput(Throughput::Elements(n));
    group.bench_function(BenchmarkId::new("compiled", n), |b| b.iter(compiled));
    group.bench_function(BenchmarkId::new("by hand", n), |b| b.iter(hand_written));
    group.finish();
}

fn programs(c: &mut Criterion) {
    compare(c, Native::<f64>::new(), 4096);
    compare(c, Mpfr { bits: 128 }, 512);
}

criterion_group!(benches, programs);
criterion_main!(benches);
