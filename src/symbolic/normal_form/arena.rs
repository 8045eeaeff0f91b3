//! Polynomials, monomials and atoms, each stored once.

use super::coefficient::Coefficient;
use super::{MAX_PRODUCTS, Stop};
use crate::symbolic::{Expr, Function};
use std::collections::HashMap;
use std::hash::Hash;
use std::rc::Rc;
use std::sync::Arc;

/// A polynomial, by its place in the arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Polynomial(u32);

/// A monomial, by its place in the arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Monomial(u32);

/// An atom, by its place in the arena: what it is made of has lesser places.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Atom(u32);

/// Terms with coefficients other than 0, each monomial once, in the order of places.
pub(super) type Terms = Rc<[(Monomial, Coefficient)]>;

/// What a monomial is: e^exponent times powers other than 0 of atoms, in the order of places.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Factors {
    pub(super) exponent: Polynomial,
    pub(super) powers: Vec<(Atom, i32)>,
}

/// What an atom is.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum AtomKind {
    /// A variable, a parameter, or π as `None`.
    Symbol(Option<Arc<str>>),
    /// A sum that divides; only negative powers stay, others are multiplied out.
    Divisor(Polynomial),
    /// The root of that degree, in powers from 0 to degree − 1.
    Root(Polynomial, u32),
    /// A function that nothing more is known of.
    Call(Function, Polynomial),
}

/// Values and the places of values that are stored once.
struct Interned<T> {
    values: Vec<T>,
    places: HashMap<T, u32>,
}

impl<T: Clone + Eq + Hash> Interned<T> {
    fn new() -> Self {
        Interned {
            values: Vec::new(),
            places: HashMap::new(),
        }
    }

    fn place(&mut self, value: T) -> u32 {
        if let Some(&place) = self.places.get(&value) {
            return place;
        }
        // There are fewer than MAX_PRODUCTS values and some more for each node of an expression.
        let place = u32::try_from(self.values.len()).unwrap_or(u32::MAX);
        self.values.push(value.clone());
        self.places.insert(value, place);
        place
    }
}

/// All that was made on the way to one normal form.
pub(super) struct Arena {
    polynomials: Interned<Terms>,
    monomials: Interned<Rc<Factors>>,
    atoms: Interned<AtomKind>,
    /// Products of monomials.
    pub(super) products: HashMap<(Monomial, Monomial), Polynomial>,
    /// Normal forms of expressions.
    pub(super) known: HashMap<Expr, Polynomial>,
    work: usize,
    pub(super) zero: Polynomial,
    pub(super) one: Polynomial,
    /// The monomial 1.
    pub(super) unit: Monomial,
}

impl Arena {
    pub(super) fn new() -> Self {
        let mut polynomials = Interned::new();
        let zero = Polynomial(polynomials.place(Rc::from([])));
        let mut monomials = Interned::new();
        let unit = Monomial(monomials.place(Rc::new(Factors {
            exponent: zero,
            powers: Vec::new(),
        })));
        let one = Polynomial(polynomials.place(Rc::from([(unit, Coefficient::real(1))])));
        Arena {
            polynomials,
            monomials,
            atoms: Interned::new(),
            products: HashMap::new(),
            known: HashMap::new(),
            work: 0,
            zero,
            one,
            unit,
        }
    }

    /// Counts work, and stops when there is too much of it.
    pub(super) fn work(&mut self, products: usize) -> Result<(), Stop> {
        self.work = self.work.saturating_add(products);
        if self.work > MAX_PRODUCTS {
            Err(Stop::TooLarge)
        } else {
            Ok(())
        }
    }

    pub(super) fn terms(&self, polynomial: Polynomial) -> Terms {
        Rc::clone(&self.polynomials.values[polynomial.0 as usize])
    }

    pub(super) fn factors(&self, monomial: Monomial) -> Rc<Factors> {
        Rc::clone(&self.monomials.values[monomial.0 as usize])
    }

    pub(super) fn kind(&self, atom: Atom) -> &AtomKind {
        &self.atoms.values[atom.0 as usize]
    }

    pub(super) fn atom(&mut self, kind: AtomKind) -> Atom {
        Atom(self.atoms.place(kind))
    }

    pub(super) fn monomial(&mut self, factors: Factors) -> Monomial {
        Monomial(self.monomials.place(Rc::new(factors)))
    }

    /// The polynomial of terms in any order, monomials repeated.
    pub(super) fn sum_of(
        &mut self,
        terms: impl IntoIterator<Item = (Monomial, Coefficient)>,
    ) -> Polynomial {
        let mut sums: HashMap<Monomial, Coefficient> = HashMap::new();
        for (monomial, coefficient) in terms {
            sums.entry(monomial).or_default().add(&coefficient);
        }
        self.collected(sums)
    }

    /// The polynomial with these coefficients.
    pub(super) fn collected(&mut self, sums: HashMap<Monomial, Coefficient>) -> Polynomial {
        let mut terms: Vec<(Monomial, Coefficient)> =
            sums.into_iter().filter(|(_, c)| !c.is_zero()).collect();
        terms.sort_unstable_by_key(|(monomial, _)| *monomial);
        Polynomial(self.polynomials.place(terms.into()))
    }

    pub(super) fn constant(&mut self, coefficient: Coefficient) -> Polynomial {
        let unit = self.unit;
        self.sum_of([(unit, coefficient)])
    }

    /// The only term, where there is only one.
    pub(super) fn single(&self, polynomial: Polynomial) -> Option<(Monomial, Coefficient)> {
        match &*self.terms(polynomial) {
            [term] => Some(term.clone()),
            _ => None,
        }
    }
}
