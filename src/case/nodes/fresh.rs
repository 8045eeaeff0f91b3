//! Every request evaluated anew.

use super::grid::Grid;
use super::{Column, Nodes};
use crate::case::{Case, PolynomialTransfer, Structure, Transfer};
use crate::real::Format;
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

    /// Field and transfer functions at D·numerator/denominator, rounded once.
    #[inline]
    pub(super) fn at_fraction(
        &self,
        (numerator, denominator): (u64, u64),
    ) -> (F::Real, Transfer<F::Real>) {
        self.at(&self.format.fraction(numerator, denominator))
    }

    /// The same at D·(j + offset)/n, where that is no quotient of machine integers.
    #[cold]
    fn at_exact(&self, n: u64, offset: &Rational, j: u64) -> (F::Real, Transfer<F::Real>) {
        let part = Rational::from(offset + j) / n;
        self.at(&self.format.ratio(&(part * &self.length)))
    }

    #[inline]
    fn at(&self, lambda: &F::Real) -> (F::Real, Transfer<F::Real>) {
        let field = self.case.field(lambda);
        let transfer = self.case.transfer(&field);
        (field, transfer)
    }

    pub(super) fn grid(&self, n: u64, offset: &Rational) -> Option<Grid> {
        Grid::new(&self.length, n, offset)
    }

    /// The places j = 0 … count − 1 of a grid, one after the other.
    #[inline]
    fn places(
        &self,
        n: u64,
        offset: Rational,
        count: u64,
    ) -> impl Iterator<Item = (F::Real, Transfer<F::Real>)> {
        self.count(count);
        let grid = self.grid(n, &offset);
        (0..count).map(move |j| match &grid {
            Some(grid) => self.at_fraction(grid.place(j)),
            None => self.at_exact(n, &offset, j),
        })
    }

    /// C and τ at these places.
    #[inline]
    fn transfers(
        &self,
        n: u64,
        offset: Rational,
        count: u64,
    ) -> impl Iterator<Item = Transfer<F::Real>> {
        let places = self.places(n, offset, count);
        places.map(|(_, transfer)| transfer)
    }

    fn column(&self, n: u64, offset: Rational, count: u64) -> Arc<Column<F::Real>> {
        let mut column = Column::with_capacity(count);
        for (field, transfer) in self.places(n, offset, count) {
            column.push(field, transfer);
        }
        Arc::new(column)
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
        self.column(n, Rational::new(), n + 1)
    }

    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<F::Real>> {
        self.transfers(n, Rational::new(), n + 1)
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<F::Real>> {
        self.column(n, offset.clone(), n)
    }

    fn march_inside(&self, n: u64, offset: Rational) -> impl Iterator<Item = Transfer<F::Real>> {
        self.transfers(n, offset, n)
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

    fn transfer(&self, s: &F::Real) -> Transfer<F::Real> {
        self.count(1);
        self.case.transfer(s)
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.structure.transfer.as_ref()
    }
}
