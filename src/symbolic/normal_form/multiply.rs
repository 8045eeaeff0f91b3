//! Products and powers.

use super::arena::{Arena, Atom, AtomId, Factor, Monomial, PolynomialId, Product, Result, Stop};
use super::coefficient::Coefficient;
use super::polynomial::{Accumulator, MonomialId, Polynomial};
use super::ratio::Ratio;
use std::rc::Rc;

/// Sums are raised to powers up to this.
const MAX_POWER: i64 = 4096;

impl Arena {
    /// exp(exponent) · ∏ atomᵏ for any powers, integer ones but of radicals: those out of range come out as
    /// polynomials, as do parts of a turn of the exponent.
    pub(super) fn assemble(
        &mut self,
        exponent: &Polynomial,
        factors: Vec<Factor>,
    ) -> Result<Polynomial> {
        self.spend((exponent.len() + factors.len()) as u64 / 4)?;
        let mut extra = Vec::new();
        let exponent = if exponent.is_zero() {
            PolynomialId::ZERO
        } else {
            let whole = self.representative(exponent.clone())?;
            let (rest, turn) = self.split_turn(&self.polynomial(whole))?;
            if let Some(turn) = turn {
                extra.push(turn);
                self.representative(rest)?
            } else {
                whole
            }
        };
        let mut kept = Vec::with_capacity(factors.len());
        for (atom, power) in factors {
            let (inside, outside) = self.split_power(atom, power)?;
            if !inside.is_zero() {
                kept.push((atom, inside));
            }
            extra.extend(outside);
        }
        let factors = kept;
        let monomial = self.monomial_id(Monomial { exponent, factors })?;
        let mut result = Polynomial::term(monomial, Coefficient::ONE);
        for factor in extra {
            result = self.multiply(&result, &factor)?;
        }
        Ok(result)
    }

    /// The power in the range of the atom, and the rest as a polynomial: √P³ = √P·P, |P|³ = |P|·P².
    fn split_power(&mut self, atom: AtomId, power: Ratio) -> Result<(Ratio, Option<Polynomial>)> {
        let (base, outside) = match *self.atom(atom) {
            Atom::Radical(base) => (base, power.floor()),
            Atom::Abs(base) => {
                let two = Ratio::from(2);
                (base, power.mul(&Ratio::Small(1, 2)).floor().mul(&two))
            }
            Atom::Inverse(base) if power.is_negative() => {
                let base = self.polynomial(base);
                let power = self.integer_power(&base, &power.neg())?;
                return Ok((Ratio::ZERO, Some(power)));
            }
            _ => return Ok((power, None)),
        };
        if outside.is_zero() {
            return Ok((power, None));
        }
        let base = self.polynomial(base);
        let polynomial = self.integer_power(&base, &outside)?;
        Ok((power.sub(&outside), Some(polynomial)))
    }

    /// The product of two monomials, found once.
    fn product(&mut self, m: MonomialId, n: MonomialId) -> Result<Product> {
        if m == MonomialId::ONE {
            return Ok(Product::Monomial(n));
        }
        if n == MonomialId::ONE {
            return Ok(Product::Monomial(m));
        }
        let key = (m.min(n), m.max(n));
        if let Some(product) = self.products.get(&key) {
            return Ok(product.clone());
        }
        let (left, right) = (self.monomial(m), self.monomial(n));
        let exponent = self.exponent_sum(left.exponent, right.exponent);
        let factors = merge(&left.factors, &right.factors);
        let product = self.assemble(&exponent, factors)?;
        let product = match product.terms() {
            [(monomial, c)] if *c == Coefficient::ONE => Product::Monomial(*monomial),
            _ => Product::Polynomial(Rc::new(product)),
        };
        self.products.insert(key, product.clone());
        Ok(product)
    }

    fn exponent_sum(&self, a: PolynomialId, b: PolynomialId) -> Rc<Polynomial> {
        match (a, b) {
            (PolynomialId::ZERO, _) => self.polynomial(b),
            (_, PolynomialId::ZERO) => self.polynomial(a),
            _ => Rc::new(self.polynomial(a).add(&self.polynomial(b))),
        }
    }

    pub(super) fn multiply(&mut self, a: &Polynomial, b: &Polynomial) -> Result<Polynomial> {
        match (a.as_constant(), b.as_constant()) {
            (Some(c), _) => return self.scaled(b, c),
            (_, Some(c)) => return self.scaled(a, c),
            _ => {}
        }
        let mut sum = Accumulator::default();
        for (m, c) in a.terms() {
            for (n, d) in b.terms() {
                self.spend(cost(c, d))?;
                let coefficient = c.mul(d);
                match self.product(*m, *n)? {
                    Product::Monomial(monomial) => sum.add(monomial, coefficient),
                    Product::Polynomial(product) => {
                        self.spend(product.len() as u64)?;
                        sum.add_scaled(&product, &coefficient);
                    }
                }
                Arena::check_terms(sum.len())?;
            }
        }
        Ok(sum.finish())
    }

    fn scaled(&mut self, p: &Polynomial, c: &Coefficient) -> Result<Polynomial> {
        let work = p.terms().iter().map(|(_, d)| cost(c, d)).sum();
        self.spend(work)?;
        Ok(p.scale(c))
    }

    /// pᵏ for an integer k.
    pub(super) fn integer_power(&mut self, p: &Polynomial, power: &Ratio) -> Result<Polynomial> {
        if power.is_zero() {
            return Ok(Polynomial::one());
        }
        if power.is_one() {
            return Ok(p.clone());
        }
        if power.is_negative() {
            let inverse = self.recip(p)?;
            return self.integer_power(&inverse, &power.neg());
        }
        match p.terms() {
            [] => Ok(Polynomial::default()),
            [(monomial, c)] => {
                let power_of_monomial = self.power_of_monomial(*monomial, power)?;
                let power_of_c = self.power_of_coefficient(c, power)?;
                self.scaled(&power_of_monomial, &power_of_c)
            }
            _ => {
                let power = small(power)?;
                let mut result = p.clone();
                for _ in 1..power {
                    result = self.multiply(&result, p)?;
                }
                Ok(result)
            }
        }
    }

    fn power_of_monomial(&mut self, monomial: MonomialId, power: &Ratio) -> Result<Polynomial> {
        let monomial = self.monomial(monomial);
        let exponent = self.polynomial(monomial.exponent);
        let exponent = self.scaled(&exponent, &Coefficient::real(power.clone()))?;
        let factors = monomial
            .factors
            .iter()
            .map(|(atom, k)| (*atom, k.mul(power)))
            .collect();
        self.assemble(&exponent, factors)
    }

    fn power_of_coefficient(&mut self, c: &Coefficient, power: &Ratio) -> Result<Coefficient> {
        if *c == Coefficient::ONE {
            return Ok(Coefficient::ONE);
        }
        let mut power = small(power)?;
        let mut square = c.clone();
        let mut result = Coefficient::ONE;
        loop {
            if power % 2 == 1 {
                self.spend(cost(&result, &square))?;
                result = result.mul(&square);
            }
            power /= 2;
            if power == 0 {
                return Ok(result);
            }
            self.spend(cost(&square, &square))?;
            square = square.mul(&square);
        }
    }
}

/// A positive power that is small enough to be worked out.
pub(super) fn small(power: &Ratio) -> Result<i64> {
    power
        .to_integer()
        .filter(|power| *power <= MAX_POWER)
        .ok_or(Stop::TooLarge)
}

/// What a product of coefficients costs, in products of small ones.
fn cost(a: &Coefficient, b: &Coefficient) -> u64 {
    let words = a.words() + b.words();
    1 + 4 * words + words * words / 8
}

/// The factors of a product, some perhaps to the power 0.
pub(super) fn merge(left: &[Factor], right: &[Factor]) -> Vec<Factor> {
    let mut merged = Vec::with_capacity(left.len() + right.len());
    let (mut left, mut right) = (left.iter().peekable(), right.iter().peekable());
    loop {
        let next = match (left.peek(), right.peek()) {
            (None, None) => return merged,
            (Some((a, j)), Some((b, k))) if a == b => {
                merged.push((*a, j.add(k)));
                left.next();
                right.next();
                continue;
            }
            (Some((a, _)), Some((b, _))) if a < b => left.next(),
            (Some(_), None) => left.next(),
            _ => right.next(),
        };
        merged.extend(next.cloned());
    }
}
