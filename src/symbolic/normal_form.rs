//! A normal form that proves identities: exponential polynomials over ℚ(i).
//!
//! A polynomial is a sum of monomials with coefficients in ℚ(i); a monomial is e^E times powers of atoms,
//! where the exponent E is itself such a polynomial. Sines, cosines and hyperbolic functions become
//! exponentials, e^a e^b = e^(a+b), e^(k ln u) = uᵏ; ln, roots, erf and atan are atoms of what they are
//! functions of, and so is the divisor of a quotient, until all divisors are cleared at the end. Equal
//! polynomials, monomials and atoms are stored once, and products of monomials are remembered.
//!
//! Where the normal form is 0 the expression is 0 wherever it has a value: every step is an identity
//! there. The other way round nothing follows, since atoms may depend on each other in ways that are not
//! known here. What is *not* used, because it fails somewhere: ln(ab) = ln a + ln b, √(x²) = x,
//! atan(tan x) = x.

mod arena;
mod atoms;
mod coefficient;
mod convert;
mod numbers;
mod order;
mod products;
#[cfg(test)]
mod tests;

use super::{Expr, Kind};
use arena::Arena;

/// Products of terms that are worked out before a normal form is given up.
pub const MAX_PRODUCTS: usize = 200_000;

/// What the normal form says of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reduction {
    /// It is 0: so is the expression, wherever it has a value. This is a proof.
    Zero,
    /// It is not 0, which proves nothing.
    Nonzero {
        /// How many terms are left.
        terms: usize,
    },
    /// The expression has min, max or piecewise in it: it has to be cut into pieces first.
    Branches,
    /// A divisor, or the argument of a logarithm, is 0: the expression has no value anywhere.
    Undefined,
    /// It takes more than [`MAX_PRODUCTS`] products of terms.
    TooLarge,
}

/// Why there is no normal form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stop {
    Branches,
    Undefined,
    TooLarge,
}

/// The normal form of an expression, as far as what it says.
///
/// ```
/// use volver::symbolic::{Expr, Reduction, reduce};
///
/// let identity: Expr = "sin(x)^2 + cos(x)^2 - 1".parse()?;
/// assert_eq!(reduce(&identity), Reduction::Zero);
/// # Ok::<(), volver::symbolic::ParseError>(())
/// ```
#[must_use]
pub fn reduce(expr: &Expr) -> Reduction {
    let has_branches = |node: &&Expr| {
        matches!(
            node.kind(),
            Kind::Min(..) | Kind::Max(..) | Kind::Piecewise(..)
        )
    };
    if expr.nodes().iter().any(has_branches) {
        return Reduction::Branches;
    }
    let mut arena = Arena::new();
    let cleared = arena
        .polynomial(expr)
        .and_then(|polynomial| arena.without_divisors(polynomial));
    match cleared {
        Ok(polynomial) => match arena.terms(polynomial).len() {
            0 => Reduction::Zero,
            terms => Reduction::Nonzero { terms },
        },
        Err(Stop::Branches) => Reduction::Branches,
        Err(Stop::Undefined) => Reduction::Undefined,
        Err(Stop::TooLarge) => Reduction::TooLarge,
    }
}
