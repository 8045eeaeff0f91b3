//! Exponentials, logarithms, roots and functions of polynomials.

use super::Stop;
use super::arena::{Arena, AtomKind, Factors, Polynomial};
use super::coefficient::Coefficient;
use super::numbers;
use crate::symbolic::Function;
use rug::Rational;

impl Arena {
    /// The polynomial that is an atom alone.
    pub(super) fn of_atom(&mut self, kind: AtomKind) -> Polynomial {
        let atom = self.atom(kind);
        let exponent = self.zero;
        let monomial = self.monomial(Factors {
            exponent,
            powers: vec![(atom, 1)],
        });
        self.sum_of([(monomial, Coefficient::real(1))])
    }

    /// e^P: multiples of logarithms become powers, and quarter turns units.
    pub(super) fn exponential(&mut self, polynomial: Polynomial) -> Result<Polynomial, Stop> {
        let mut rest = Vec::new();
        let mut product = self.one;
        for (monomial, coefficient) in self.terms(polynomial).iter() {
            let factors = self.factors(*monomial);
            let atom = match factors.powers[..] {
                [(atom, 1)] if factors.exponent == self.zero => Some(atom),
                _ => None,
            };
            match (
                atom.map(|atom| self.kind(atom).clone()),
                coefficient.as_real(),
            ) {
                (Some(AtomKind::Call(Function::Ln, argument)), Some(power)) => {
                    // The logarithm exists where its argument is positive.
                    let factor = self.rational_power(argument, power)?;
                    product = self.product(product, factor)?;
                }
                (Some(AtomKind::Symbol(None)), _) => {
                    let (turn, left) = quarter_turns(coefficient);
                    product = self.scaled(product, &turn);
                    rest.push((*monomial, left));
                }
                _ => rest.push((*monomial, coefficient.clone())),
            }
        }
        let exponent = self.sum_of(rest);
        let exponential = self.normal_monomial(exponent, Vec::new())?;
        self.product(product, exponential)
    }

    /// ln P.
    pub(super) fn logarithm(&mut self, polynomial: Polynomial) -> Result<Polynomial, Stop> {
        if polynomial == self.zero {
            return Err(Stop::Undefined);
        }
        if let Some((monomial, coefficient)) = self.single(polynomial)
            && let Some(number) = coefficient.as_real().filter(|q| **q > 0)
        {
            // P is real and positive wherever its logarithm exists, so that with c > 0 the rest is too;
            // e^E alone is real only where E is.
            let factors = self.factors(monomial);
            match factors.powers[..] {
                [] => {
                    let of_number = self.logarithm_of_number(number);
                    return Ok(self.sum(of_number, factors.exponent));
                }
                [(atom, power)] if power % 2 != 0 && factors.exponent == self.zero => {
                    // An odd power is positive where the atom is.
                    let of_number = self.logarithm_of_number(number);
                    let argument = self.normal_monomial(self.zero, vec![(atom, 1)])?;
                    let of_atom = self.of_atom(AtomKind::Call(Function::Ln, argument));
                    let of_power = self.scaled(of_atom, &Coefficient::real(power));
                    return Ok(self.sum(of_number, of_power));
                }
                _ => {}
            }
        }
        Ok(self.of_atom(AtomKind::Call(Function::Ln, polynomial)))
    }

    fn logarithm_of_number(&mut self, number: &Rational) -> Polynomial {
        let mut sum = self.zero;
        for (factor, power) in numbers::factors(number) {
            let factor = self.constant(Coefficient::real(factor));
            let of_factor = self.of_atom(AtomKind::Call(Function::Ln, factor));
            let term = self.scaled(of_factor, &Coefficient::real(power));
            sum = self.sum(sum, term);
        }
        sum
    }

    /// P^q for a rational number q; a fractional power is that of a P ≥ 0.
    pub(super) fn rational_power(
        &mut self,
        base: Polynomial,
        exponent: &Rational,
    ) -> Result<Polynomial, Stop> {
        let power = exponent.numer().to_i32().ok_or(Stop::TooLarge)?;
        let degree = exponent.denom().to_u32().ok_or(Stop::TooLarge)?;
        if degree == 1 {
            return self.power(base, power);
        }
        if base == self.zero {
            return if power > 0 {
                Ok(base)
            } else {
                Err(Stop::Undefined)
            };
        }
        let root = self.root(base, degree)?;
        self.power(root, power)
    }

    /// The root of that degree of P ≥ 0.
    fn root(&mut self, base: Polynomial, degree: u32) -> Result<Polynomial, Stop> {
        if let Some((monomial, coefficient)) = self.single(base)
            && let Some(number) = coefficient.as_real().filter(|q| **q > 0)
        {
            let factors = self.factors(monomial);
            let of_number = self.root_of_number(number, degree)?;
            let of_rest = if factors.powers.is_empty() {
                // e^E is real and positive: its root is too.
                let part = Rational::from((1, degree));
                let exponent = self.scaled(factors.exponent, &Coefficient::real(part));
                self.normal_monomial(exponent, Vec::new())?
            } else {
                let rest = self.sum_of([(monomial, Coefficient::real(1))]);
                self.of_atom(AtomKind::Root(rest, degree))
            };
            return self.product(of_number, of_rest);
        }
        // A positive factor goes before the root, the same for all multiples of a polynomial.
        let (_, leading, _) = self.split(base)?;
        let scale = leading.as_real().map(|q| q.clone().abs());
        let Some(scale) = scale.filter(|scale| *scale != 0) else {
            return Ok(self.of_atom(AtomKind::Root(base, degree)));
        };
        let rest = self.scaled(base, &Coefficient::real(Rational::from(scale.recip_ref())));
        let of_scale = self.root_of_number(&scale, degree)?;
        let of_rest = self.of_atom(AtomKind::Root(rest, degree));
        self.product(of_scale, of_rest)
    }

    fn root_of_number(&mut self, number: &Rational, degree: u32) -> Result<Polynomial, Stop> {
        let mut product = self.one;
        for (factor, power) in numbers::factors(number) {
            let base = self.constant(Coefficient::real(factor));
            let root = self.atom(AtomKind::Root(base, degree));
            let factor = self.normal_monomial(self.zero, vec![(root, power)])?;
            product = self.product(product, factor)?;
        }
        Ok(product)
    }

    /// |P| = √(P²).
    pub(super) fn absolute(&mut self, polynomial: Polynomial) -> Result<Polynomial, Stop> {
        let square = self.product(polynomial, polynomial)?;
        if square == self.zero {
            return Ok(square);
        }
        self.root(square, 2)
    }

    /// An odd function that nothing more is known of.
    pub(super) fn odd_call(&mut self, function: Function, argument: Polynomial) -> Polynomial {
        let negative = match self.terms(argument).last() {
            None => return self.zero,
            Some((_, coefficient)) => coefficient.is_negative(),
        };
        let sign = Coefficient::real(if negative { -1 } else { 1 });
        let argument = self.scaled(argument, &sign);
        let value = self.of_atom(AtomKind::Call(function, argument));
        self.scaled(value, &sign)
    }
}

/// e^(cπ) for the part of c that is a multiple of i/2, and the rest of c with an imaginary part in [0, ½).
fn quarter_turns(coefficient: &Coefficient) -> (Coefficient, Coefficient) {
    let quarters = Rational::from(&coefficient.im * 2).floor();
    let left = Coefficient {
        re: coefficient.re.clone(),
        im: &coefficient.im - Rational::from(&quarters / 2),
    };
    let turn = match quarters.numer().mod_u(4) {
        0 => Coefficient::real(1),
        1 => Coefficient::imaginary(1),
        2 => Coefficient::real(-1),
        _ => Coefficient::imaginary(-1),
    };
    (turn, left)
}
