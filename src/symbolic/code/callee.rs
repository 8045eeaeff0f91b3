//! What generated code calls.

use crate::symbolic::Function;

/// An operation that is written as a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Callee {
    Function(Function),
    Sqrt,
    ExpM1,
    Ln1p,
    Min,
    Max,
    /// A division whose divisor may be 0, where the language's own does not follow IEEE 754.
    Divide,
}
