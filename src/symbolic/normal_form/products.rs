//! Sums, products and powers of polynomials.

use super::Stop;
use super::arena::{Arena, Atom, AtomKind, Factors, Monomial, Polynomial};
use super::coefficient::Coefficient;
use std::collections::HashMap;

impl Arena {
    pub(super) fn sum(&mut self, a: Polynomial, b: Polynomial) -> Polynomial {
        if a == self.zero {
            return b;
        }
        if b == self.zero {
            return a;
        }
        let (a, b) = (self.terms(a), self.terms(b));
        self.sum_of(a.iter().chain(b.iter()).cloned())
    }

    pub(super) fn scaled(&mut self, a: Polynomial, factor: &Coefficient) -> Polynomial {
        if factor.is_one() {
            return a;
        }
        let terms = self.terms(a);
        self.sum_of(terms.iter().map(|(m, c)| (*m, c.times(factor))))
    }

    pub(super) fn product(&mut self, a: Polynomial, b: Polynomial) -> Result<Polynomial, Stop> {
        if a == self.one {
            return Ok(b);
        }
        if b == self.one {
            return Ok(a);
        }
        let (a, b) = (self.terms(a), self.terms(b));
        self.work(a.len().saturating_mul(b.len()))?;
        let mut sums: HashMap<Monomial, Coefficient> = HashMap::new();
        for (m, c) in a.iter() {
            for (n, d) in b.iter() {
                let coefficient = c.times(d);
                let product = self.monomial_product(*m, *n)?;
                let product = self.terms(product);
                for (monomial, factor) in product.iter() {
                    let term = if factor.is_one() {
                        coefficient.clone()
                    } else {
                        coefficient.times(factor)
                    };
                    sums.entry(*monomial).or_default().add(&term);
                }
            }
        }
        Ok(self.collected(sums))
    }

    /// The product of two monomials: one again, but for roots and divisors that come to whole powers.
    fn monomial_product(&mut self, m: Monomial, n: Monomial) -> Result<Polynomial, Stop> {
        let key = (m.min(n), m.max(n));
        if let Some(&product) = self.products.get(&key) {
            return Ok(product);
        }
        let (a, b) = (self.factors(m), self.factors(n));
        let exponent = self.sum(a.exponent, b.exponent);
        let powers = merged(&a.powers, &b.powers)?;
        let product = self.normal_monomial(exponent, powers)?;
        self.products.insert(key, product);
        Ok(product)
    }

    /// e^exponent times powers of atoms, with roots in their range and no positive power of a divisor.
    pub(super) fn normal_monomial(
        &mut self,
        exponent: Polynomial,
        powers: Vec<(Atom, i32)>,
    ) -> Result<Polynomial, Stop> {
        let mut kept = Vec::with_capacity(powers.len());
        let mut factors = Vec::new();
        for (atom, power) in powers {
            match *self.kind(atom) {
                AtomKind::Divisor(sum) if power > 0 => factors.push((sum, power)),
                AtomKind::Root(base, degree) => {
                    let degree = i32::try_from(degree).map_err(|_| Stop::TooLarge)?;
                    let (whole, rest) = (power.div_euclid(degree), power.rem_euclid(degree));
                    if whole != 0 {
                        factors.push((base, whole));
                    }
                    if rest != 0 {
                        kept.push((atom, rest));
                    }
                }
                _ if power == 0 => {}
                _ => kept.push((atom, power)),
            }
        }
        let monomial = self.monomial(Factors {
            exponent,
            powers: kept,
        });
        let mut product = self.sum_of([(monomial, Coefficient::real(1))]);
        for (base, power) in factors {
            let factor = self.power(base, power)?;
            product = self.product(product, factor)?;
        }
        Ok(product)
    }

    /// An integer power.
    pub(super) fn power(&mut self, base: Polynomial, exponent: i32) -> Result<Polynomial, Stop> {
        if exponent < 0 {
            let inverse = self.inverse(base)?;
            return self.power(inverse, exponent.checked_neg().ok_or(Stop::TooLarge)?);
        }
        if let Some((monomial, coefficient)) = self.single(base)
            && exponent > 1
        {
            return self.power_of_term(monomial, &coefficient, exponent);
        }
        let mut result = self.one;
        for _ in 0..exponent {
            // One factor more at a time costs less than squaring: sparse squares fill up.
            result = self.product(result, base)?;
        }
        Ok(result)
    }

    fn power_of_term(
        &mut self,
        monomial: Monomial,
        coefficient: &Coefficient,
        exponent: i32,
    ) -> Result<Polynomial, Stop> {
        self.work(exponent.unsigned_abs() as usize)?;
        let mut power = Coefficient::real(1);
        for _ in 0..exponent {
            power = power.times(coefficient);
        }
        let factors = self.factors(monomial);
        let scale = Coefficient::real(exponent);
        let of_e = self.scaled(factors.exponent, &scale);
        let powers: Option<Vec<(Atom, i32)>> = factors
            .powers
            .iter()
            .map(|(atom, k)| Some((*atom, k.checked_mul(exponent)?)))
            .collect();
        let result = self.normal_monomial(of_e, powers.ok_or(Stop::TooLarge)?)?;
        Ok(self.scaled(result, &power))
    }

    /// The polynomial times the least product of divisors that leaves none in it.
    pub(super) fn without_divisors(&mut self, polynomial: Polynomial) -> Result<Polynomial, Stop> {
        let mut current = polynomial;
        // The last divisor made first: the others may be in it.
        while let Some((atom, sum, power)) = self.last_divisor(current) {
            let mut by_power: HashMap<i32, Vec<(Monomial, Coefficient)>> = HashMap::new();
            for (monomial, coefficient) in self.terms(current).iter() {
                let mut factors = (*self.factors(*monomial)).clone();
                let place = factors.powers.iter().position(|(a, _)| *a == atom);
                let own = place.map_or(0, |place| factors.powers.remove(place).1);
                let rest = self.monomial(factors);
                let missing = own.checked_sub(power).ok_or(Stop::TooLarge)?;
                by_power
                    .entry(missing)
                    .or_default()
                    .push((rest, coefficient.clone()));
            }
            let mut cleared = self.zero;
            for (missing, terms) in by_power {
                let rest = self.sum_of(terms);
                let factor = self.power(sum, missing)?;
                let part = self.product(rest, factor)?;
                cleared = self.sum(cleared, part);
            }
            current = cleared;
        }
        Ok(current)
    }

    /// The divisor of the greatest place in the polynomial, what it is, and its least power.
    fn last_divisor(&self, polynomial: Polynomial) -> Option<(Atom, Polynomial, i32)> {
        let mut last: Option<(Atom, Polynomial, i32)> = None;
        for (monomial, _) in self.terms(polynomial).iter() {
            for &(atom, power) in &self.factors(*monomial).powers {
                let AtomKind::Divisor(sum) = *self.kind(atom) else {
                    continue;
                };
                match &mut last {
                    Some((known, _, least)) if *known == atom => *least = power.min(*least),
                    Some((known, ..)) if *known > atom => {}
                    _ => last = Some((atom, sum, power)),
                }
            }
        }
        last
    }
}

/// Powers of atoms multiplied; both are sorted, and so is the result.
fn merged(a: &[(Atom, i32)], b: &[(Atom, i32)]) -> Result<Vec<(Atom, i32)>, Stop> {
    let mut result = Vec::with_capacity(a.len() + b.len());
    let (mut a, mut b) = (a.iter().peekable(), b.iter().peekable());
    loop {
        let next = match (a.peek(), b.peek()) {
            (Some((x, p)), Some((y, q))) if x == y => {
                let sum = p.checked_add(*q).ok_or(Stop::TooLarge)?;
                let both = (*x, sum);
                a.next();
                b.next();
                both
            }
            (Some((x, _)), Some((y, _))) if x > y => *b.next().unwrap_or(&(*y, 0)),
            (Some(first), _) => {
                let first = **first;
                a.next();
                first
            }
            (None, Some(second)) => {
                let second = **second;
                b.next();
                second
            }
            (None, None) => return Ok(result),
        };
        if next.1 != 0 {
            result.push(next);
        }
    }
}
