//! Sums of coefficients times monomials.

use super::coefficient::Coefficient;
use super::ratio::Ratio;
use std::collections::BTreeMap;

/// The place of a monomial in its arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MonomialId(pub(super) u32);

impl MonomialId {
    /// The monomial 1, the first of every arena.
    pub(super) const ONE: MonomialId = MonomialId(0);
}

/// A coefficient, not 0, and its monomial.
pub(super) type Term = (MonomialId, Coefficient);

/// A sum of terms of different monomials, in the order of their places.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Polynomial {
    terms: Vec<Term>,
}

impl Polynomial {
    pub(super) fn constant(c: Coefficient) -> Polynomial {
        Polynomial::term(MonomialId::ONE, c)
    }

    pub(super) fn one() -> Polynomial {
        Polynomial::constant(Coefficient::ONE)
    }

    pub(super) fn term(monomial: MonomialId, c: Coefficient) -> Polynomial {
        let terms = if c.is_zero() {
            Vec::new()
        } else {
            vec![(monomial, c)]
        };
        Polynomial { terms }
    }

    /// In the order of their monomials' places.
    #[must_use]
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    pub(super) fn len(&self) -> usize {
        self.terms.len()
    }

    pub(super) fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    pub(super) fn is_one(&self) -> bool {
        self.as_constant() == Some(&Coefficient::ONE)
    }

    /// The coefficient that this is, if it is one other than 0.
    pub(super) fn as_constant(&self) -> Option<&Coefficient> {
        match &self.terms[..] {
            [(MonomialId::ONE, c)] => Some(c),
            _ => None,
        }
    }

    /// The sign of the last term's coefficient. Of sums it is an order: a > b where a − b has a positive one.
    pub(super) fn sign(&self) -> std::cmp::Ordering {
        self.terms
            .last()
            .map_or(std::cmp::Ordering::Equal, |(_, c)| c.sign())
    }

    pub(super) fn add(&self, other: &Polynomial) -> Polynomial {
        let mut terms = Vec::with_capacity(self.len() + other.len());
        let (mut left, mut right) = (self.terms.iter().peekable(), other.terms.iter().peekable());
        loop {
            let next = match (left.peek(), right.peek()) {
                (None, None) => return Polynomial { terms },
                (Some((m, _)), Some((n, _))) if m == n => {
                    if let (Some((m, a)), Some((_, b))) = (left.next(), right.next()) {
                        let sum = a.add(b);
                        if !sum.is_zero() {
                            terms.push((*m, sum));
                        }
                    }
                    continue;
                }
                (Some((m, _)), Some((n, _))) if m < n => left.next(),
                (Some(_), None) => left.next(),
                _ => right.next(),
            };
            terms.extend(next.cloned());
        }
    }

    pub(super) fn sub(&self, other: &Polynomial) -> Polynomial {
        self.add(&other.neg())
    }

    pub(super) fn neg(&self) -> Polynomial {
        self.map(Coefficient::neg)
    }

    pub(super) fn scale(&self, factor: &Coefficient) -> Polynomial {
        if factor.is_zero() {
            return Polynomial::default();
        }
        self.map(|c| c.mul(factor))
    }

    /// Every coefficient replaced by what isn't 0 either.
    fn map(&self, f: impl Fn(&Coefficient) -> Coefficient) -> Polynomial {
        let terms = self.terms.iter().map(|(m, c)| (*m, f(c))).collect();
        Polynomial { terms }
    }

    /// The greatest positive rational of which all coefficients are integer multiples; of 0, 1.
    pub(super) fn content(&self) -> Ratio {
        let mut numerators = rug::Integer::new();
        let mut denominators = rug::Integer::from(1);
        for part in self.terms.iter().flat_map(|(_, c)| [&c.re, &c.im]) {
            let part = part.to_rational();
            numerators.gcd_mut(part.numer());
            denominators.lcm_mut(part.denom());
        }
        if self.is_zero() {
            return Ratio::ONE;
        }
        rug::Rational::from((numerators, denominators)).into()
    }
}

/// A polynomial in the making.
#[derive(Default)]
pub(super) struct Accumulator(BTreeMap<MonomialId, Coefficient>);

impl Accumulator {
    pub(super) fn add(&mut self, monomial: MonomialId, c: Coefficient) {
        self.0
            .entry(monomial)
            .and_modify(|sum| *sum = sum.add(&c))
            .or_insert(c);
    }

    pub(super) fn add_scaled(&mut self, polynomial: &Polynomial, factor: &Coefficient) {
        for (monomial, c) in polynomial.terms() {
            self.add(*monomial, c.mul(factor));
        }
    }

    /// Terms so far, those that cancelled included.
    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    pub(super) fn finish(self) -> Polynomial {
        let terms = self.0.into_iter().filter(|(_, c)| !c.is_zero()).collect();
        Polynomial { terms }
    }
}
