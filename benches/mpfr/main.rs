//! One ray in MPFR beside the same in C with every number in place: what the generic code costs beyond MPFR's functions.
//!
//! `ray.c` is compiled by `build.rs` against the MPFR that the library is linked with. Answers are compared first, bit by bit;
//! then both run in turn, by the processor's clock of this process.

#![allow(missing_docs, unsafe_code, clippy::expect_used)]

use rug::Float;
use rustix::time::{ClockId, clock_gettime};
use std::ffi::c_long;
use std::hint::black_box;
use volver::case::{Fresh, SineSquared};
use volver::method::Method;
use volver::real::Mpfr;
use volver_benches::mpfr_trapezoid;

const SEGMENTS: u64 = 1 << 12;
const ROUNDS: usize = 15;

fn main() {
    let method: Method = "trapezoid/trapezoid".parse().expect("a method");
    let Method::Nested(nested) = method else {
        return;
    };
    println!("bits  ns a sample    C ns  ratio (quartiles)");
    for bits in [53, 113, 200, 341, 1000] {
        let ours = || {
            let nodes = Fresh::new(&SineSquared, Mpfr { bits });
            nested.radiance(&nodes, SEGMENTS).expect("a radiance")
        };
        let in_c = || {
            let mut radiance = Float::new(bits);
            // SAFETY: a number of so many bits, which C writes to alone.
            unsafe { mpfr_trapezoid(radiance.as_raw_mut(), SEGMENTS, c_long::from(bits)) };
            radiance
        };
        assert_eq!(*ours().as_float(), in_c());
        let mut times: Vec<[f64; 2]> = (0..ROUNDS)
            .map(|_| [seconds(ours), seconds(in_c)])
            .collect();
        let ratio = |time: &[f64; 2]| time[0] / time[1];
        times.sort_by(|a, b| ratio(a).total_cmp(&ratio(b)));
        let median = |which: usize| {
            let mut all: Vec<f64> = times.iter().map(|time| time[which]).collect();
            all.sort_by(f64::total_cmp);
            1e9 * all[ROUNDS / 2] / SEGMENTS as f64
        };
        println!(
            "{bits:4}  {:11.0}  {:6.0}  {:.3} ({:.3} to {:.3})",
            median(0),
            median(1),
            ratio(&times[ROUNDS / 2]),
            ratio(&times[ROUNDS / 4]),
            ratio(&times[ROUNDS - 1 - ROUNDS / 4]),
        );
    }
}

fn seconds<T>(work: impl Fn() -> T) -> f64 {
    let start = clock_gettime(ClockId::ProcessCPUTime);
    for _ in 0..8 {
        black_box(work());
    }
    let end = clock_gettime(ClockId::ProcessCPUTime);
    let taken = (end.tv_sec - start.tv_sec) as f64 + (end.tv_nsec - start.tv_nsec) as f64 * 1e-9;
    taken / 8.0
}
