//! Complex conjugates: which polynomials are seen to be real.

use super::arena::{Arena, Atom, AtomId, PolynomialId, Result};
use super::coefficient::Coefficient;
use super::polynomial::Polynomial;
use std::rc::Rc;

impl Arena {
    /// The complex conjugate of p wherever the expression is defined: all atoms but inverses are real.
    fn conjugate(&mut self, p: &Polynomial) -> Result<Polynomial> {
        let mut sum = Polynomial::default();
        for (monomial, c) in p.terms() {
            self.spend(1)?;
            let monomial = self.monomial(*monomial);
            let exponent = self.conjugate_of(monomial.exponent)?;
            let mut real = Vec::with_capacity(monomial.factors.len());
            let mut inverses = Vec::new();
            for (atom, k) in &monomial.factors {
                match *self.atom(*atom) {
                    Atom::Inverse(base) => inverses.push((base, k.clone())),
                    _ => real.push((*atom, k.clone())),
                }
            }
            let mut term = self.assemble(&exponent, real)?;
            for (base, k) in inverses {
                let base = self.conjugate_of(base)?;
                let inverse = self.integer_power(&base, &k.neg())?;
                term = self.multiply(&term, &inverse)?;
            }
            sum = sum.add(&term.scale(&c.conjugate()));
        }
        Ok(sum)
    }

    /// The conjugate of a polynomial that is kept, found once.
    fn conjugate_of(&mut self, id: PolynomialId) -> Result<Rc<Polynomial>> {
        if let Some(known) = self.conjugates.get(&id) {
            return Ok(Rc::clone(known));
        }
        let polynomial = self.polynomial(id);
        let conjugate = Rc::new(self.conjugate(&polynomial)?);
        self.conjugates.insert(id, Rc::clone(&conjugate));
        Ok(conjugate)
    }

    /// Whether p is real by its form; others may be real, too.
    pub(super) fn is_real(&mut self, p: &Polynomial) -> Result<bool> {
        Ok(p.is_zero()
            || p.as_constant().is_some_and(Coefficient::is_real)
            || self.conjugate(p)? == *p)
    }

    /// Whether the atom is real by its form.
    pub(super) fn is_real_atom(&mut self, atom: AtomId) -> Result<bool> {
        match *self.atom(atom) {
            Atom::Inverse(base) => {
                let base = self.polynomial(base);
                self.is_real(&base)
            }
            _ => Ok(true),
        }
    }
}
