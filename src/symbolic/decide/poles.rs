//! Poles at irrational numbers, proved by the change of sign of a divisor.

use super::{Claim, Decision, decide};
use crate::symbolic::choice::differences;
use crate::symbolic::simplest::simplest_between;
use crate::symbolic::{Expr, Function, Kind};
use rug::Rational;

/// How near to the pole its witness is, in halvings of the interval.
const HALVINGS: u32 = 20;

/// A number beside one strictly inside the interval where the expression has no value.
pub(super) fn pole(expr: &Expr, symbol: &str, from: &Rational, to: &Rational) -> Option<Rational> {
    // Where branches are left, a divisor may stand in one that is not taken.
    if !differences(expr).is_empty() {
        return None;
    }
    let divisors = expr
        .nodes()
        .into_iter()
        .filter_map(|node| match node.kind() {
            Kind::Power(base, exponent) if *exponent < 0 => Some(base.clone()),
            Kind::Call(Function::Tan, x) => Some(x.call(Function::Cos)),
            _ => None,
        });
    divisors.into_iter().find_map(|divisor| {
        match decide(&divisor, symbol, from, to, Claim::Nonzero) {
            Decision::Refuted { witness, .. } if *from < witness && witness < *to => {
                let width = Rational::from(to - from) >> HALVINGS;
                let low = Rational::from(&witness - &width).max(from.clone());
                Some(simplest_between(
                    &low,
                    &Rational::from(&witness + &width).min(to.clone()),
                ))
            }
            _ => None,
        }
    })
}
