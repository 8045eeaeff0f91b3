//! Why text names no format, or numbers give none.

use super::{MAX_BITS, MIN_BITS};
use crate::real::{MAX_EXPONENT, MAX_FRACTION, MAX_IEEE_BITS, MAX_INTEGER};

/// Text that names no format, or parameters that no format has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FormatError {
    /// Not one of the names.
    #[error(
        "unknown format '{name}' (allowed: f16, bf16, f32, f64, f32-lanes, f64-lanes, tf32, fp8-e4m3, fp8-e5m2, ieee:BITS,EMIN,EMAX, fixed:FRACTION, fixed:INTEGER.FRACTION, mpfr:BITS)"
    )]
    Unknown {
        /// The text given.
        name: String,
    },
    /// MPFR's precision is no number or out of range.
    #[error(
        "precision '{bits}' of format 'mpfr:{bits}' is out of range (allowed: mpfr:{MIN_BITS} … mpfr:{MAX_BITS})"
    )]
    Precision {
        /// The text after `mpfr:`.
        bits: String,
    },
    /// An emulated format that is not given by three integers.
    #[error(
        "'{parameters}' of format 'ieee:{parameters}' are no three integers (allowed: ieee:BITS,EMIN,EMAX, such as ieee:24,-126,127)"
    )]
    Ieee {
        /// The text after `ieee:`.
        parameters: String,
    },
    /// An emulated format of too few or too many bits or exponents.
    #[error(
        "format 'ieee:{bits},{emin},{emax}' is out of range (allowed: ieee:BITS,EMIN,EMAX with 2 ≤ BITS ≤ {MAX_IEEE_BITS}, -{MAX_EXPONENT} ≤ EMIN ≤ 0, 1 ≤ EMAX ≤ {MAX_EXPONENT})"
    )]
    IeeeRange {
        /// Significant bits.
        bits: u32,
        /// The exponent of the smallest normal number.
        emin: i32,
        /// The exponent of the largest finite number.
        emax: i32,
    },
    /// A fixed-point format that is not given by one or two integers.
    #[error(
        "'{parameters}' of format 'fixed:{parameters}' are no numbers of bits (allowed: fixed:FRACTION, fixed:INTEGER.FRACTION, such as fixed:15, fixed:8.24)"
    )]
    Fixed {
        /// The text after `fixed:`.
        parameters: String,
    },
    /// A fixed-point format of too few or too many bits.
    #[error(
        "format 'fixed:{integer}.{fraction}' is out of range (allowed: fixed:INTEGER.FRACTION with 0 ≤ INTEGER ≤ {MAX_INTEGER}, 1 ≤ FRACTION ≤ {MAX_FRACTION})"
    )]
    FixedRange {
        /// Bits before the point.
        integer: u32,
        /// Bits after the point.
        fraction: u32,
    },
}
