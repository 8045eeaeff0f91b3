//! Powers of powers and of exponentials.

use crate::symbolic::{Expr, Function, Kind};
use rug::Rational;

pub(super) fn power(base: &Expr, exponent: &Rational) -> Option<Expr> {
    let facts = base.facts();
    if *exponent == 0 {
        return (facts.total && facts.nonzero).then(|| Expr::number(1));
    }
    match base.kind() {
        // eᵃ is positive wherever it exists.
        Kind::Call(Function::Exp, argument) => {
            Some((Expr::number(exponent.clone()) * argument.clone()).exp())
        }
        Kind::Power(inner, first) => power_of_power(inner, first, exponent),
        Kind::Call(Function::Abs, inner) if is_even(exponent) => {
            // |x|² = x²: both exist where x does, but for 0 to a negative power in both.
            Some(inner.pow(exponent.clone()))
        }
        _ => None,
    }
}

/// (xᵃ)ᵇ.
fn power_of_power(x: &Expr, a: &Rational, b: &Rational) -> Option<Expr> {
    let product = Rational::from(a * b);
    let integer = |q: &Rational| *q.denom() == 1;
    let facts = x.facts();
    // At 0, x⁻¹ has no value, and neither has what becomes of it unless its power is negative too.
    let same_at_zero = *a > 0 || product < 0 || facts.nonzero;
    if !same_at_zero || *a == 0 {
        return None;
    }
    if integer(a) && integer(b) || facts.nonnegative {
        return Some(x.pow(product));
    }
    if !integer(a) && !integer(&product) {
        // Both exist for x ≥ 0 alone.
        return Some(x.pow(product));
    }
    if is_even(a) && !integer(b) {
        // √(x²) = |x|
        return Some(x.call(Function::Abs).pow(product));
    }
    None
}

fn is_even(q: &Rational) -> bool {
    *q.denom() == 1 && q.numer().is_even()
}
