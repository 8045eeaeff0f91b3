//! Simplification that changes neither a value nor where there is one.

mod calls;
mod powers;
mod products;
mod sums;

use super::{Expr, Kind};

/// Rounds after which a simplification that still changes something is left as it is.
const ROUNDS: usize = 8;

impl Expr {
    /// A simpler expression with the same value at every point, and a value at the same points.
    ///
    /// A rule that holds only on a condition (x/x = 1 where x is not 0) is applied where the condition is
    /// certain from the [`facts`](Expr::facts) alone, never where it is merely unknown.
    ///
    /// ```
    /// use volver::symbolic::Expr;
    ///
    /// let simplified = |text: &str| text.parse::<Expr>().map(|e| e.simplify().to_string());
    /// assert_eq!(simplified("x*exp(2*x)*exp(-x) + x*exp(x)")?, "2*x*exp(x)");
    /// assert_eq!(simplified("x/x")?, "x/x");
    /// assert_eq!(simplified("(1 + x^2)/(1 + x^2)")?, "1");
    /// # Ok::<(), volver::symbolic::ParseError>(())
    /// ```
    #[must_use]
    pub fn simplify(&self) -> Expr {
        let mut current = self.clone();
        for _ in 0..ROUNDS {
            let next = current.rebuild(step);
            if next == current {
                break;
            }
            current = next;
        }
        current
    }
}

/// One rule at one node whose parts are simple already.
fn step(node: &Expr) -> Option<Expr> {
    match node.kind() {
        Kind::Number(_) | Kind::Pi | Kind::Symbol(_) => None,
        Kind::Sum(terms) => Some(sums::like_terms(terms)),
        Kind::Product(factors) => Some(products::like_factors(factors)),
        Kind::Power(base, exponent) => powers::power(base, exponent),
        Kind::Call(function, argument) => calls::call(*function, argument),
        Kind::Min(a, b) => calls::lesser(a, b),
        Kind::Max(a, b) => calls::greater(a, b),
        Kind::Piecewise(branches, otherwise) => Some(calls::piecewise(branches, otherwise)),
    }
}
