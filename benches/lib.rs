//! What benches share: C beside the library, and the clock. `cargo bench -p volver-benches` runs them.

// Missing tools end a bench.
#![allow(clippy::expect_used)]

use gmp_mpfr_sys::mpfr::mpfr_t;
use libloading::Library;
use rustix::time::{ClockId, clock_gettime};
use std::ffi::{c_long, c_ulong};
use std::hint::black_box;
use std::path::Path;
use std::process::Command;

/// Rounds in which what is compared runs in turn.
pub const ROUNDS: usize = 15;

// Declared here, since what a build script compiles is linked with the library.
unsafe extern "C" {
    /// The radiance of the medium in `mpfr/ray.c` by trapezoid rules on n segments, in so many bits.
    pub fn mpfr_trapezoid(radiance: *mut mpfr_t, n: c_ulong, bits: c_long);
}

/// A file of C beside this one, compiled into `folder` by `cc -O3 -march=native` without fused multiply-add.
#[must_use]
pub fn compiled(source: &str, folder: &Path) -> Library {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join(source);
    let library = folder.join("compiled.so");
    let flags = "-O3 -march=native -ffp-contract=off -shared -fPIC -o";
    let compiler = Command::new("cc")
        .args(flags.split(' '))
        .args([&library, &source])
        .arg("-lm")
        .status();
    assert!(
        compiler.expect("a C compiler, cc").success(),
        "{} is compiled",
        source.display()
    );
    // SAFETY: nothing runs when it is loaded.
    #[allow(unsafe_code)]
    unsafe { Library::new(&library) }.expect("a shared library")
}

/// Seconds that the processor has worked for it on this thread.
pub fn seconds<A>(work: impl FnOnce() -> A) -> f64 {
    let now = || {
        let time = clock_gettime(ClockId::ThreadCPUTime);
        time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
    };
    let start = now();
    black_box(work());
    now() - start
}

/// Seconds of two that run in turn, and the first's in parts of the second's with quartiles.
#[derive(Clone, Copy, Debug)]
pub struct Compared {
    /// The median of the first.
    pub own: f64,
    /// The median of the second.
    pub other: f64,
    /// The quartiles of the ratio.
    pub ratio: [f64; 3],
}

impl Compared {
    /// [`ROUNDS`] rounds; each of both says how many seconds it took.
    pub fn new(mut own: impl FnMut() -> f64, mut other: impl FnMut() -> f64) -> Compared {
        let rounds: Vec<(f64, f64)> = (0..ROUNDS).map(|_| (own(), other())).collect();
        let of = |what: fn(&(f64, f64)) -> f64| quartiles(rounds.iter().map(what).collect());
        Compared {
            own: of(|round| round.0)[1],
            other: of(|round| round.1)[1],
            ratio: of(|round| round.0 / round.1),
        }
    }
}

/// The quartiles of some values.
#[must_use]
pub fn quartiles(mut values: Vec<f64>) -> [f64; 3] {
    values.sort_by(f64::total_cmp);
    [1, 2, 3].map(|k| values[k * (values.len() - 1) / 4])
}
