//! Where polynomials, monomials and atoms are kept, each once, and what they may cost.

use super::coefficient::Coefficient;
use super::polynomial::{MonomialId, Polynomial};
use super::ratio::Ratio;
use super::{MAX_TERMS, MAX_WORK};
use crate::symbolic::hash::HashMap;
use std::hash::Hash;
use std::rc::Rc;
use std::sync::Arc;

/// The place of a polynomial in its arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PolynomialId(u32);

impl PolynomialId {
    /// The polynomial 0, the first of every arena.
    pub(super) const ZERO: PolynomialId = PolynomialId(0);
}

/// The place of an atom in its arena: what an atom is made of has lower places.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct AtomId(u32);

/// What isn't taken apart. All but inverses are real wherever the expression is defined.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Atom {
    /// By its name.
    Symbol(Arc<str>),
    /// π.
    Pi,
    /// Of a positive number.
    Ln(PolynomialId),
    /// erf P.
    Erf(PolynomialId),
    /// atan P.
    Atan(PolynomialId),
    /// |P|, only to the first power: |P|² = P².
    Abs(PolynomialId),
    /// P ≥ 0, to powers between 0 and 1.
    Radical(PolynomialId),
    /// 1/P for a P of at least two terms and no inverses, to positive powers.
    Inverse(PolynomialId),
}

/// An atom and the power of it, not 0.
pub(super) type Factor = (AtomId, Ratio);

/// exp(exponent) · ∏ atomᵏ, the atoms in the order of their places.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Monomial {
    /// Of the exponential.
    pub exponent: PolynomialId,
    /// Atoms and their powers.
    pub factors: Vec<Factor>,
}

/// Why there is no normal form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// A divisor is 0.
    DivisionByZero,
    /// More terms or work than the budget.
    TooLarge,
}

pub(super) type Result<T> = std::result::Result<T, Stop>;

/// Values kept once each, known by their places.
struct Interner<T> {
    values: Vec<Rc<T>>,
    places: HashMap<Rc<T>, u32>,
}

impl<T: Eq + Hash> Interner<T> {
    fn new() -> Interner<T> {
        Interner {
            values: Vec::new(),
            places: HashMap::default(),
        }
    }

    fn intern(&mut self, value: T) -> Result<u32> {
        if let Some(place) = self.places.get(&value) {
            return Ok(*place);
        }
        let place = u32::try_from(self.values.len()).map_err(|_| Stop::TooLarge)?;
        let value = Rc::new(value);
        self.values.push(Rc::clone(&value));
        self.places.insert(value, place);
        Ok(place)
    }

    /// The value at a place that `intern` gave.
    fn get(&self, place: u32) -> Rc<T> {
        Rc::clone(&self.values[place as usize])
    }
}

/// The product of two monomials.
#[derive(Clone)]
pub(super) enum Product {
    Monomial(MonomialId),
    /// Where radicals or angles come out.
    Polynomial(Rc<Polynomial>),
}

/// All that one zero test knows.
pub struct Arena {
    polynomials: Interner<Polynomial>,
    monomials: Interner<Monomial>,
    atoms: Interner<Atom>,
    pub(super) products: HashMap<(MonomialId, MonomialId), Product>,
    pub(super) conjugates: HashMap<PolynomialId, Rc<Polynomial>>,
    /// The polynomials with inverses that were seen and the one that stands for each.
    pub(super) quotients: HashMap<PolynomialId, PolynomialId>,
    /// Those that stand for others, in the order they were seen.
    pub(super) representatives: Vec<PolynomialId>,
    work: u64,
}

impl Arena {
    /// Of the polynomial 0 and the monomial 1 alone.
    ///
    /// # Errors
    /// None: there is room for both.
    pub fn new() -> Result<Arena> {
        let mut arena = Arena {
            polynomials: Interner::new(),
            monomials: Interner::new(),
            atoms: Interner::new(),
            products: HashMap::default(),
            conjugates: HashMap::default(),
            quotients: HashMap::default(),
            representatives: Vec::new(),
            work: MAX_WORK,
        };
        let exponent = arena.polynomial_id(Polynomial::default())?;
        arena.monomial_id(Monomial {
            exponent,
            factors: Vec::new(),
        })?;
        Ok(arena)
    }

    /// Takes `work` from the budget.
    pub(super) fn spend(&mut self, work: u64) -> Result<()> {
        self.work = self.work.checked_sub(work).ok_or(Stop::TooLarge)?;
        Ok(())
    }

    /// Refuses more terms than the budget.
    pub(super) fn check_terms(terms: usize) -> Result<()> {
        if terms > MAX_TERMS {
            return Err(Stop::TooLarge);
        }
        Ok(())
    }

    pub(super) fn polynomial_id(&mut self, polynomial: Polynomial) -> Result<PolynomialId> {
        Ok(PolynomialId(self.polynomials.intern(polynomial)?))
    }

    /// The polynomial of that place.
    #[must_use]
    pub fn polynomial(&self, id: PolynomialId) -> Rc<Polynomial> {
        self.polynomials.get(id.0)
    }

    /// `monomial` must be as its factors say: no power out of range.
    pub(super) fn monomial_id(&mut self, monomial: Monomial) -> Result<MonomialId> {
        Ok(MonomialId(self.monomials.intern(monomial)?))
    }

    /// The monomial of that place.
    #[must_use]
    pub fn monomial(&self, id: MonomialId) -> Rc<Monomial> {
        self.monomials.get(id.0)
    }

    pub(super) fn atom_id(&mut self, atom: Atom) -> Result<AtomId> {
        Ok(AtomId(self.atoms.intern(atom)?))
    }

    /// The atom of that place.
    #[must_use]
    pub fn atom(&self, id: AtomId) -> Rc<Atom> {
        self.atoms.get(id.0)
    }

    /// The atom itself, as a polynomial.
    pub(super) fn of_atom(&mut self, atom: Atom) -> Result<Polynomial> {
        let factors = vec![(self.atom_id(atom)?, Ratio::ONE)];
        let exponent = PolynomialId::ZERO;
        let monomial = self.monomial_id(Monomial { exponent, factors })?;
        Ok(Polynomial::term(monomial, Coefficient::ONE))
    }

    /// Whether the atom is the inverse of a polynomial.
    pub(super) fn is_inverse(&self, id: AtomId) -> bool {
        matches!(*self.atom(id), Atom::Inverse(_))
    }
}
