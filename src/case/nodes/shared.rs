//! Every node evaluated once and kept.

use super::grid::Grid;
use super::{Column, Fresh, Nodes, transfers};
use crate::case::{Case, PolynomialTransfer, Transfer};
use crate::real::{Format, row};
use crate::symbolic::HashMap;
use rug::Rational;
use std::fmt::{self, Debug};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Every node evaluated once and kept: all rules, methods and levels that ask share its values.
#[derive(Debug)]
pub struct Shared<'c, C, F: Format> {
    fresh: Fresh<'c, C, F>,
    cache: Mutex<Cache<F::Real>>,
}

struct Cache<R> {
    /// As they were evaluated.
    evaluated: Vec<Arc<Column<R>>>,
    /// Where in them a position is, a fraction in lowest terms.
    places: HashMap<(u64, u64), (usize, usize)>,
    /// By n and offset; boundaries have no offset.
    columns: HashMap<(u64, Option<Rational>), Arc<Column<R>>>,
}

impl<'c, C: Case, F: Format> Shared<'c, C, F> {
    /// Nodes of `case` in `format`, none evaluated yet.
    pub fn new(case: &'c C, format: F) -> Self {
        Shared {
            fresh: Fresh::new(case, format),
            cache: Mutex::new(Cache {
                evaluated: Vec::new(),
                places: HashMap::default(),
                columns: HashMap::default(),
            }),
        }
    }

    /// How often the medium was evaluated so far.
    pub fn evaluations(&self) -> u64 {
        self.fresh.evaluations()
    }

    /// Lets the columns of n segments go, whose values stay: for who is done with that level.
    #[cfg(feature = "studies")]
    pub(crate) fn forget_columns(&self, n: u64) {
        self.cache().columns.retain(|(level, _), _| *level != n);
    }

    fn cache(&self) -> MutexGuard<'_, Cache<F::Real>> {
        // Values and columns go in whole, so a poisoned cache is still sound.
        self.cache.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The column of that key, evaluated where it is not kept yet.
    fn column(&self, n: u64, offset: Option<&Rational>) -> Arc<Column<F::Real>> {
        // Held while nodes are evaluated: levels share them, and each is to be evaluated once.
        let mut cache = self.cache();
        let key = (n, offset.cloned());
        if let Some(column) = cache.columns.get(&key) {
            return Arc::clone(column);
        }
        let grid = self.fresh.grid(n, offset.unwrap_or(&Rational::new()));
        let evaluate = |places: &[(u64, u64)]| self.fresh.at_fractions(places);
        let column = match (grid, offset) {
            (Some(grid), None) => cache.gather(&grid, n + 1, &evaluate),
            (Some(grid), Some(_)) => cache.gather(&grid, n, &evaluate),
            // Places that are no fractions of machine integers belong to their level alone.
            (None, None) => self.fresh.boundaries(n),
            (None, Some(offset)) => self.fresh.interior(n, offset),
        };
        cache.columns.insert(key, Arc::clone(&column));
        column
    }
}

/// How much is kept: what it is would be pages.
impl<R> Debug for Cache<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (values, columns) = (self.places.len(), self.columns.len());
        write!(f, "{values} values, {columns} columns")
    }
}

/// C and τ at places, given as fractions of the ray.
type Evaluate<'e, R> = dyn Fn(&[(u64, u64)]) -> Column<R> + 'e;

impl<R: Clone> Cache<R> {
    /// The places of a grid; `evaluate` is asked for those that are not kept yet, all at once.
    fn gather(&mut self, grid: &Grid, count: u64, evaluate: &Evaluate<'_, R>) -> Arc<Column<R>> {
        let places = row((0..count).map(|j| in_lowest_terms(grid.place(j))));
        let is_new = |place: &&(u64, u64)| !self.places.contains_key(*place);
        let new = row(places.iter().filter(is_new).copied());
        if !new.is_empty() {
            let column = Arc::new(evaluate(&new));
            let indices = (0..).map(|index| (self.evaluated.len(), index));
            self.places.extend(new.iter().copied().zip(indices));
            self.evaluated.push(Arc::clone(&column));
            if new.len() == places.len() {
                return column;
            }
        }
        let mut column = Column::with_capacity(count);
        for place in &places {
            if let Some((from, index)) = self.places.get(place)
                && let Some(from) = self.evaluated.get(*from)
            {
                column.push_from(from, *index);
            }
        }
        Arc::new(column)
    }
}

impl<C: Case, F: Format> Nodes for Shared<'_, C, F> {
    type Format = F;

    fn format(&self) -> F {
        self.fresh.format()
    }

    fn length(&self) -> &Rational {
        self.fresh.length()
    }

    fn boundaries(&self, n: u64) -> Arc<Column<F::Real>> {
        self.column(n, None)
    }

    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<F::Real>> {
        transfers(self.boundaries(n))
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<F::Real>> {
        self.column(n, Some(offset))
    }

    fn beyond(&self, n: u64) -> F::Real {
        self.fresh.beyond(n)
    }

    fn extinction_at(&self, lambda: &F::Real) -> F::Real {
        self.fresh.extinction_at(lambda)
    }

    fn extinctions_at(&self, lambda: &[F::Real]) -> Vec<F::Real> {
        self.fresh.extinctions_at(lambda)
    }

    fn transfer(&self, s: &F::Real) -> Transfer<F::Real> {
        self.fresh.transfer(s)
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.fresh.polynomial_transfer()
    }
}

/// The same fraction in lowest terms.
fn in_lowest_terms((numerator, denominator): (u64, u64)) -> (u64, u64) {
    let common = gcd(numerator, denominator);
    (numerator / common, denominator / common)
}

/// The greatest common divisor; of 0 and b it is b.
pub(crate) fn gcd(a: u64, b: u64) -> u64 {
    if a == 0 || b == 0 {
        return a | b;
    }
    // Powers of two, of which ladders are mostly made, come off without divisions.
    let twos = (a | b).trailing_zeros();
    let (mut a, mut b) = (a >> a.trailing_zeros(), b >> b.trailing_zeros());
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a << twos
}
