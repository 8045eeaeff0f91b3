//! Rational powers of what isn't negative.

use super::arena::{Arena, Atom, AtomId, Factor, Monomial, PolynomialId, Result, Stop};
use super::coefficient::Coefficient;
use super::polynomial::{MonomialId, Polynomial};
use super::ratio::Ratio;

/// A real term taken apart: ±number · exp(exponent) · ∏ positive · ∏ others.
pub(super) struct RealTerm {
    pub(super) negative: bool,
    pub(super) number: Ratio,
    pub(super) exponent: PolynomialId,
    pub(super) positive: Vec<Factor>,
    pub(super) others: Vec<Factor>,
}

impl Arena {
    /// pᵉ, p ≥ 0 unless e is an integer, p ≠ 0 if e < 0.
    pub(super) fn power(&mut self, p: &Polynomial, e: &Ratio) -> Result<Polynomial> {
        if e.is_integer() {
            return self.integer_power(p, e);
        }
        let p = self.simplest(p)?;
        if let [(monomial, c)] = p.terms()
            && let Some(term) = self.real_term(*monomial, c)?
        {
            return self.power_of_term(&term, e);
        }
        let content = p.content();
        let primitive = p.scale(&inverse_number(&content)?);
        let radicand = self.representative(primitive)?;
        if radicand == PolynomialId::ZERO {
            return if e.is_negative() {
                Err(Stop::DivisionByZero)
            } else {
                Ok(Polynomial::default())
            };
        }
        let radical = self.radical(radicand, e)?;
        let number = self.power_of_number(&content, e)?;
        self.multiply(&radical, &number)
    }

    /// The power of a term: (ab)ᵉ = aᵉbᵉ for a > 0.
    fn power_of_term(&mut self, term: &RealTerm, e: &Ratio) -> Result<Polynomial> {
        let exponent = self
            .polynomial(term.exponent)
            .scale(&Coefficient::real(e.clone()));
        let exponential = self.assemble(&exponent, Vec::new())?;
        let number = self.power_of_number(&term.number, e)?;
        let mut result = self.multiply(&exponential, &number)?;
        for (atom, k) in &term.positive {
            let power = self.power_of_atom(*atom, &k.mul(e))?;
            result = self.multiply(&result, &power)?;
        }
        let others = self.power_of_others(term, e)?;
        self.multiply(&result, &others)
    }

    /// The power of what may have either sign by itself, its product being ≥ 0.
    fn power_of_others(&mut self, term: &RealTerm, e: &Ratio) -> Result<Polynomial> {
        if !term.negative {
            let mut none_negative = true;
            for (atom, _) in &term.others {
                none_negative &= self.is_nonnegative(*atom);
            }
            if none_negative {
                let mut result = Polynomial::one();
                for (atom, k) in &term.others {
                    let power = self.power_of_atom(*atom, &k.mul(e))?;
                    result = self.multiply(&result, &power)?;
                }
                return Ok(result);
            }
            if let [(atom, k)] = &term.others[..]
                && self.is_real_atom(*atom)?
            {
                // aᵏ ≥ 0 for odd k: so is a. For even k, aᵏ = |a|ᵏ.
                if !k.is_even() {
                    return self.power_of_atom(*atom, &k.mul(e));
                }
                if let Some(abs) = self.abs_of_atom(*atom)? {
                    return self.power_of_atom(abs, &k.mul(e));
                }
            }
        }
        let radicand = self.signed_product(term)?;
        if radicand.is_one() {
            return Ok(radicand);
        }
        let radicand = self.representative(radicand)?;
        if radicand == PolynomialId::ZERO {
            return Err(Stop::DivisionByZero);
        }
        self.radical(radicand, e)
    }

    /// |a| of an atom that may have either sign, if it is an atom.
    fn abs_of_atom(&mut self, atom: AtomId) -> Result<Option<AtomId>> {
        if self.is_inverse(atom) {
            return Ok(None);
        }
        let argument = self.raised(atom, &Ratio::ONE)?;
        let argument = self.polynomial_id(argument)?;
        Ok(Some(self.atom_id(Atom::Abs(argument))?))
    }

    /// ± the product of the factors that aren't positive.
    pub(super) fn signed_product(&mut self, term: &RealTerm) -> Result<Polynomial> {
        let product = self.assemble(&Polynomial::default(), term.others.clone())?;
        Ok(if term.negative {
            product.neg()
        } else {
            product
        })
    }

    /// aᵉ for an atom a ≥ 0, or an integer e.
    fn power_of_atom(&mut self, atom: AtomId, e: &Ratio) -> Result<Polynomial> {
        match *self.atom(atom) {
            Atom::Inverse(base) => {
                let base = self.polynomial(base);
                self.power(&base, &e.neg())
            }
            Atom::Radical(_) => self.raised(atom, e),
            _ if e.is_integer() => self.raised(atom, e),
            _ => {
                let base = self.raised(atom, &Ratio::ONE)?;
                let base = self.polynomial_id(base)?;
                self.radical(base, e)
            }
        }
    }

    fn radical(&mut self, base: PolynomialId, e: &Ratio) -> Result<Polynomial> {
        let radical = self.atom_id(Atom::Radical(base))?;
        self.raised(radical, e)
    }

    /// An atom to a power that it may have.
    pub(super) fn raised(&mut self, atom: AtomId, e: &Ratio) -> Result<Polynomial> {
        self.assemble(&Polynomial::default(), vec![(atom, e.clone())])
    }

    /// The term taken apart, if it is real by its form.
    pub(super) fn real_term(
        &mut self,
        monomial: MonomialId,
        c: &Coefficient,
    ) -> Result<Option<RealTerm>> {
        let Monomial { exponent, factors } = (*self.monomial(monomial)).clone();
        let exponent_polynomial = self.polynomial(exponent);
        if !c.is_real() || !self.is_real(&exponent_polynomial)? {
            return Ok(None);
        }
        let (positive, others) = factors
            .into_iter()
            .partition(|(atom, _)| self.is_positive(*atom));
        Ok(Some(RealTerm {
            negative: c.re.is_negative(),
            number: c.re.abs(),
            exponent,
            positive,
            others,
        }))
    }

    /// Whether the atom is greater than 0 wherever the expression is defined.
    fn is_positive(&self, atom: AtomId) -> bool {
        match *self.atom(atom) {
            Atom::Pi => true,
            Atom::Radical(base) => {
                let base = self.polynomial(base);
                base.as_constant().is_some_and(Coefficient::is_positive)
            }
            _ => false,
        }
    }

    /// Whether the atom is nowhere less than 0.
    pub(super) fn is_nonnegative(&self, atom: AtomId) -> bool {
        matches!(*self.atom(atom), Atom::Pi | Atom::Radical(_) | Atom::Abs(_))
    }
}

/// 1/q.
pub(super) fn inverse_number(q: &Ratio) -> Result<Coefficient> {
    Ok(Coefficient::real(q.recip().ok_or(Stop::DivisionByZero)?))
}
