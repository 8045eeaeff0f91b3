//! Where an expression is piecewise in its symbol, and what it is between.

use crate::symbolic::{Branch, Condition, Expr, Kind, Relation};
use rug::Rational;

/// Expressions of more pieces are not cut.
const MAX_PIECES: usize = 64;

/// The ends of the interval and the numbers between that the symbol is compared with, in order.
pub(crate) fn cuts(expr: &Expr, symbol: &str, from: &Rational, to: &Rational) -> Vec<Rational> {
    let mut cuts = vec![from.clone(), to.clone()];
    for node in expr.nodes() {
        let Kind::Piecewise(branches, _) = node.kind() else {
            continue;
        };
        for Branch { condition, .. } in branches {
            if let Some((_, number)) = comparison(condition, symbol)
                && from < number
                && number < to
            {
                cuts.push(number.clone());
            }
        }
    }
    cuts.sort();
    cuts.dedup();
    if from != to && cuts.len() > MAX_PIECES {
        cuts = vec![from.clone(), to.clone()];
    }
    cuts
}

/// The expression that `expr` is strictly between two numbers.
pub(super) fn on_piece(expr: &Expr, symbol: &str, from: &Rational, to: &Rational) -> Expr {
    expr.rebuild(|node| {
        let Kind::Piecewise(branches, otherwise) = node.kind() else {
            return None;
        };
        let mut left = Vec::new();
        for branch in branches {
            match holds_between(&branch.condition, symbol, from, to) {
                Some(true) => return Some(Expr::piecewise(left, branch.value.clone())),
                Some(false) => {}
                None => left.push(branch.clone()),
            }
        }
        Some(Expr::piecewise(left, otherwise.clone()))
    })
}

/// Whether a condition on the symbol holds for all numbers strictly between two, or for none.
fn holds_between(
    condition: &Condition,
    symbol: &str,
    from: &Rational,
    to: &Rational,
) -> Option<bool> {
    let (is_below, number) = comparison(condition, symbol)?;
    if to <= number {
        Some(is_below)
    } else if number <= from {
        Some(!is_below)
    } else {
        None
    }
}

/// The number that a condition compares the symbol with, and whether it asks for less.
fn comparison<'e>(condition: &'e Condition, symbol: &str) -> Option<(bool, &'e Rational)> {
    let Condition {
        left,
        relation,
        right,
    } = condition;
    let less = matches!(relation, Relation::Less | Relation::LessEqual);
    match (left.kind(), right.kind()) {
        (Kind::Symbol(name), Kind::Number(number)) if **name == *symbol => Some((less, number)),
        (Kind::Number(number), Kind::Symbol(name)) if **name == *symbol => Some((!less, number)),
        _ => None,
    }
}
