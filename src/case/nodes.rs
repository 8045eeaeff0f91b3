//! Values of a case at the places where methods look: evaluated afresh, or once for all who ask.

use super::{Case, PolynomialTransfer, Structure, Transfer};
use crate::real::Format;
use rug::Rational;
use std::collections::HashMap;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Values at a row of nodes, one vector a quantity.
#[derive(Clone, Debug, PartialEq)]
pub struct Column<R> {
    /// s.
    pub field: Vec<R>,
    /// C(s).
    pub emission: Vec<R>,
    /// τ(s).
    pub extinction: Vec<R>,
}

impl<R: Clone> Column<R> {
    fn with_capacity(length: usize) -> Self {
        Column {
            field: Vec::with_capacity(length),
            emission: Vec::with_capacity(length),
            extinction: Vec::with_capacity(length),
        }
    }

    fn push(&mut self, field: R, transfer: Transfer<R>) {
        self.field.push(field);
        self.emission.push(transfer.emission);
        self.extinction.push(transfer.extinction);
    }
}

/// What a method may ask of a ray that is divided into n equal segments of length d = D/n.
///
/// Node positions are rational multiples of D, rounded once and never accumulated: the node i/n is the
/// same number as the node 2i/2n, bit for bit, in every format.
pub trait Nodes: Sync {
    /// The format that everything is evaluated in.
    type Format: Format;

    /// The format.
    fn format(&self) -> Self::Format;

    /// D.
    fn length(&self) -> &Rational;

    /// The n + 1 values at D·i/n, i = 0 … n.
    fn boundaries(&self, n: u64) -> Arc<Column<Number<Self>>>;

    /// The n values at D·(j + offset)/n, j = 0 … n − 1; 0 ≤ offset ≤ 1.
    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<Number<Self>>>;

    /// The field one step beyond the far end, at D·(n + 1)/n.
    fn beyond(&self, n: u64) -> Number<Self>;

    /// τ(s(λ)) at a place that no other run will ask for.
    fn extinction_at(&self, lambda: &Number<Self>) -> Number<Self>;

    /// C and τ at a field value that a method has made up (by interpolation).
    fn transfer(&self, s: &Number<Self>) -> Transfer<Number<Self>>;

    /// τ(s) and C(s)·τ(s) as polynomials, where they are.
    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer>;
}

type Number<N> = <<N as Nodes>::Format as Format>::Real;

/// Every request evaluated anew; counts the nodes.
#[derive(Debug)]
pub struct Fresh<'c, C, F> {
    case: &'c C,
    format: F,
    length: Rational,
    structure: Structure,
    evaluations: AtomicU64,
}

impl<'c, C: Case, F: Format> Fresh<'c, C, F> {
    /// Nodes of `case` in `format`.
    pub fn new(case: &'c C, format: F) -> Self {
        Fresh {
            case,
            format,
            length: case.length(),
            structure: case.structure(),
            evaluations: AtomicU64::new(0),
        }
    }

    /// How often the medium was evaluated so far, at a place of the ray or at a field value.
    pub fn evaluations(&self) -> u64 {
        self.evaluations.load(Ordering::Relaxed)
    }

    fn count(&self, nodes: u64) {
        self.evaluations.fetch_add(nodes, Ordering::Relaxed);
    }

    /// D·numerator/denominator, rounded once.
    fn position(&self, numerator: u64, denominator: u64) -> F::Real {
        let small = || {
            let length_numerator = self.length.numer().to_u64()?;
            let length_denominator = self.length.denom().to_u64()?;
            Some((
                numerator.checked_mul(length_numerator)?,
                denominator.checked_mul(length_denominator)?,
            ))
        };
        match small() {
            Some((numerator, denominator)) => self.format.fraction(numerator, denominator),
            None => self.format.ratio(&Rational::from(
                &self.length * Rational::from((numerator, denominator)),
            )),
        }
    }

    fn evaluate(&self, lambda: &F::Real) -> (F::Real, Transfer<F::Real>) {
        let field = self.case.field(lambda);
        let transfer = self.case.transfer(&field);
        (field, transfer)
    }

    fn column(&self, positions: impl ExactSizeIterator<Item = F::Real>) -> Column<F::Real> {
        self.count(positions.len() as u64);
        let mut column = Column::with_capacity(positions.len());
        for lambda in positions {
            let (field, transfer) = self.evaluate(&lambda);
            column.push(field, transfer);
        }
        column
    }
}

impl<C: Case, F: Format> Nodes for Fresh<'_, C, F> {
    type Format = F;

    fn format(&self) -> F {
        self.format
    }

    fn length(&self) -> &Rational {
        &self.length
    }

    fn boundaries(&self, n: u64) -> Arc<Column<F::Real>> {
        Arc::new(self.column(indices(n + 1).map(|i| self.position(i, n))))
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<F::Real>> {
        Arc::new(match grid(n, offset) {
            Some(grid) => self.column(indices(n).map(|j| {
                let (numerator, denominator) = grid.node(j);
                self.position(numerator, denominator)
            })),
            None => self.column(indices(n).map(|j| {
                let part = Rational::from(offset + j) / n;
                self.format.ratio(&(part * &self.length))
            })),
        })
    }

    fn beyond(&self, n: u64) -> F::Real {
        self.count(1);
        self.case.field(&self.position(n + 1, n))
    }

    fn extinction_at(&self, lambda: &F::Real) -> F::Real {
        self.count(1);
        self.case.extinction(&self.case.field(lambda))
    }

    fn transfer(&self, s: &F::Real) -> Transfer<F::Real> {
        self.count(1);
        self.case.transfer(s)
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.structure.transfer.as_ref()
    }
}

/// Indices 0 … count − 1 of known number.
fn indices(count: u64) -> impl ExactSizeIterator<Item = u64> {
    (0..usize::try_from(count).unwrap_or(usize::MAX)).map(|i| i as u64)
}

/// The nodes (j + p/q)/n = (jq + p)/(nq).
struct Grid {
    p: u64,
    q: u64,
    denominator: u64,
}

impl Grid {
    fn node(&self, j: u64) -> (u64, u64) {
        (j * self.q + self.p, self.denominator)
    }
}

/// The grid of an offset p/q ≤ 1, where all its numerators and denominators are machine integers.
fn grid(n: u64, offset: &Rational) -> Option<Grid> {
    let p = offset.numer().to_u64()?;
    let q = offset.denom().to_u64()?;
    let denominator = n.checked_mul(q)?;
    denominator.checked_add(p)?;
    Some(Grid { p, q, denominator })
}

/// Every node evaluated once and kept: all rules, methods and levels that ask share its values.
#[derive(Debug)]
pub struct Shared<'c, C, F: Format> {
    fresh: Fresh<'c, C, F>,
    cache: Mutex<Cache<F::Real>>,
}

#[derive(Debug)]
struct Cache<R> {
    /// By the position over D in lowest terms.
    values: HashMap<(u64, u64), (R, Transfer<R>)>,
    /// By n and offset; boundaries have no offset.
    columns: HashMap<(u64, Option<Rational>), Arc<Column<R>>>,
}

impl<'c, C: Case, F: Format> Shared<'c, C, F> {
    /// Nodes of `case` in `format`, none evaluated yet.
    pub fn new(case: &'c C, format: F) -> Self {
        Shared {
            fresh: Fresh::new(case, format),
            cache: Mutex::new(Cache {
                values: HashMap::new(),
                columns: HashMap::new(),
            }),
        }
    }

    /// How often the medium was evaluated so far.
    pub fn evaluations(&self) -> u64 {
        self.fresh.evaluations()
    }

    fn cache(&self) -> MutexGuard<'_, Cache<F::Real>> {
        // Values and columns go in whole, so a poisoned cache is still sound.
        self.cache.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn gather(
        &self,
        cache: &mut Cache<F::Real>,
        nodes: impl ExactSizeIterator<Item = (u64, u64)>,
    ) -> Column<F::Real> {
        let mut column = Column::with_capacity(nodes.len());
        for (numerator, denominator) in nodes {
            let common = gcd(numerator, denominator);
            let key = (numerator / common, denominator / common);
            let (field, transfer) = cache.values.entry(key).or_insert_with(|| {
                self.fresh.count(1);
                self.fresh
                    .evaluate(&self.fresh.position(numerator, denominator))
            });
            column.push(field.clone(), transfer.clone());
        }
        column
    }
}

impl<C: Case, F: Format> Nodes for Shared<'_, C, F> {
    type Format = F;

    fn format(&self) -> F {
        self.fresh.format
    }

    fn length(&self) -> &Rational {
        &self.fresh.length
    }

    fn boundaries(&self, n: u64) -> Arc<Column<F::Real>> {
        let mut cache = self.cache();
        if let Some(column) = cache.columns.get(&(n, None)) {
            return Arc::clone(column);
        }
        let column = Arc::new(self.gather(&mut cache, indices(n + 1).map(|i| (i, n))));
        cache.columns.insert((n, None), Arc::clone(&column));
        column
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<F::Real>> {
        let mut cache = self.cache();
        let key = (n, Some(offset.clone()));
        if let Some(column) = cache.columns.get(&key) {
            return Arc::clone(column);
        }
        let column = match grid(n, offset) {
            Some(grid) => Arc::new(self.gather(&mut cache, indices(n).map(|j| grid.node(j)))),
            // Irrational nodes belong to their level alone.
            None => self.fresh.interior(n, offset),
        };
        cache.columns.insert(key, Arc::clone(&column));
        column
    }

    fn beyond(&self, n: u64) -> F::Real {
        self.fresh.beyond(n)
    }

    fn extinction_at(&self, lambda: &F::Real) -> F::Real {
        self.fresh.extinction_at(lambda)
    }

    fn transfer(&self, s: &F::Real) -> Transfer<F::Real> {
        self.fresh.transfer(s)
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.fresh.polynomial_transfer()
    }
}

/// The greatest common divisor; of 0 and b it is b.
fn gcd(mut a: u64, mut b: u64) -> u64 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}
