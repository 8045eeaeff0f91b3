//! Compiles what benches run beside the library and has to be linked with its MPFR.

#![allow(missing_docs, clippy::expect_used)]

use std::env;

fn main() {
    println!("cargo:rerun-if-changed=mpfr/ray.c");
    let include = env::var("DEP_GMP_INCLUDE_DIR").expect("where gmp-mpfr-sys built MPFR");
    cc::Build::new()
        .file("mpfr/ray.c")
        .include(include)
        .opt_level(3)
        .flag("-march=native")
        .compile("ray_in_mpfr");
}
