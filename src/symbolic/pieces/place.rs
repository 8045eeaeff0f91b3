//! A number where pieces meet, and what expressions are there.

use crate::symbolic::choice::{Which, resolve};
use crate::symbolic::constant::{ConstantTest, sign};
use crate::symbolic::normal_form::{Reduction, reduce};
use crate::symbolic::{EncloseError, Expr, Interval, quotient};
use rug::Rational;
use std::cmp::Ordering;

/// Precision of enclosures.
const BITS: u32 = 192;

/// A number where pieces meet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The number itself, where it has a closed form.
    pub exact: Option<Expr>,
    /// Rational numbers that it lies between; both are the number where that is rational.
    pub bracket: (Rational, Rational),
    /// What it was found as a zero of.
    pub(super) zero_of: Option<Expr>,
}

impl Place {
    /// A rational place.
    #[must_use]
    pub fn rational(q: Rational) -> Place {
        Place {
            exact: Some(Expr::number(q.clone())),
            bracket: (q.clone(), q),
            zero_of: None,
        }
    }

    /// The number, where it is rational.
    #[must_use]
    pub fn as_rational(&self) -> Option<&Rational> {
        (self.bracket.0 == self.bracket.1).then_some(&self.bracket.0)
    }

    /// What an expression of `symbol` is at this very place.
    #[must_use]
    pub fn value(&self, expr: &Expr, symbol: &str) -> ConstantTest {
        if let Some(exact) = &self.exact {
            return ConstantTest::of(&expr.substitute(symbol, exact));
        }
        let Some(expr) = self.resolve(expr, symbol, Which::All) else {
            return ConstantTest::Unknown;
        };
        let over = |name: &str| {
            (name == symbol).then(|| Interval::hull(BITS, &self.bracket.0, &self.bracket.1))
        };
        match expr.enclose(BITS, &over) {
            Ok(value) if !value.contains_zero() => ConstantTest::Nonzero(value),
            Ok(_) if reduce(&expr) == Reduction::Zero || self.divides(&expr, &over) => {
                ConstantTest::Zero
            }
            Err(EncloseError::NotDefined { certain: true, .. }) => ConstantTest::NotDefined,
            _ => ConstantTest::Unknown,
        }
    }

    /// Whether what the place is a zero of is a factor of the expression.
    fn divides(&self, expr: &Expr, over: &dyn Fn(&str) -> Option<Interval>) -> bool {
        let cofactor = self.zero_of.as_ref().and_then(|zero| quotient(expr, zero));
        cofactor.is_some_and(|cofactor| cofactor.enclose(BITS, over).is_ok())
    }

    /// The sign of a difference at this very place.
    fn sign(&self, difference: &Expr, symbol: &str) -> Option<Ordering> {
        match &self.exact {
            Some(exact) => sign(&difference.substitute(symbol, exact)),
            None => match self.value(difference, symbol) {
                ConstantTest::Zero => Some(Ordering::Equal),
                ConstantTest::Nonzero(value) if value.is_positive() => Some(Ordering::Greater),
                ConstantTest::Nonzero(_) => Some(Ordering::Less),
                ConstantTest::NotDefined | ConstantTest::Unknown => None,
            },
        }
    }

    /// The function that the expression is at this very place, without the choices that are made there;
    /// `None` where one of them is not known.
    pub(in crate::symbolic) fn resolve(
        &self,
        expr: &Expr,
        symbol: &str,
        which: Which,
    ) -> Option<Expr> {
        resolve(expr, which, &|difference| self.sign(difference, symbol))
    }
}
