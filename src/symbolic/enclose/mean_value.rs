//! The mean-value form: tighter than the expression itself where the interval is narrow.

use super::{EncloseError, Evaluator};
use crate::symbolic::Expr;
use crate::symbolic::interval::Interval;

/// The range of an expression of one symbol over `range`, by the expression and by its derivative:
/// f(x) is in f(m) + f′(X)·(X − m) for each x in X, m the midpoint of X.
///
/// The derivative helps where it has an enclosure and the expression cannot jump; its result is as wide
/// as the square of the interval's width, where the expression's own is as wide as the interval.
///
/// # Errors
/// [`EncloseError`] where the expression has no enclosure of its own.
pub fn enclose_range(
    expr: &Expr,
    derivative: &Expr,
    symbol: &str,
    range: &Interval,
) -> Result<Interval, EncloseError> {
    let bits = range.bits();
    let over = |name: &str| (name == symbol).then(|| range.clone());
    let mut evaluator = Evaluator::new(bits, &over);
    let natural = evaluator.enclose(expr)?;
    let form = || {
        if evaluator.may_jump() || !range.is_finite() {
            return None;
        }
        let slope = derivative.enclose(bits, &over).ok()?;
        mean_value(expr, symbol, range, &slope)
    };
    Ok(form()
        .and_then(|form| form.intersection(&natural))
        .unwrap_or_else(|| natural.as_ref().clone()))
}

/// f(m) + slope·(X − m).
pub(crate) fn mean_value(
    expr: &Expr,
    symbol: &str,
    range: &Interval,
    slope: &Interval,
) -> Option<Interval> {
    let middle = Interval::exactly(&range.midpoint());
    let at_middle = |name: &str| (name == symbol).then(|| middle.clone());
    let centre = expr.enclose(range.bits(), &at_middle).ok()?;
    Some(&centre + &(slope * &(range - &middle)))
}
