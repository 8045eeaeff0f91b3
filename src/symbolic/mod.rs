//! Symbolic expressions: read, print, differentiate, simplify, evaluate, enclose, decide.
//!
//! [`Expr`] is an expression with exact rational constants. It is evaluated in any [`real`](crate::real)
//! format, enclosed in intervals of MPFR, and tested for being 0 everywhere.

mod differentiate;
mod expr;
mod facts;
mod function;
mod hash;
mod parse;
mod print;
mod program;
mod quotient;
mod simplify;
mod substitute;
#[cfg(feature = "studies")]
mod taylor;

pub use expr::{Branch, Condition, Expr, Kind, Relation};
pub use facts::Facts;
pub use function::Function;
pub(crate) use hash::HashMap;
pub use parse::{
    MAX_BITS, MAX_DEPTH, MAX_EXPONENT, MAX_TEXT, MAX_TOKENS, ParseError, Problem, parse_number,
};
pub use program::{
    Bound, CompileError, Constant, Instruction, KeptProgram, Operand, Operation, Program,
};
pub use quotient::{expand, quotient};
#[cfg(feature = "studies")]
pub use taylor::{Range, Taylor, taylor};

mod choice;
mod constant;
mod decide;
mod enclose;
mod interval;
mod pieces;
mod refute;
mod simplest;
pub use constant::ConstantTest;
pub use decide::{Claim, DECIDE_BUDGET, Decision, decide};
pub use enclose::{EncloseError, enclose_range};
pub use interval::{Interval, Undefined};
pub use pieces::{Joint, Piece, PiecesError, Place, joints, pieces};
pub use refute::{Witness, refute_zero};
pub(crate) use simplest::simplest_between;

pub mod code;
#[cfg(feature = "studies")]
mod coq;
#[cfg(feature = "studies")]
mod latex;
pub(crate) mod normal_form;
mod zero_test;
#[cfg(feature = "studies")]
pub use coq::CoqError;
pub use normal_form::{MAX_TERMS, MAX_WORK, Reduction, reduce};
pub use zero_test::{ZeroTest, zero_test, zero_test_inside};
