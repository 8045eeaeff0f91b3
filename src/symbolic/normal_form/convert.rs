//! From expressions to polynomials.

use super::Stop;
use super::arena::{Arena, AtomKind, Polynomial};
use super::coefficient::Coefficient;
use crate::symbolic::{Expr, Function, Kind};
use rug::Rational;
use std::sync::Arc;

impl Arena {
    /// The normal form of an expression, divisors not yet cleared.
    pub(super) fn polynomial(&mut self, expr: &Expr) -> Result<Polynomial, Stop> {
        for node in expr.nodes() {
            if !self.known.contains_key(node) {
                let polynomial = self.of_node(node)?;
                self.known.insert(node.clone(), polynomial);
            }
        }
        self.part(expr)
    }

    /// What is known of a part already.
    fn part(&self, expr: &Expr) -> Result<Polynomial, Stop> {
        self.known.get(expr).copied().ok_or(Stop::Branches)
    }

    fn of_node(&mut self, node: &Expr) -> Result<Polynomial, Stop> {
        match node.kind() {
            Kind::Number(q) => Ok(self.constant(Coefficient::real(q.clone()))),
            Kind::Pi => Ok(self.of_atom(AtomKind::Symbol(None))),
            Kind::Symbol(name) => Ok(self.of_atom(AtomKind::Symbol(Some(Arc::clone(name))))),
            Kind::Sum(terms) => {
                let mut all = Vec::new();
                for term in terms {
                    let part = self.part(term)?;
                    all.extend(self.terms(part).iter().cloned());
                }
                self.work(all.len())?;
                Ok(self.sum_of(all))
            }
            Kind::Product(factors) => {
                let mut product = self.one;
                for factor in factors {
                    let part = self.part(factor)?;
                    product = self.product(product, part)?;
                }
                Ok(product)
            }
            Kind::Power(base, exponent) => {
                let base = self.part(base)?;
                self.rational_power(base, exponent)
            }
            Kind::Call(function, argument) => {
                let argument = self.part(argument)?;
                self.call(*function, argument)
            }
            Kind::Min(..) | Kind::Max(..) | Kind::Piecewise(..) => Err(Stop::Branches),
        }
    }

    fn call(&mut self, function: Function, argument: Polynomial) -> Result<Polynomial, Stop> {
        match function {
            Function::Exp => self.exponential(argument),
            Function::Ln => self.logarithm(argument),
            Function::Sin => self.wave(argument, true, true),
            Function::Cos => self.wave(argument, true, false),
            Function::Sinh => self.wave(argument, false, true),
            Function::Cosh => self.wave(argument, false, false),
            Function::Tan => self.ratio(argument, true),
            Function::Tanh => self.ratio(argument, false),
            Function::Atan | Function::Erf => Ok(self.odd_call(function, argument)),
            Function::Abs => self.absolute(argument),
        }
    }

    /// (e^u ± e^(−u))/2, or over 2i where u = i·argument and the sign is minus.
    fn wave(
        &mut self,
        argument: Polynomial,
        circular: bool,
        odd: bool,
    ) -> Result<Polynomial, Stop> {
        let unit = if circular {
            Coefficient::imaginary(1)
        } else {
            Coefficient::real(1)
        };
        let up = self.scaled(argument, &unit);
        let down = self.scaled(up, &Coefficient::real(-1));
        let half = Coefficient::real(Rational::from((1, 2)));
        let first = match (odd, circular) {
            // 1/(2i) = −i/2
            (true, true) => Coefficient::imaginary(Rational::from((-1, 2))),
            _ => half,
        };
        let second = if odd { first.negative() } else { first.clone() };
        let (up, down) = (self.exponential(up)?, self.exponential(down)?);
        let (up, down) = (self.scaled(up, &first), self.scaled(down, &second));
        Ok(self.sum(up, down))
    }

    /// The odd wave over the even one.
    fn ratio(&mut self, argument: Polynomial, circular: bool) -> Result<Polynomial, Stop> {
        let above = self.wave(argument, circular, true)?;
        let below = self.wave(argument, circular, false)?;
        let inverse = self.inverse(below)?;
        self.product(above, inverse)
    }
}
