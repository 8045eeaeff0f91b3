//! One ray in MPFR beside the same in C with every number in place: what the generic code costs beyond MPFR's functions.
//!
//! `ray.c` is compiled by `build.rs` against the MPFR that the library is linked with. Answers are compared first, bit by bit;
//! then both run in turn, by the processor's clock of this thread.

#![allow(missing_docs, unsafe_code, clippy::expect_used)]

use rug::Float;
use std::ffi::c_long;
use volver::case::{Fresh, SineSquared};
use volver::method::Method;
use volver::real::Mpfr;
use volver_benches::{Compared, mpfr_trapezoid, seconds};

const SEGMENTS: u64 = 1 << 12;
/// Runs in a round.
const RUNS: u32 = 8;

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
        let Compared { own, other, ratio } = Compared::new(|| often(ours), || often(in_c));
        let [low, ratio, high] = ratio;
        let nanoseconds = 1e9 / (f64::from(RUNS) * SEGMENTS as f64);
        println!(
            "{bits:4}  {:11.0}  {:6.0}  {ratio:.3} ({low:.3} to {high:.3})",
            own * nanoseconds,
            other * nanoseconds,
        );
    }
}

/// Seconds of [`RUNS`] runs.
fn often<A>(work: impl Fn() -> A) -> f64 {
    (0..RUNS).map(|_| seconds(&work)).sum()
}
