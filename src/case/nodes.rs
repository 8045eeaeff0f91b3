//! Values of a case at the places where methods look: evaluated afresh, or once for all who ask.

mod any;
mod fresh;
pub(crate) mod grid;
mod places;
mod recorded;
mod replayed;
mod shared;
mod twice;

pub use any::AnyNodes;
pub(crate) use any::Rows;
pub use fresh::Fresh;
pub(crate) use places::Places;
pub use recorded::{Recorded, Recording};
pub use replayed::Replayed;
pub use shared::Shared;
pub(crate) use shared::gcd;

use super::{PolynomialTransfer, Transfer};
use crate::real::{Format, row};
use rug::Rational;
use std::fmt::Debug;
use std::sync::Arc;

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
    fn with_capacity(count: u64) -> Self {
        let length = usize::try_from(count).unwrap_or(usize::MAX);
        Column {
            field: Vec::with_capacity(length),
            emission: Vec::with_capacity(length),
            extinction: Vec::with_capacity(length),
        }
    }

    /// One value more of each quantity, that at `index` of another column.
    fn push_from(&mut self, other: &Column<R>, index: usize) {
        let copy = |to: &mut Vec<R>, from: &[R]| to.extend(from.get(index).cloned());
        copy(&mut self.field, &other.field);
        copy(&mut self.emission, &other.emission);
        copy(&mut self.extinction, &other.extinction);
    }
}

/// C and τ, node by node.
fn transfers<R: Clone>(column: Arc<Column<R>>) -> impl Iterator<Item = Transfer<R>> {
    (0..column.extinction.len()).map(move |j| Transfer {
        emission: column.emission[j].clone(),
        extinction: column.extinction[j].clone(),
    })
}

/// Places that are evaluated at once where nothing is kept: little memory, whatever the ray.
const ROW: usize = 512;

/// The same in rows, the first of them of `first`.
fn in_rows<R>(
    mut transfers: impl Iterator<Item = Transfer<R>>,
    first: usize,
) -> impl Iterator<Item = Transfer<Vec<R>>> {
    let mut count = first;
    std::iter::from_fn(move || {
        let mut row = Transfer {
            emission: Vec::with_capacity(count),
            extinction: Vec::with_capacity(count),
        };
        for transfer in transfers.by_ref().take(count) {
            row.emission.push(transfer.emission);
            row.extinction.push(transfer.extinction);
        }
        count = ROW;
        (!row.extinction.is_empty()).then_some(row)
    })
}

/// What a method may ask of a ray that is divided into n equal segments of length d = D/n.
///
/// Node positions are rational multiples of D, rounded once and never accumulated: the node i/n is the
/// same number as the node 2i/2n, bit for bit, in every format.
pub trait Nodes: Debug + Sync {
    /// The format that everything is evaluated in.
    type Format: Format;

    /// The format.
    fn format(&self) -> Self::Format;

    /// D.
    fn length(&self) -> &Rational;

    /// C and τ, where these nodes know that s, C and τ are the same all along the ray: methods then compute a segment once,
    /// and have the bits of n segments computed each by itself.
    fn everywhere(&self) -> Option<Transfer<Number<Self>>> {
        None
    }

    /// The n + 1 values at D·i/n, i = 0 … n.
    fn boundaries(&self, n: u64) -> Arc<Column<Number<Self>>>;

    /// C and τ at D·i/n, i = 0 … n, one after the other: nothing is kept.
    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<Number<Self>>>;

    /// The same in rows: the first begins with the front of the ray, and each has the backs of as many segments as a row of
    /// [`Nodes::rows_inside`] has places.
    fn rows(&self, n: u64) -> impl Iterator<Item = Transfer<Vec<Number<Self>>>> {
        in_rows(self.march(n), ROW + 1)
    }

    /// The n values at D·(j + offset)/n, j = 0 … n − 1; 0 ≤ offset ≤ 1.
    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<Number<Self>>>;

    /// C and τ at the places of [`Nodes::interior`], one after the other: nothing is kept that `interior`
    /// would not keep.
    fn march_inside(
        &self,
        n: u64,
        offset: Rational,
    ) -> impl Iterator<Item = Transfer<Number<Self>>> {
        transfers(self.interior(n, &offset))
    }

    /// The same in rows.
    fn rows_inside(
        &self,
        n: u64,
        offset: Rational,
    ) -> impl Iterator<Item = Transfer<Vec<Number<Self>>>> {
        in_rows(self.march_inside(n, offset), ROW)
    }

    /// The field one step beyond the far end, at D·(n + 1)/n.
    fn beyond(&self, n: u64) -> Number<Self>;

    /// τ(s(λ)) at a place that no other run will ask for.
    fn extinction_at(&self, lambda: &Number<Self>) -> Number<Self>;

    /// The same at many such places, in their order.
    fn extinctions_at(&self, lambda: &[Number<Self>]) -> Vec<Number<Self>> {
        row(lambda.iter().map(|lambda| self.extinction_at(lambda)))
    }

    /// C and τ at a field value that a method has made up (by interpolation).
    fn transfer(&self, s: &Number<Self>) -> Transfer<Number<Self>>;

    /// τ(s) and C(s)·τ(s) as polynomials, where they are.
    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer>;
}

/// The numbers that such nodes are evaluated in.
pub type Number<N> = <<N as Nodes>::Format as Format>::Real;
