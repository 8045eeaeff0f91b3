//! From expressions to polynomials in their atoms, and back.

use super::polynomial::{Monomial, Polynomial};
use crate::symbolic::hash::HashMap;
use crate::symbolic::{Expr, Function, Kind};
use rug::Rational;

/// A polynomial over a product of polynomials of more than one term each.
#[derive(Clone, Debug)]
pub(super) struct Fraction {
    pub(super) numerator: Polynomial,
    pub(super) divisors: Vec<Polynomial>,
}

/// Numbers the atoms of the expressions that it has seen.
pub(super) struct Expander {
    atoms: Vec<Expr>,
    numbers: HashMap<Expr, usize>,
    /// Atoms that stand for a sum in a denominator, with that sum.
    sums: HashMap<usize, Polynomial>,
    known: HashMap<Expr, Polynomial>,
}

impl Expander {
    pub(super) fn new() -> Self {
        Expander {
            atoms: Vec::new(),
            numbers: HashMap::default(),
            sums: HashMap::default(),
            known: HashMap::default(),
        }
    }

    fn atom(&mut self, expr: Expr) -> usize {
        let atoms = &mut self.atoms;
        *self.numbers.entry(expr).or_insert_with_key(|expr| {
            atoms.push(expr.clone());
            atoms.len() - 1
        })
    }

    /// The expression over the denominators of its parts.
    pub(super) fn fraction(&mut self, expr: &Expr) -> Option<Fraction> {
        let mut numerator = self.polynomial(expr)?;
        let mut divisors = Vec::new();
        // The sums that a denominator is made of contain no such sums themselves: once is enough for each.
        while let Some((atom, exponent)) = self.deepest_divisor(&numerator) {
            let sum = self.sums.get(&atom)?.clone();
            let power = (-exponent).numer().to_u32()?;
            let mut cleared = Polynomial::default();
            for (monomial, coefficient) in numerator.terms() {
                let missing = monomial.exponent(atom) + power;
                let mut rest = monomial.clone();
                rest.multiply(atom, &-monomial.exponent(atom));
                let factor = sum.to_the(missing.numer().to_u32()?)?;
                cleared = cleared.sum(&factor.scaled(&rest, coefficient))?;
            }
            divisors.extend(std::iter::repeat_n(sum, power as usize));
            numerator = cleared;
        }
        Some(Fraction {
            numerator,
            divisors,
        })
    }

    /// An atom for a sum with a negative integer exponent, and its least exponent; the last one made first,
    /// since others may be inside its sum.
    fn deepest_divisor(&self, polynomial: &Polynomial) -> Option<(usize, Rational)> {
        polynomial
            .terms()
            .flat_map(|(monomial, _)| monomial.exponents())
            .filter(|(atom, exponent)| {
                self.sums.contains_key(atom) && **exponent < 0 && *exponent.denom() == 1
            })
            .max_by(|(a, p), (b, q)| a.cmp(b).then_with(|| q.cmp(p)))
            .map(|(atom, exponent)| (atom, exponent.clone()))
    }

    fn polynomial(&mut self, expr: &Expr) -> Option<Polynomial> {
        if let Some(known) = self.known.get(expr) {
            return Some(known.clone());
        }
        let polynomial = self.compute(expr)?;
        self.known.insert(expr.clone(), polynomial.clone());
        Some(polynomial)
    }

    fn compute(&mut self, expr: &Expr) -> Option<Polynomial> {
        match expr.kind() {
            Kind::Number(q) => Some(Polynomial::constant(q)),
            Kind::Sum(terms) => {
                let mut sum = Polynomial::default();
                for term in terms {
                    let term = self.polynomial(term)?;
                    sum = sum.sum(&term)?;
                }
                Some(sum)
            }
            Kind::Product(factors) => {
                let mut product = Polynomial::one();
                for factor in factors {
                    let factor = self.polynomial(factor)?;
                    product = product.product(&factor)?;
                }
                Some(product)
            }
            Kind::Power(base, exponent) => self.power(base, exponent),
            Kind::Call(function, argument) => self.call(*function, argument),
            Kind::Pi | Kind::Symbol(_) => Some(self.opaque(expr.clone())),
            Kind::Min(..) | Kind::Max(..) | Kind::Piecewise(..) => {
                let parts: Option<Vec<Expr>> = expr
                    .parts()
                    .into_iter()
                    .map(|part| self.normal(part))
                    .collect();
                Some(self.opaque(expr.with_parts(&parts?)))
            }
        }
    }

    fn opaque(&mut self, expr: Expr) -> Polynomial {
        let atom = self.atom(expr);
        Polynomial::monomial(Monomial::power(atom, &Rational::from(1)))
    }

    /// The expression as its polynomial is written, so that equal ones look equal.
    fn normal(&mut self, expr: &Expr) -> Option<Expr> {
        let polynomial = self.polynomial(expr)?;
        Some(self.expr(&polynomial))
    }

    fn power(&mut self, base: &Expr, exponent: &Rational) -> Option<Polynomial> {
        let polynomial = self.polynomial(base)?;
        let integer = *exponent.denom() == 1;
        if integer && *exponent >= 0 {
            return match polynomial.single() {
                Some(_) => Some(raise(&polynomial, exponent)),
                None => polynomial.to_the(exponent.numer().to_u32()?),
            };
        }
        if polynomial.is_zero() {
            return None;
        }
        if integer && polynomial.single().is_some() {
            return Some(raise(&polynomial, exponent));
        }
        if !integer && let Some((monomial, coefficient)) = polynomial.single() {
            // √x·√x = x where it exists; √(x²) is another thing.
            let mut exponents = monomial.exponents();
            if let (Some((_, first)), None) = (exponents.next(), exponents.next())
                && *first == 1
                && *coefficient == 1
            {
                return Some(Polynomial::monomial(monomial.to_the(exponent)));
            }
        }
        if integer {
            // The sum without what all its terms share, which is a power by itself.
            let (content, rest) = polynomial.split_content();
            let expr = self.expr(&rest);
            let atom = self.atom(expr);
            self.sums.insert(atom, rest);
            let power = Monomial::power(atom, exponent);
            return Some(Polynomial::monomial(
                power.product(&content.to_the(exponent)),
            ));
        }
        let expr = self.expr(&polynomial);
        let atom = self.atom(expr);
        Some(Polynomial::monomial(Monomial::power(atom, exponent)))
    }

    fn call(&mut self, function: Function, argument: &Expr) -> Option<Polynomial> {
        let polynomial = self.polynomial(argument)?;
        if function == Function::Exp {
            // e^(Σ q·m) = ∏ (e^m)^q
            let mut product = Monomial::default();
            for (monomial, coefficient) in polynomial.terms() {
                let exponent = self.expr(&Polynomial::monomial(monomial.clone()));
                let atom = self.atom(exponent.exp());
                product.multiply(atom, coefficient);
            }
            return Some(Polynomial::monomial(product));
        }
        // The sign of odd and even functions' arguments is that of the leading coefficient.
        let negative = polynomial.leading().is_some_and(|(_, c)| *c < 0);
        let minus_one = Rational::from(-1);
        let opposite = polynomial.scaled(&Monomial::default(), &minus_one);
        let (argument, sign) = match function {
            Function::Ln | Function::Exp => (polynomial, 1),
            Function::Cos | Function::Cosh | Function::Abs if negative => (opposite, 1),
            _ if negative => (opposite, -1),
            _ => (polynomial, 1),
        };
        let argument = self.expr(&argument);
        let value = self.opaque(argument.call(function));
        Some(value.scaled(&Monomial::default(), &Rational::from(sign)))
    }

    /// The polynomial written out, highest powers of the last atom first.
    pub(super) fn expr(&self, polynomial: &Polynomial) -> Expr {
        Expr::sum(polynomial.terms().map(|(monomial, coefficient)| {
            let mut factors = vec![Expr::number(coefficient.clone())];
            let mut exponent_of_e = Vec::new();
            for (atom, exponent) in monomial.exponents() {
                match self.atoms.get(atom).map(|atom| (atom, atom.kind())) {
                    Some((_, Kind::Call(Function::Exp, argument))) => {
                        exponent_of_e.push(Expr::number(exponent.clone()) * argument.clone());
                    }
                    Some((atom, _)) => factors.push(atom.pow(exponent.clone())),
                    None => {}
                }
            }
            if !exponent_of_e.is_empty() {
                factors.push(Expr::sum(exponent_of_e).exp());
            }
            Expr::product(factors)
        }))
    }
}

/// A single term to an integer power.
fn raise(polynomial: &Polynomial, exponent: &Rational) -> Polynomial {
    let Some((monomial, coefficient)) = polynomial.single() else {
        return polynomial.clone();
    };
    let Some(exponent_small) = exponent.numer().to_i32() else {
        return polynomial.clone();
    };
    let coefficient = rug::ops::Pow::pow(coefficient.clone(), exponent_small);
    Polynomial::monomial(monomial.to_the(exponent)).scaled(&Monomial::default(), &coefficient)
}
