//! Division without remainder.

use super::arena::{Arena, Monomial, Result};
use super::multiply::merge;
use super::polynomial::{MonomialId, Polynomial, Term};
use super::quotient::negated;
use std::cmp::Ordering;

/// Quotients of more terms aren't found.
const MAX_QUOTIENT: usize = 64;

impl Arena {
    /// The polynomial q with n = q·d, if it is found.
    pub(super) fn exact_quotient(
        &mut self,
        n: &Polynomial,
        d: &Polynomial,
    ) -> Result<Option<Polynomial>> {
        let Some((divisor, c)) = self.leading(d) else {
            return Ok(None);
        };
        let (divisor, Some(c)) = (self.monomial(divisor), c.recip()) else {
            return Ok(None);
        };
        let exponent = self.polynomial(divisor.exponent);
        let factors = negated(&divisor.factors);
        let mut quotient = Polynomial::default();
        let mut rest = n.clone();
        for _ in 0..MAX_QUOTIENT {
            let Some((monomial, a)) = self.leading(&rest) else {
                return Ok(Some(quotient));
            };
            let monomial = self.monomial(monomial);
            let difference = self.polynomial(monomial.exponent).sub(&exponent);
            let term = self.assemble(&difference, merge(&monomial.factors, &factors))?;
            let term = term.scale(&a.mul(&c));
            quotient = quotient.add(&term);
            rest = rest.sub(&self.multiply(&term, d)?);
        }
        Ok(None)
    }

    /// The greatest term.
    fn leading(&self, p: &Polynomial) -> Option<Term> {
        let (first, others) = p.terms().split_first()?;
        let mut greatest = first;
        for term in others {
            if self.compare(term.0, greatest.0) == Ordering::Greater {
                greatest = term;
            }
        }
        Some(greatest.clone())
    }

    /// An order of monomials that products keep, but for those of radicals: by exponent, then by the power
    /// of the youngest atom in which they differ.
    fn compare(&self, m: MonomialId, n: MonomialId) -> Ordering {
        let (m, n): (&Monomial, &Monomial) = (&self.monomial(m), &self.monomial(n));
        let exponents = if m.exponent == n.exponent {
            Ordering::Equal
        } else {
            let difference = self
                .polynomial(m.exponent)
                .sub(&self.polynomial(n.exponent));
            difference.sign()
        };
        let powers = merge(&m.factors, &negated(&n.factors));
        let last = powers.iter().rev().find(|(_, power)| !power.is_zero());
        exponents.then(last.map_or(Ordering::Equal, |(_, power)| power.sign()))
    }
}
