//! What holds strictly between two places, where its ends may be zeros.

use super::{Place, roots};
use crate::symbolic::simplest::simplest_between;
use crate::symbolic::{Claim, Decision, Expr, Function, Kind, decide};
use rug::Rational;
use std::cmp::Ordering;

/// All numbers strictly between two places.
pub(in crate::symbolic) struct Stretch<'p> {
    symbol: &'p str,
    from: &'p Place,
    to: &'p Place,
}

impl<'p> Stretch<'p> {
    pub(in crate::symbolic) fn new(symbol: &'p str, from: &'p Place, to: &'p Place) -> Self {
        Stretch { symbol, from, to }
    }

    /// What varies.
    pub(in crate::symbolic) fn symbol(&self) -> &str {
        self.symbol
    }

    /// The derivative of an expression.
    pub(in crate::symbolic) fn slope(&self, expr: &Expr) -> Expr {
        expr.differentiate(self.symbol).simplify()
    }

    /// Both ends, and a place between.
    pub(in crate::symbolic) fn places(&self) -> impl Iterator<Item = Place> {
        let (from, to) = (&self.from.bracket.1, &self.to.bracket.0);
        let middle = simplest_between(
            &((Rational::from(from * 3) + to) / 4),
            &((Rational::from(to * 3) + from) / 4),
        );
        [self.from.clone(), self.to.clone(), Place::rational(middle)].into_iter()
    }

    /// Whether the claim is proved of an expression, at both ends too.
    pub(in crate::symbolic) fn proves(&self, expr: &Expr, claim: Claim) -> bool {
        let (from, to) = (&self.from.bracket.0, &self.to.bracket.1);
        decide(expr, self.symbol, from, to, claim) == Decision::Proved
    }

    /// Whether an expression without branches has that sign everywhere, and is 0 at its ends at most.
    pub(in crate::symbolic) fn keeps_off_zero(&self, expr: &Expr, sign: Ordering) -> bool {
        let signed = match sign {
            Ordering::Less => -expr,
            _ => expr.clone(),
        };
        if self.proves(&signed, Claim::Positive) {
            return true;
        }
        self.proves(&signed, Claim::NonNegative) && self.is_analytic(expr) && {
            // What is analytic, ≥ 0 and monotone is 0 from an end on, and then everywhere, or nowhere.
            let slope = self.slope(expr);
            let is_monotone = [slope.clone(), -slope]
                .iter()
                .any(|slope| self.proves(slope, Claim::NonNegative));
            let found = || roots::roots(expr, self.symbol, self.from, self.to);
            is_monotone && self.is_somewhere_nonzero(expr)
                || found().is_ok_and(|roots| roots.is_empty()) && self.is_somewhere_nonzero(expr)
        }
    }

    /// Whether an expression without branches that has a value everywhere is analytic: fractional powers
    /// are, but where their base is 0.
    pub(in crate::symbolic) fn is_analytic(&self, expr: &Expr) -> bool {
        expr.nodes().into_iter().all(|node| match node.kind() {
            Kind::Power(base, exponent) if *exponent.denom() != 1 => {
                self.keeps_off_zero(base, Ordering::Greater)
            }
            _ => true,
        })
    }

    fn is_somewhere_nonzero(&self, expr: &Expr) -> bool {
        let (from, to) = (&self.from.bracket.1, &self.to.bracket.0);
        [(1, 2), (1, 3), (3, 5)].into_iter().any(|part| {
            let at = Rational::from(to - from) * Rational::from(part) + from;
            roots::value_at(expr, self.symbol, &at).is_some_and(|value| !value.contains_zero())
        })
    }
}

/// An expression with the same zeros, simple ones where they are seen to be of even order.
pub(super) fn even_root(expr: &Expr) -> Expr {
    match expr.kind() {
        Kind::Power(base, exponent) if *exponent > 0 => even_root(base),
        Kind::Product(factors) => {
            let others = factors.iter().filter(|factor| {
                let is_positive = matches!(factor.kind(), Kind::Call(Function::Exp, _));
                factor.as_number().is_none_or(|q| *q == 0) && !is_positive
            });
            Expr::product(others.map(even_root))
        }
        _ => expr.clone(),
    }
}
