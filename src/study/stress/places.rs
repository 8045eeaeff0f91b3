//! Values at the places where methods look; those of a uniform medium are computed once.

use super::medium::Medium;
use crate::case::{Case, Column, Fresh, Nodes, PolynomialTransfer, Transfer};
use crate::real::Format;
use rug::Rational;
use std::iter::repeat_n;
use std::sync::Arc;

/// Nodes of a medium. A uniform one is evaluated once, which a run of 2²⁴ segments needs.
#[derive(Debug)]
pub(super) struct Places<'m, F: Format> {
    fresh: Fresh<'m, Medium, F>,
    uniform: Option<(F::Real, Transfer<F::Real>)>,
}

impl<'m, F: Format> Places<'m, F> {
    pub(super) fn new(medium: &'m Medium, format: F) -> Self {
        let uniform = medium.is_uniform().then(|| {
            let field = medium.field(&format.int(0));
            let transfer = medium.transfer(&field);
            (field, transfer)
        });
        Places {
            fresh: Fresh::new(medium, format),
            uniform,
        }
    }

    fn column(&self, count: u64) -> Option<Arc<Column<F::Real>>> {
        let (field, transfer) = self.uniform.as_ref()?;
        let count = length(count);
        Some(Arc::new(Column {
            field: vec![field.clone(); count],
            emission: vec![transfer.emission.clone(); count],
            extinction: vec![transfer.extinction.clone(); count],
        }))
    }
}

/// A number of places as a length in memory.
fn length(count: u64) -> usize {
    usize::try_from(count).unwrap_or(usize::MAX)
}

type Transfers<'a, R> = Box<dyn Iterator<Item = Transfer<R>> + 'a>;

impl<F: Format> Nodes for Places<'_, F> {
    type Format = F;

    fn format(&self) -> F {
        self.fresh.format()
    }
    fn length(&self) -> &Rational {
        self.fresh.length()
    }
    fn everywhere(&self) -> Option<Transfer<F::Real>> {
        self.uniform.as_ref().map(|(_, transfer)| transfer.clone())
    }
    fn boundaries(&self, n: u64) -> Arc<Column<F::Real>> {
        let uniform = self.column(n.saturating_add(1));
        uniform.unwrap_or_else(|| self.fresh.boundaries(n))
    }
    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<F::Real>> {
        let transfers: Transfers<'_, F::Real> = match &self.uniform {
            Some((_, transfer)) => {
                Box::new(repeat_n(transfer.clone(), length(n).saturating_add(1)))
            }
            None => Box::new(self.fresh.march(n)),
        };
        transfers
    }
    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<F::Real>> {
        let uniform = self.column(n);
        uniform.unwrap_or_else(|| self.fresh.interior(n, offset))
    }
    fn march_inside(&self, n: u64, offset: Rational) -> impl Iterator<Item = Transfer<F::Real>> {
        let transfers: Transfers<'_, F::Real> = match &self.uniform {
            Some((_, transfer)) => Box::new(repeat_n(transfer.clone(), length(n))),
            None => Box::new(self.fresh.march_inside(n, offset)),
        };
        transfers
    }
    fn beyond(&self, n: u64) -> F::Real {
        self.fresh.beyond(n)
    }
    fn extinction_at(&self, lambda: &F::Real) -> F::Real {
        self.fresh.extinction_at(lambda)
    }
    fn transfer(&self, s: &F::Real) -> Transfer<F::Real> {
        match &self.uniform {
            Some((_, transfer)) => transfer.clone(),
            None => self.fresh.transfer(s),
        }
    }
    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.fresh.polynomial_transfer()
    }
}
