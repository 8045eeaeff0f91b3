//! What volver's layers cost: `cargo bench -p volver-benches`.

use gmp_mpfr_sys::mpfr::mpfr_t;
use std::ffi::{c_long, c_ulong};

// Declared here, since what a build script compiles is linked with the library.
unsafe extern "C" {
    /// The radiance of the medium in `mpfr/ray.c` by trapezoid rules on n segments, in so many bits.
    pub fn mpfr_trapezoid(radiance: *mut mpfr_t, n: c_ulong, bits: c_long);
}
