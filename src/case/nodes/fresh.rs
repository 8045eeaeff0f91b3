//! Every request evaluated anew.

use super::grid::Grid;
use super::places::Places;
use super::{Column, Nodes, ROW, in_rows};
use crate::case::{Case, PolynomialTransfer, Structure, Transfer};
use crate::real::{Format, row};
use rug::Rational;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

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

    pub(super) fn count(&self, nodes: u64) {
        self.evaluations.fetch_add(nodes, Ordering::Relaxed);
    }

    /// s, C and τ at these places, in their order.
    fn evaluate(&self, lambda: &[F::Real]) -> Column<F::Real> {
        let field = self.case.fields(lambda);
        let Transfer {
            emission,
            extinction,
        } = self.case.transfers(&field);
        Column {
            field,
            emission,
            extinction,
        }
    }

    /// s, C and τ at D·numerator/denominator for all of these, rounded once.
    pub(super) fn at_fractions(&self, fractions: &[(u64, u64)]) -> Column<F::Real> {
        self.count(fractions.len() as u64);
        let places = fractions.iter().map(|&(p, q)| self.format.fraction(p, q));
        self.evaluate(&row(places))
    }

    pub(super) fn grid(&self, n: u64, offset: &Rational) -> Option<Grid> {
        Grid::new(&self.length, n, offset)
    }

    /// The places D·(j + offset)/n, j = 0 … count − 1, one after the other, rounded once.
    #[inline]
    fn places(
        &self,
        n: u64,
        offset: &Rational,
        count: u64,
    ) -> impl Iterator<Item = F::Real> + use<'_, F, C> {
        self.count(count);
        let places = Places::new(&self.length, n, offset);
        (0..count).map(move |j| places.at(self.format, j))
    }

    /// C and τ at these places, one after the other.
    #[inline]
    fn transfers(
        &self,
        n: u64,
        offset: &Rational,
        count: u64,
    ) -> impl Iterator<Item = Transfer<F::Real>> + use<'_, F, C> {
        if C::IN_ROWS {
            let rows = self.evaluated_rows(n, offset, count, ROW);
            return Way::Rows(rows.flat_map(|transfers| {
                let both = transfers.emission.into_iter().zip(transfers.extinction);
                both.map(|(emission, extinction)| Transfer {
                    emission,
                    extinction,
                })
            }));
        }
        let places = self.places(n, offset, count);
        Way::Places(places.map(|lambda| self.case.transfer(&self.case.field(&lambda))))
    }

    /// The same in rows, the first of them of `first`.
    fn rows_of(
        &self,
        n: u64,
        offset: &Rational,
        count: u64,
        first: usize,
    ) -> impl Iterator<Item = Transfer<Vec<F::Real>>> + use<'_, F, C> {
        if C::IN_ROWS {
            Way::Rows(self.evaluated_rows(n, offset, count, first))
        } else {
            Way::Places(in_rows(self.transfers(n, offset, count), first))
        }
    }

    /// Of a case that is quicker many places at once.
    fn evaluated_rows(
        &self,
        n: u64,
        offset: &Rational,
        count: u64,
        first: usize,
    ) -> impl Iterator<Item = Transfer<Vec<F::Real>>> + use<'_, F, C> {
        let mut places = self.places(n, offset, count);
        let mut length = first;
        std::iter::from_fn(move || {
            let row = row(places.by_ref().take(length));
            length = ROW;
            (!row.is_empty()).then(|| self.case.transfers(&self.case.fields(&row)))
        })
    }

    fn column(&self, n: u64, offset: &Rational, count: u64) -> Arc<Column<F::Real>> {
        Arc::new(self.evaluate(&row(self.places(n, offset, count))))
    }
}

/// One of two ways along the places of a ray, which gives the same values.
enum Way<A, B> {
    Places(A),
    Rows(B),
}

impl<T, A: Iterator<Item = T>, B: Iterator<Item = T>> Iterator for Way<A, B> {
    type Item = T;

    #[inline]
    fn next(&mut self) -> Option<T> {
        match self {
            Way::Places(places) => places.next(),
            Way::Rows(rows) => rows.next(),
        }
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
        self.column(n, &Rational::new(), n + 1)
    }

    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<F::Real>> {
        self.transfers(n, &Rational::new(), n + 1)
    }

    fn rows(&self, n: u64) -> impl Iterator<Item = Transfer<Vec<F::Real>>> {
        self.rows_of(n, &Rational::new(), n + 1, ROW + 1)
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<F::Real>> {
        self.column(n, offset, n)
    }

    fn march_inside(&self, n: u64, offset: Rational) -> impl Iterator<Item = Transfer<F::Real>> {
        self.transfers(n, &offset, n)
    }

    fn rows_inside(
        &self,
        n: u64,
        offset: Rational,
    ) -> impl Iterator<Item = Transfer<Vec<F::Real>>> {
        self.rows_of(n, &offset, n, ROW)
    }

    fn beyond(&self, n: u64) -> F::Real {
        self.count(1);
        let place = Rational::from(&self.length * (n + 1)) / n;
        self.case.field(&self.format.ratio(&place))
    }

    fn extinction_at(&self, lambda: &F::Real) -> F::Real {
        self.count(1);
        self.case.extinction(&self.case.field(lambda))
    }

    fn extinctions_at(&self, lambda: &[F::Real]) -> Vec<F::Real> {
        // Counted at once: threads that share the nodes would wait for one another at every place.
        self.count(lambda.len() as u64);
        let fields = self.case.fields(lambda);
        row(fields.iter().map(|s| self.case.extinction(s)))
    }

    fn transfer(&self, s: &F::Real) -> Transfer<F::Real> {
        self.count(1);
        self.case.transfer(s)
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.structure.transfer.as_ref()
    }
}
