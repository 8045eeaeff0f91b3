//! Whether an expression is 0 everywhere: proved, refuted, or unknown.

use super::normal_form::{Reduction, reduce};
use super::{Expr, Function, Kind, Witness, pieces, refute_zero};
use rug::Rational;

/// What became of the claim that an expression is 0 wherever it has a value.
#[derive(Clone, Debug, PartialEq)]
pub enum ZeroTest {
    /// It is: its normal form is 0, piece by piece where it has branches (at the places where pieces meet
    /// it may be anything).
    Proved,
    /// It is not.
    Refuted(Witness),
    /// Neither is known.
    Unknown,
}

/// Tests whether `expr` is 0 for all values of its symbols in `ranges`; a symbol without a range is
/// looked at between 1/8 and 9/8.
///
/// ```
/// use volver::symbolic::{Expr, ZeroTest, zero_test};
///
/// let identity: Expr = "sin(2*x) - 2*sin(x)*cos(x)".parse()?;
/// assert_eq!(zero_test(&identity, &[]), ZeroTest::Proved);
/// let wrong: Expr = "sin(2*x) - 2*sin(x)".parse()?;
/// assert!(matches!(zero_test(&wrong, &[]), ZeroTest::Refuted(_)));
/// # Ok::<(), volver::symbolic::ParseError>(())
/// ```
#[must_use]
pub fn zero_test(expr: &Expr, ranges: &[(String, Rational, Rational)]) -> ZeroTest {
    let proved = match reduce(expr) {
        Reduction::Zero => true,
        Reduction::Branches => is_zero_on_pieces(expr, ranges),
        Reduction::Nonzero { .. } => {
            // √(x²) is |x|, and |x| is x where x ≥ 0.
            let simplified = expr.simplify();
            let is_absolute = |node: &&Expr| matches!(node.kind(), Kind::Call(Function::Abs, _));
            simplified.nodes().iter().any(is_absolute) && is_zero_on_pieces(&simplified, ranges)
        }
        Reduction::DivisionByZero | Reduction::TooLarge => false,
    };
    if proved {
        return ZeroTest::Proved;
    }
    match refute_zero(expr, ranges) {
        Some(witness) => ZeroTest::Refuted(witness),
        None => ZeroTest::Unknown,
    }
}

/// Whether each piece of an expression of one symbol is 0.
fn is_zero_on_pieces(expr: &Expr, ranges: &[(String, Rational, Rational)]) -> bool {
    let symbols = expr.symbols();
    let [symbol] = &symbols[..] else {
        return false;
    };
    let Some((_, from, to)) = ranges.iter().find(|(name, ..)| **name == **symbol) else {
        return false;
    };
    pieces(std::slice::from_ref(expr), symbol, from, to).is_ok_and(|pieces| {
        pieces
            .iter()
            .all(|piece| piece.exprs.iter().all(|e| reduce(e) == Reduction::Zero))
    })
}
