//! Nodes of whatever kind behind one interface.

use super::{Column, Nodes, Number};
use crate::case::{PolynomialTransfer, Transfer};
use crate::real::Format;
use rug::Rational;
use std::fmt::Debug;
use std::sync::Arc;

/// Nodes of whatever kind, borrowed: what is given these is compiled once a format, whoever evaluates them.
#[derive(Clone, Copy, Debug)]
pub struct AnyNodes<'a, F: Format>(&'a dyn Ask<F>);

impl<'a, F: Format> AnyNodes<'a, F> {
    /// The same values, one call through a pointer each.
    pub fn new<N: Nodes<Format = F>>(nodes: &'a N) -> Self {
        AnyNodes(nodes)
    }

    /// [`Nodes::rows`], for as long as the nodes are there.
    pub(crate) fn all_rows(self, n: u64) -> Rows<'a, F::Real> {
        self.0.rows(n)
    }

    /// [`Nodes::rows_inside`], for as long as the nodes are there.
    pub(crate) fn all_rows_inside(self, n: u64, offset: Rational) -> Rows<'a, F::Real> {
        self.0.rows_inside(n, offset)
    }
}

/// C and τ, row by row.
pub(crate) type Rows<'a, R> = Box<dyn Iterator<Item = Transfer<Vec<R>>> + 'a>;

type Transfers<'a, F> = Box<dyn Iterator<Item = Transfer<<F as Format>::Real>> + 'a>;

/// What [`Nodes`] answer, without their type.
trait Ask<F: Format>: Debug + Sync {
    fn format(&self) -> F;
    fn length(&self) -> &Rational;
    fn everywhere(&self) -> Option<Transfer<F::Real>>;
    fn boundaries(&self, n: u64) -> Arc<Column<F::Real>>;
    fn march(&self, n: u64) -> Transfers<'_, F>;
    fn rows(&self, n: u64) -> Rows<'_, F::Real>;
    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<F::Real>>;
    fn march_inside(&self, n: u64, offset: Rational) -> Transfers<'_, F>;
    fn rows_inside(&self, n: u64, offset: Rational) -> Rows<'_, F::Real>;
    fn beyond(&self, n: u64) -> F::Real;
    fn extinction_at(&self, lambda: &F::Real) -> F::Real;
    fn extinctions_at(&self, lambda: &[F::Real]) -> Vec<F::Real>;
    fn transfer(&self, s: &F::Real) -> Transfer<F::Real>;
    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer>;
}

impl<N: Nodes> Ask<N::Format> for N {
    fn format(&self) -> N::Format {
        Nodes::format(self)
    }
    fn length(&self) -> &Rational {
        Nodes::length(self)
    }
    fn everywhere(&self) -> Option<Transfer<Number<N>>> {
        Nodes::everywhere(self)
    }
    fn boundaries(&self, n: u64) -> Arc<Column<Number<N>>> {
        Nodes::boundaries(self, n)
    }
    fn march(&self, n: u64) -> Transfers<'_, N::Format> {
        Box::new(Nodes::march(self, n))
    }
    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<Number<N>>> {
        Nodes::interior(self, n, offset)
    }
    fn march_inside(&self, n: u64, offset: Rational) -> Transfers<'_, N::Format> {
        Box::new(Nodes::march_inside(self, n, offset))
    }
    fn rows(&self, n: u64) -> Rows<'_, Number<N>> {
        Box::new(Nodes::rows(self, n))
    }
    fn rows_inside(&self, n: u64, offset: Rational) -> Rows<'_, Number<N>> {
        Box::new(Nodes::rows_inside(self, n, offset))
    }
    fn beyond(&self, n: u64) -> Number<N> {
        Nodes::beyond(self, n)
    }
    fn extinction_at(&self, lambda: &Number<N>) -> Number<N> {
        Nodes::extinction_at(self, lambda)
    }
    fn extinctions_at(&self, lambda: &[Number<N>]) -> Vec<Number<N>> {
        Nodes::extinctions_at(self, lambda)
    }
    fn transfer(&self, s: &Number<N>) -> Transfer<Number<N>> {
        Nodes::transfer(self, s)
    }
    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        Nodes::polynomial_transfer(self)
    }
}

impl<F: Format> Nodes for AnyNodes<'_, F> {
    type Format = F;

    fn format(&self) -> F {
        self.0.format()
    }
    fn length(&self) -> &Rational {
        self.0.length()
    }
    fn everywhere(&self) -> Option<Transfer<F::Real>> {
        self.0.everywhere()
    }
    fn boundaries(&self, n: u64) -> Arc<Column<F::Real>> {
        self.0.boundaries(n)
    }
    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<F::Real>> {
        self.0.march(n)
    }
    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<F::Real>> {
        self.0.interior(n, offset)
    }
    fn march_inside(&self, n: u64, offset: Rational) -> impl Iterator<Item = Transfer<F::Real>> {
        self.0.march_inside(n, offset)
    }
    fn rows(&self, n: u64) -> impl Iterator<Item = Transfer<Vec<F::Real>>> {
        self.0.rows(n)
    }
    fn rows_inside(
        &self,
        n: u64,
        offset: Rational,
    ) -> impl Iterator<Item = Transfer<Vec<F::Real>>> {
        self.0.rows_inside(n, offset)
    }
    fn beyond(&self, n: u64) -> F::Real {
        self.0.beyond(n)
    }
    fn extinction_at(&self, lambda: &F::Real) -> F::Real {
        self.0.extinction_at(lambda)
    }
    fn extinctions_at(&self, lambda: &[F::Real]) -> Vec<F::Real> {
        self.0.extinctions_at(lambda)
    }
    fn transfer(&self, s: &F::Real) -> Transfer<F::Real> {
        self.0.transfer(s)
    }
    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.0.polynomial_transfer()
    }
}
