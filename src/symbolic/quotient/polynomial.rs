//! Sums of products of powers of atoms, with rational exponents of either sign.

use rug::Rational;
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// The most terms that a polynomial may have.
pub(super) const MAX_TERMS: usize = 600;

/// A product of powers of atoms; atoms are numbered, and only exponents other than 0 are kept.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Monomial(BTreeMap<usize, Rational>);

impl Monomial {
    pub(super) fn power(atom: usize, exponent: &Rational) -> Self {
        let mut monomial = Monomial::default();
        monomial.multiply(atom, exponent);
        monomial
    }

    pub(super) fn multiply(&mut self, atom: usize, exponent: &Rational) {
        let sum = self.0.entry(atom).or_default();
        *sum += exponent;
        if *sum == 0 {
            self.0.remove(&atom);
        }
    }

    pub(super) fn product(&self, other: &Monomial) -> Monomial {
        let mut product = self.clone();
        for (&atom, exponent) in &other.0 {
            product.multiply(atom, exponent);
        }
        product
    }

    pub(super) fn to_the(&self, exponent: &Rational) -> Monomial {
        if *exponent == 0 {
            return Monomial::default();
        }
        let powers = self.0.iter();
        Monomial(
            powers
                .map(|(&atom, e)| (atom, Rational::from(e * exponent)))
                .collect(),
        )
    }

    pub(super) fn inverse(&self) -> Monomial {
        self.to_the(&Rational::from(-1))
    }

    pub(super) fn exponents(&self) -> impl Iterator<Item = (usize, &Rational)> {
        self.0.iter().map(|(&atom, exponent)| (atom, exponent))
    }

    pub(super) fn exponent(&self, atom: usize) -> Rational {
        self.0.get(&atom).cloned().unwrap_or_default()
    }

    /// Whether all exponents are ≥ 0.
    pub(super) fn is_entire(&self) -> bool {
        self.0.values().all(|exponent| *exponent > 0)
    }

    /// What both have in common: for each atom the lesser exponent.
    fn common(&self, other: &Monomial) -> Monomial {
        let mut common = Monomial::default();
        for &atom in self.0.keys().chain(other.0.keys()) {
            let least = self.exponent(atom).min(other.exponent(atom));
            if least != 0 {
                common.0.insert(atom, least);
            }
        }
        common
    }
}

impl Ord for Monomial {
    /// Lexicographic: the greater exponent of the first atom that differs. It is kept by products.
    fn cmp(&self, other: &Self) -> Ordering {
        let (mut a, mut b) = (self.0.iter().peekable(), other.0.iter().peekable());
        let zero = Rational::new();
        loop {
            let order = match (a.peek(), b.peek()) {
                (None, None) => return Ordering::Equal,
                (Some((x, p)), Some((y, q))) if x == y => {
                    let order = p.cmp(q);
                    a.next();
                    b.next();
                    order
                }
                (Some((x, p)), Some((y, _))) if x < y => return (*p).cmp(&zero),
                (Some((_, p)), None) => return (*p).cmp(&zero),
                (_, Some((_, q))) => return zero.cmp(q),
            };
            if order != Ordering::Equal {
                return order;
            }
        }
    }
}

impl PartialOrd for Monomial {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// A sum of monomials with coefficients other than 0.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Polynomial(BTreeMap<Monomial, Rational>);

impl Polynomial {
    pub(super) fn constant(q: &Rational) -> Self {
        let mut polynomial = Polynomial::default();
        polynomial.add(&Monomial::default(), q);
        polynomial
    }

    pub(super) fn one() -> Self {
        Polynomial::constant(&Rational::from(1))
    }

    pub(super) fn monomial(monomial: Monomial) -> Self {
        Polynomial(BTreeMap::from([(monomial, Rational::from(1))]))
    }

    pub(super) fn add(&mut self, monomial: &Monomial, coefficient: &Rational) {
        if *coefficient == 0 {
            return;
        }
        let sum = self.0.entry(monomial.clone()).or_default();
        *sum += coefficient;
        if *sum == 0 {
            self.0.remove(monomial);
        }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    pub(super) fn is_one(&self) -> bool {
        *self == Polynomial::one()
    }

    pub(super) fn terms(&self) -> impl DoubleEndedIterator<Item = (&Monomial, &Rational)> {
        self.0.iter()
    }

    pub(super) fn len(&self) -> usize {
        self.0.len()
    }

    /// The only term, where there is only one.
    pub(super) fn single(&self) -> Option<(&Monomial, &Rational)> {
        self.0.first_key_value().filter(|_| self.0.len() == 1)
    }

    /// The term with the greatest monomial.
    pub(super) fn leading(&self) -> Option<(&Monomial, &Rational)> {
        self.0.last_key_value()
    }

    pub(super) fn sum(mut self, other: &Polynomial) -> Option<Polynomial> {
        for (monomial, coefficient) in &other.0 {
            self.add(monomial, coefficient);
        }
        (self.0.len() <= MAX_TERMS).then_some(self)
    }

    pub(super) fn times(&self, monomial: &Monomial) -> Polynomial {
        self.scaled(monomial, &Rational::from(1))
    }

    /// The product with one term; its coefficient must not be 0.
    pub(super) fn scaled(&self, monomial: &Monomial, coefficient: &Rational) -> Polynomial {
        let terms = self.0.iter();
        Polynomial(
            terms
                .map(|(m, c)| (m.product(monomial), Rational::from(c * coefficient)))
                .collect(),
        )
    }

    pub(super) fn product(&self, other: &Polynomial) -> Option<Polynomial> {
        if self.len().saturating_mul(other.len()) > 8 * MAX_TERMS {
            return None;
        }
        let mut product = Polynomial::default();
        for (m, c) in &self.0 {
            for (n, d) in &other.0 {
                product.add(&m.product(n), &Rational::from(c * d));
            }
        }
        (product.len() <= MAX_TERMS).then_some(product)
    }

    pub(super) fn to_the(&self, exponent: u32) -> Option<Polynomial> {
        let mut power = Polynomial::one();
        for _ in 0..exponent {
            power = power.product(self)?;
        }
        Some(power)
    }

    /// The greatest monomial that divides all terms, and the rest.
    pub(super) fn split_content(&self) -> (Monomial, Polynomial) {
        let content = self.0.keys().cloned().reduce(|a, b| a.common(&b));
        let content = content.unwrap_or_default();
        let rest = self.times(&content.inverse());
        (content, rest)
    }
}
