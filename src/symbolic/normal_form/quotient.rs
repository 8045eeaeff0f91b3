//! Inverses, and how they are cleared.

use super::arena::{Arena, Atom, AtomId, Factor, Monomial, PolynomialId, Result, Stop};
use super::coefficient::Coefficient;
use super::multiply::{merge, small};
use super::polynomial::{Accumulator, MonomialId, Polynomial};
use super::ratio::Ratio;
use std::cmp::Ordering;
use std::rc::Rc;

impl Arena {
    /// 1/p.
    ///
    /// A sum is written N/D without inverses first, then N as coefficient · monomial · monic sum, so that
    /// multiples of one sum have one inverse.
    pub(super) fn recip(&mut self, p: &Polynomial) -> Result<Polynomial> {
        if let [(monomial, c)] = p.terms() {
            return self.recip_of_term(*monomial, c);
        }
        let (numerator, denominator) = self.clear(p)?;
        let inverse = match numerator.terms() {
            [(monomial, c)] => self.recip_of_term(*monomial, c)?,
            _ => self.recip_of_sum(&numerator)?,
        };
        self.multiply(&inverse, &denominator)
    }

    fn recip_of_term(&mut self, monomial: MonomialId, c: &Coefficient) -> Result<Polynomial> {
        let monomial = self.monomial(monomial);
        let exponent = self.polynomial(monomial.exponent).neg();
        let inverse = self.assemble(&exponent, negated(&monomial.factors))?;
        Ok(inverse.scale(&c.recip().ok_or(Stop::DivisionByZero)?))
    }

    /// 1/p for a sum without inverses.
    fn recip_of_sum(&mut self, p: &Polynomial) -> Result<Polynomial> {
        let Some((inverse_monomial, rest)) = self.without_monomial(p)? else {
            return Err(Stop::DivisionByZero);
        };
        // Angles and radicals may have simplified on the way.
        let [_, .., (_, leading)] = rest.terms() else {
            let [(monomial, c)] = rest.terms() else {
                return Err(Stop::DivisionByZero);
            };
            let inverse = self.recip_of_term(*monomial, c)?;
            return self.multiply(&inverse, &inverse_monomial);
        };
        let scale = leading.recip().ok_or(Stop::DivisionByZero)?;
        let monic = self.polynomial_id(rest.scale(&scale))?;
        let inverse = self.of_atom(Atom::Inverse(monic))?;
        let inverse = self.multiply(&inverse, &inverse_monomial)?;
        Ok(inverse.scale(&scale))
    }

    /// 1/m and p/m for the monomial m of the least powers and the least exponent in p.
    fn without_monomial(&mut self, p: &Polynomial) -> Result<Option<(Polynomial, Polynomial)>> {
        let monomials: Vec<Rc<Monomial>> =
            p.terms().iter().map(|(m, _)| self.monomial(*m)).collect();
        let Some((first, others)) = monomials.split_first() else {
            return Ok(None);
        };
        let mut exponent = first.exponent;
        let mut factors = first.factors.clone();
        for other in others {
            factors = least(&factors, &other.factors);
            if other.exponent != exponent {
                let difference = self
                    .polynomial(other.exponent)
                    .sub(&self.polynomial(exponent));
                if difference.sign() == Ordering::Less {
                    exponent = other.exponent;
                }
            }
        }
        let exponent = self.polynomial(exponent);
        let factors = negated(&factors);
        let mut rest = Accumulator::default();
        for (monomial, (_, c)) in monomials.iter().zip(p.terms()) {
            self.spend(1)?;
            let difference = self.polynomial(monomial.exponent).sub(&exponent);
            let quotient = self.assemble(&difference, merge(&monomial.factors, &factors))?;
            rest.add_scaled(&quotient, c);
        }
        let inverse = self.assemble(&exponent.neg(), factors)?;
        Ok(Some((inverse, rest.finish())))
    }

    /// Polynomials N and D with p = N/D, N without inverses: p is 0 where N is.
    pub(super) fn clear(&mut self, p: &Polynomial) -> Result<(Polynomial, Polynomial)> {
        let mut numerator = p.clone();
        let mut denominator = Polynomial::one();
        // Radicals that come out in a step only bring inverses that are older, with lower places.
        while let Some((atom, power, base)) = self.last_inverse(&numerator) {
            let power = small(&power)?;
            let base = self.polynomial(base);
            numerator = self.clear_one(&numerator, atom, power, &base)?;
            for _ in 0..power {
                denominator = self.multiply(&denominator, &base)?;
            }
        }
        Ok((numerator, denominator))
    }

    /// The youngest inverse in p, its greatest power, and what it is the inverse of.
    fn last_inverse(&self, p: &Polynomial) -> Option<(AtomId, Ratio, PolynomialId)> {
        let mut found: Option<(AtomId, Ratio, PolynomialId)> = None;
        for (monomial, _) in p.terms() {
            for (atom, power) in &self.monomial(*monomial).factors {
                if let Atom::Inverse(base) = *self.atom(*atom)
                    && found
                        .as_ref()
                        .is_none_or(|(old, most, _)| (old, most) < (atom, power))
                {
                    found = Some((*atom, power.clone(), base));
                }
            }
        }
        found
    }

    /// p · baseᵏ for k = `power`, where `atom` is 1/base, by Horner's rule.
    fn clear_one(
        &mut self,
        p: &Polynomial,
        atom: AtomId,
        power: i64,
        base: &Polynomial,
    ) -> Result<Polynomial> {
        let mut by_power: Vec<Accumulator> = (0..=power).map(|_| Accumulator::default()).collect();
        for (id, c) in p.terms() {
            let mut monomial = (*self.monomial(*id)).clone();
            let mut k = 0;
            if let Some(at) = monomial.factors.iter().position(|(a, _)| *a == atom) {
                k = small(&monomial.factors.remove(at).1)?;
            }
            let id = if k == 0 {
                *id
            } else {
                self.monomial_id(monomial)?
            };
            if let Some(sum) = usize::try_from(k).ok().and_then(|k| by_power.get_mut(k)) {
                sum.add(id, c.clone());
            }
        }
        let mut result = Polynomial::default();
        for sum in by_power {
            result = self.multiply(&result, base)?.add(&sum.finish());
            Arena::check_terms(result.len())?;
        }
        Ok(result)
    }

    fn has_inverses(&self, p: &Polynomial) -> bool {
        p.terms().iter().any(|(monomial, _)| {
            let monomial = self.monomial(*monomial);
            monomial
                .factors
                .iter()
                .any(|(atom, _)| self.is_inverse(*atom))
        })
    }

    /// A sum as the polynomial that stands for it, a single term as it is.
    pub(super) fn simplest(&mut self, p: &Polynomial) -> Result<Rc<Polynomial>> {
        if p.len() < 2 {
            return Ok(Rc::new(p.clone()));
        }
        let id = self.representative(p.clone())?;
        Ok(self.polynomial(id))
    }

    /// The polynomial without inverses that p is, if one is found.
    fn without_inverses(&mut self, p: &Polynomial) -> Result<Option<Polynomial>> {
        if self.keeps_an_inverse(p) {
            return Ok(None);
        }
        let (numerator, denominator) = self.clear(p)?;
        let quotient = self.exact_quotient(&numerator, &denominator)?;
        Ok(quotient.filter(|quotient| !self.has_inverses(quotient)))
    }

    /// Whether the greatest power of the youngest inverse has a single term: no sum divides that, so p is
    /// nothing simpler.
    fn keeps_an_inverse(&self, p: &Polynomial) -> bool {
        let Some((atom, power, _)) = self.last_inverse(p) else {
            return false;
        };
        let factor = (atom, power);
        let with_it = p
            .terms()
            .iter()
            .filter(|(monomial, _)| self.monomial(*monomial).factors.contains(&factor));
        with_it.count() == 1
    }

    /// The polynomial that stands for all that equal p once inverses are cleared: x/(1+x) is 1 − 1/(1+x).
    pub(super) fn representative(&mut self, p: Polynomial) -> Result<PolynomialId> {
        if !self.has_inverses(&p) {
            return self.polynomial_id(p);
        }
        let id = self.polynomial_id(p.clone())?;
        if let Some(known) = self.quotients.get(&id) {
            return Ok(*known);
        }
        if let Some(quotient) = self.without_inverses(&p)? {
            let quotient = self.polynomial_id(quotient)?;
            self.quotients.insert(id, quotient);
            return Ok(quotient);
        }
        for candidate in self.representatives.clone() {
            let difference = p.sub(&self.polynomial(candidate));
            self.spend(difference.len() as u64)?;
            if !self.keeps_an_inverse(&difference) && self.clear(&difference)?.0.is_zero() {
                self.quotients.insert(id, candidate);
                return Ok(candidate);
            }
        }
        self.representatives.push(id);
        self.quotients.insert(id, id);
        Ok(id)
    }
}

/// Every factor to the opposite power.
pub(super) fn negated(factors: &[Factor]) -> Vec<Factor> {
    factors.iter().map(|(atom, k)| (*atom, k.neg())).collect()
}

/// Every atom to the lesser of its two powers, where one that doesn't occur has the power 0.
fn least(left: &[Factor], right: &[Factor]) -> Vec<Factor> {
    let power = |factors: &[Factor], atom: AtomId| {
        let found = factors.iter().find(|(other, _)| *other == atom);
        found.map_or(Ratio::ZERO, |(_, power)| power.clone())
    };
    merge(left, right)
        .into_iter()
        .map(|(atom, _)| (atom, power(left, atom).min(power(right, atom))))
        .filter(|(_, power)| !power.is_zero())
        .collect()
}
