//! Emulated formats give what their definitions say: bit for bit what hardware gives where it has the
//! format, what tables of all codes say of 8-bit formats, what exact rational arithmetic says of fixed
//! point, and correctly rounded elementary functions.

mod elementary;
mod ends;
mod fixed;
mod hardware;
mod methods;
mod mpfr;
mod rounding;
mod tables;

use rug::Float;
use volver::real::{Ieee, IeeeReal};

/// A number of `format` with the value, or the kind of NaN or infinity, and the sign of `x`.
fn number(format: Ieee, x: f64) -> IeeeReal {
    format.round(&Float::with_val(53, x))
}

/// Whether `ours` is `x`, the sign of 0 included, or both are NaN.
fn is(ours: &IeeeReal, x: f64) -> bool {
    let value = ours.as_float();
    if x.is_nan() {
        return value.is_nan();
    }
    // A value that binary64 lacks would be rounded on its way out.
    *value == x && value.is_sign_negative() == x.is_sign_negative()
}
