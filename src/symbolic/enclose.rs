//! All values that an expression takes while its symbols range over intervals.

mod evaluate;
mod mean_value;

pub use mean_value::enclose_range;

pub(super) use evaluate::{Evaluator, Fault};
pub(super) use mean_value::mean_value;

use super::Expr;
use super::interval::Interval;

/// Why there is no enclosure.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EncloseError {
    /// A symbol has no value.
    #[error("{name} has no value")]
    UnknownSymbol {
        /// The symbol.
        name: String,
    },
    /// Some part is not known to be defined everywhere on the box.
    #[error("{part} is not {}", if *.certain { "defined" } else { "known to be defined everywhere" })]
    NotDefined {
        /// The part, as it is printed.
        part: String,
        /// Whether it is defined nowhere on the box.
        certain: bool,
    },
}

impl Expr {
    /// An interval with every value the expression takes while each symbol is anywhere in its interval.
    ///
    /// Works at the greater of `bits` and what the intervals have. Symbols are unrelated to one another,
    /// and so are the occurrences of one: the result contains the range and may be much wider; over one
    /// number it is wider by roundings only. Where it cannot be told which branch of a piecewise
    /// expression is taken, those that may be are united; branches not taken need not be defined.
    ///
    /// # Errors
    /// [`EncloseError`] where a symbol has no value, or a needed part is not known to be defined on all
    /// of the box: a divisor that contains 0, a logarithm of what reaches 0, a fractional power of what
    /// reaches below 0, a tangent across a pole.
    pub fn enclose(
        &self,
        bits: u32,
        value: &dyn Fn(&str) -> Option<Interval>,
    ) -> Result<Interval, EncloseError> {
        let result = Evaluator::new(bits, value).enclose(self);
        match result {
            Ok(interval) => Ok(interval.as_ref().clone()),
            Err(fault) => Err(fault.into()),
        }
    }
}

impl From<Fault<'_>> for EncloseError {
    fn from(fault: Fault<'_>) -> EncloseError {
        match fault {
            Fault::Unknown(name) => EncloseError::UnknownSymbol { name: name.into() },
            Fault::NotDefined { part, certain } => EncloseError::NotDefined {
                part: part.to_string(),
                certain,
            },
        }
    }
}
