//! Somebody else's implementations: how they are asked, what becomes of them, and what is found out.

// A test may stop at what a library must not; its numbers are often exact.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    clippy::float_cmp,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss
)]

mod adjoint;
mod assert;
mod extremes;
mod gradient;
mod identify;
mod itself;
mod kernel;
mod kernel_defects;
mod kernel_library;
mod kernel_process;
mod kernel_verify;
mod verify;
