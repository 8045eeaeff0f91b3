//! Functions that are atoms: logarithm, absolute value, arc tangent, error function.

use super::arena::{Arena, Atom, PolynomialId, Result, Stop};
use super::coefficient::Coefficient;
use super::polynomial::Polynomial;
use super::power::{RealTerm, inverse_number};
use super::ratio::Ratio;

impl Arena {
    /// ln p, p > 0.
    ///
    /// Only what is positive by itself is split off: ln(ab) is not ln a + ln b where both are negative.
    pub(super) fn ln(&mut self, p: &Polynomial) -> Result<Polynomial> {
        let p = self.simplest(p)?;
        if let [(monomial, c)] = p.terms()
            && let Some(term) = self.real_term(*monomial, c)?
        {
            return self.ln_of_term(term);
        }
        let content = p.content();
        let primitive = p.scale(&inverse_number(&content)?);
        let argument = self.representative(primitive)?;
        if argument == PolynomialId::ZERO {
            return Err(Stop::DivisionByZero);
        }
        let ln = self.of_atom(Atom::Ln(argument))?;
        Ok(self.ln_of_number(&content)?.add(&ln))
    }

    fn ln_of_term(&mut self, mut term: RealTerm) -> Result<Polynomial> {
        let exponent = self.polynomial(term.exponent);
        let mut sum = self.ln_of_number(&term.number)?.add(&exponent);
        // The product is positive, so no factor is 0: those that are never negative are positive, too.
        let (mut positive, others): (Vec<_>, Vec<_>) = std::mem::take(&mut term.others)
            .into_iter()
            .partition(|(atom, _)| self.is_nonnegative(*atom));
        term.others = others;
        positive.append(&mut term.positive);
        if let [(atom, k)] = &term.others[..]
            && !term.negative
            && !k.is_even()
            && self.is_real_atom(*atom)?
        {
            positive.append(&mut term.others);
        }
        for (atom, k) in positive {
            let (ln, k) = match *self.atom(atom) {
                Atom::Radical(base) => (self.ln_of(base)?, k),
                Atom::Inverse(base) => (self.ln_of(base)?, k.neg()),
                _ => {
                    let atom = self.raised(atom, &Ratio::ONE)?;
                    let atom = self.polynomial_id(atom)?;
                    (self.of_atom(Atom::Ln(atom))?, k)
                }
            };
            sum = sum.add(&ln.scale(&Coefficient::real(k)));
        }
        let rest = self.signed_product(&term)?;
        if rest.is_one() {
            return Ok(sum);
        }
        let rest = self.representative(rest)?;
        Ok(sum.add(&self.of_atom(Atom::Ln(rest))?))
    }

    fn ln_of(&mut self, base: PolynomialId) -> Result<Polynomial> {
        let base = self.polynomial(base);
        self.ln(&base)
    }

    /// |p| for a real p: of a product the product.
    pub(super) fn abs(&mut self, p: &Polynomial) -> Result<Polynomial> {
        let p = self.simplest(p)?;
        if let [(monomial, c)] = p.terms()
            && let Some(term) = self.real_term(*monomial, c)?
            && let Some(abs) = self.abs_of_term(&term)?
        {
            return Ok(abs);
        }
        let content = p.content();
        let primitive = p.scale(&inverse_number(&content)?);
        let (_, argument) = self.up_to_sign(primitive)?;
        if argument == PolynomialId::ZERO {
            return Ok(Polynomial::default());
        }
        let abs = self.of_atom(Atom::Abs(argument))?;
        Ok(abs.scale(&Coefficient::real(content)))
    }

    fn abs_of_term(&mut self, term: &RealTerm) -> Result<Option<Polynomial>> {
        let exponent = self.polynomial(term.exponent);
        let result = self.assemble(&exponent, term.positive.clone())?;
        let mut result = result.scale(&Coefficient::real(term.number.clone()));
        for (atom, k) in &term.others {
            if !self.is_real_atom(*atom)? {
                return Ok(None);
            }
            let factor = if self.is_nonnegative(*atom) {
                self.raised(*atom, k)?
            } else {
                let abs = if let Atom::Inverse(base) = *self.atom(*atom) {
                    let base = self.polynomial(base);
                    let abs = self.abs(&base)?;
                    self.recip(&abs)?
                } else {
                    let argument = self.raised(*atom, &Ratio::ONE)?;
                    let argument = self.polynomial_id(argument)?;
                    self.of_atom(Atom::Abs(argument))?
                };
                self.integer_power(&abs, k)?
            };
            result = self.multiply(&result, &factor)?;
        }
        Ok(Some(result))
    }

    /// An odd function's value, `atom` of its argument: f(−p) = −f(p).
    pub(super) fn odd(
        &mut self,
        p: &Polynomial,
        atom: impl FnOnce(PolynomialId) -> Atom,
    ) -> Result<Polynomial> {
        let (negative, argument) = self.up_to_sign(p.clone())?;
        if argument == PolynomialId::ZERO {
            return Ok(Polynomial::default());
        }
        let value = self.of_atom(atom(argument))?;
        Ok(if negative { value.neg() } else { value })
    }

    /// The one of p and −p that stands for both, and whether it is −p.
    fn up_to_sign(&mut self, p: Polynomial) -> Result<(bool, PolynomialId)> {
        let opposite = self.representative(p.neg())?;
        let same = self.representative(p)?;
        Ok((opposite < same, opposite.min(same)))
    }
}
