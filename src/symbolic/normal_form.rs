//! The algebraic half of a zero test.
//!
//! An expression is written as an exponential polynomial over ℚ(i): a sum of coefficients times monomials
//! exp(E) · ∏ atomᵏ, where E is a polynomial again. Sines and cosines are exponentials by Euler's formulas,
//! exp(a)·exp(b) is exp(a + b), and symbols, π, logarithms, radicals, inverses of sums, |x|, atan and erf
//! are atoms. Inverses are cleared at the end. What is then 0 term by term is 0, since every step is an
//! identity wherever the expression is defined.
//!
//! The other direction isn't promised: relations between ln, radicals, atan, erf, |x| and powers of e^π are
//! not known here, so what isn't 0 term by term may be 0 still. No test could know all: D. Richardson, *Some
//! undecidable problems involving elementary functions of a real variable*, J. Symb. Logic 33 (1968). For
//! rational functions and the exponentials, sines and cosines of rational functions, all with rational
//! coefficients, the normal form is 0 exactly where the function is (Lindemann and Weierstrass).

pub(crate) mod arena;
pub(crate) mod coefficient;
mod conjugate;
mod divide;
mod exponential;
mod multiply;
mod number;
mod opaque;
pub(crate) mod polynomial;
mod power;
mod quotient;
pub(crate) mod ratio;
pub(crate) mod translate;

use super::{Expr, Kind};
use arena::{Arena, Stop};

/// The most terms of a sum that are kept.
pub const MAX_TERMS: usize = 1 << 14;

/// The most products of terms that are worked out, those of long coefficients counted more.
pub const MAX_WORK: u64 = 1 << 21;

/// What the normal form says of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    /// The normal form is 0: so is the expression, wherever it is defined. A proof.
    Zero,
    /// The normal form isn't 0: says nothing (algebraic relations between its atoms may be unknown).
    Nonzero {
        /// How many terms the normal form has, its inverses cleared.
        terms: usize,
    },
    /// A min, max or piecewise.
    Branches,
    /// A divisor or an argument of a logarithm whose normal form is 0: the expression is defined nowhere.
    DivisionByZero,
    /// More terms or more work than the budget, [`MAX_TERMS`] and [`MAX_WORK`].
    TooLarge,
}

/// Brings an expression into normal form, exactly.
///
/// [`Reduction::Zero`] is a proof that the expression is 0 wherever it is defined; an expression that is
/// defined nowhere may be so, too. [`Reduction::Nonzero`] proves nothing.
///
/// ```
/// use volver::symbolic::{Expr, Reduction, reduce};
///
/// let zero: Expr = "sin(2*x) - 2*sin(x)*cos(x)".parse()?;
/// assert_eq!(reduce(&zero), Reduction::Zero);
/// # Ok::<(), volver::symbolic::ParseError>(())
/// ```
#[must_use]
pub fn reduce(expr: &Expr) -> Reduction {
    let nodes = expr.nodes();
    let branches = |node: &&Expr| {
        matches!(
            node.kind(),
            Kind::Min(..) | Kind::Max(..) | Kind::Piecewise(..)
        )
    };
    if nodes.iter().any(branches) {
        return Reduction::Branches;
    }
    let numerator = Arena::new().and_then(|mut arena| {
        let polynomial = translate::translate(expr, &nodes, &mut arena)?;
        Ok(arena.clear(&polynomial)?.0.len())
    });
    match numerator {
        Ok(0) => Reduction::Zero,
        Ok(terms) => Reduction::Nonzero { terms },
        Err(Stop::DivisionByZero) => Reduction::DivisionByZero,
        Err(Stop::TooLarge) => Reduction::TooLarge,
    }
}
