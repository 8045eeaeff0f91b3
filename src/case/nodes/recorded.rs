//! What a run really used, kept to be used again.

use super::replayed::{Exactly, Key, Replayed};
use super::{AnyNodes, Column, Nodes};
use crate::case::{Case, PolynomialTransfer, Transfer};
use crate::real::{Format, MpfrReal, Real, row};
use rug::{Float, Rational};
use std::collections::BTreeSet;
use std::fmt::{self, Debug};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Nodes that remember what was asked of them: a run in one format whose inputs another can take over.
///
/// Values at places of a grid are looked up again; values at places or at field values that a method made up
/// come back in the order in which they were asked for.
#[derive(Debug)]
pub struct Recorded<'a, F: Format> {
    nodes: AnyNodes<'a, F>,
    log: Mutex<Log<F::Real>>,
}

/// What was asked for.
struct Log<R> {
    /// By n and offset; boundaries have no offset.
    columns: BTreeSet<Key>,
    /// λ, and τ there.
    extinctions: Vec<(R, R)>,
    /// s, and C and τ of it.
    transfers: Vec<(R, Transfer<R>)>,
}

/// How much was asked for: what it was would be pages.
impl<R> Debug for Log<R> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (columns, extinctions) = (self.columns.len(), self.extinctions.len());
        let transfers = self.transfers.len();
        write!(
            f,
            "{columns} columns, {extinctions} extinctions, {transfers} transfers"
        )
    }
}

/// The inputs of a run, exactly.
#[derive(Clone, Debug)]
pub struct Recording<'a> {
    pub(super) nodes: Arc<dyn Exactly + 'a>,
    pub(super) columns: Arc<BTreeSet<Key>>,
    /// τ, in the order in which it was asked for.
    pub(super) extinctions: Arc<[Float]>,
    /// C and τ.
    pub(super) transfers: Arc<[Transfer<Float>]>,
}

impl<'a> Recording<'a> {
    /// The inputs for runs in MPFR with `bits` bits: at least as many as the recorded format has, or they are
    /// rounded.
    #[must_use]
    pub fn replay(&self, bits: u32) -> Replayed<'a> {
        Replayed::new(self.clone(), bits)
    }

    /// Whether all of it is values at places of a grid, which come back to whoever asks, in whatever order.
    #[must_use]
    pub fn is_of_columns(&self) -> bool {
        self.extinctions.is_empty() && self.transfers.is_empty()
    }
}

impl<'a, F: Format> Recorded<'a, F> {
    /// Nothing recorded yet.
    #[must_use]
    pub fn new(nodes: AnyNodes<'a, F>) -> Self {
        Recorded {
            nodes,
            log: Mutex::new(Log {
                columns: BTreeSet::new(),
                extinctions: Vec::new(),
                transfers: Vec::new(),
            }),
        }
    }

    /// What was recorded so far; what is asked for later is no part of it.
    pub fn recording(&self) -> Recording<'a> {
        let log = self.log();
        let extinctions = log.extinctions.iter().map(|(_, tau)| tau.to_float());
        let transfers = log.transfers.iter().map(|(_, transfer)| Transfer {
            emission: transfer.emission.to_float(),
            extinction: transfer.extinction.to_float(),
        });
        Recording {
            nodes: Arc::new(Numbers(self.nodes)),
            columns: Arc::new(log.columns.clone()),
            extinctions: extinctions.collect(),
            transfers: transfers.collect(),
        }
    }

    /// Whether the recorded run stood on the same side of every jump and kink of `case` as `replayed` does, at
    /// every place and at every field value that was asked for there.
    pub fn took_the_sides_of<C: Case>(&self, case: &C, replayed: &Replayed<'_>) -> bool {
        let log = self.log();
        let (here, there) = (self.nodes.format(), replayed.format());
        let same_place = |part: Rational| {
            let lambda = part * self.nodes.length();
            case.branches(&here.ratio(&lambda)) == case.branches(&there.ratio(&lambda))
        };
        let columns = replayed.columns().iter().all(|(n, offset)| match offset {
            None => (0..=*n).all(|i| same_place(Rational::from((i, *n)))),
            Some(offset) => (0..*n).all(|j| same_place(Rational::from(offset + j) / *n)),
        });
        let (places, fields) = (replayed.places(), replayed.fields());
        let mut extinctions = log.extinctions.iter().zip(places.iter());
        let mut transfers = log.transfers.iter().zip(fields.iter());
        columns
            && extinctions.all(|((a, _), b)| case.branches(a) == case.branches(b))
            && transfers.all(|((a, _), b)| case.transfer_branches(a) == case.transfer_branches(b))
    }

    fn log(&self) -> MutexGuard<'_, Log<F::Real>> {
        // Records go in whole, so a poisoned log is still sound.
        self.log.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Nodes of a format as numbers of MPFR: apart from it, no code of a replay depends on the format.
#[derive(Debug)]
struct Numbers<'a, F: Format>(AnyNodes<'a, F>);

impl<F: Format> Exactly for Numbers<'_, F> {
    fn bits(&self) -> u32 {
        self.0.format().bits()
    }

    fn length(&self) -> &Rational {
        self.0.length()
    }

    fn column(&self, n: u64, offset: Option<&Rational>, bits: u32) -> Column<MpfrReal> {
        let column = match offset {
            None => self.0.boundaries(n),
            Some(offset) => self.0.interior(n, offset),
        };
        let numbers =
            |values: &[F::Real]| row(values.iter().map(|x| MpfrReal::from(x.to_float_of(bits))));
        Column {
            field: numbers(&column.field),
            emission: numbers(&column.emission),
            extinction: numbers(&column.extinction),
        }
    }

    fn beyond(&self, n: u64) -> Float {
        self.0.beyond(n).to_float()
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.0.polynomial_transfer()
    }
}

impl<F: Format> Nodes for Recorded<'_, F> {
    type Format = F;

    fn format(&self) -> F {
        self.nodes.format()
    }

    fn length(&self) -> &Rational {
        self.nodes.length()
    }

    fn boundaries(&self, n: u64) -> Arc<Column<F::Real>> {
        self.log().columns.insert((n, None));
        self.nodes.boundaries(n)
    }

    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<F::Real>> {
        self.log().columns.insert((n, None));
        self.nodes.march(n)
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<F::Real>> {
        self.log().columns.insert((n, Some(offset.clone())));
        self.nodes.interior(n, offset)
    }

    fn beyond(&self, n: u64) -> F::Real {
        self.nodes.beyond(n)
    }

    fn extinction_at(&self, lambda: &F::Real) -> F::Real {
        let extinction = self.nodes.extinction_at(lambda);
        let record = (lambda.clone(), extinction.clone());
        self.log().extinctions.push(record);
        extinction
    }

    fn transfer(&self, s: &F::Real) -> Transfer<F::Real> {
        let transfer = self.nodes.transfer(s);
        self.log().transfers.push((s.clone(), transfer.clone()));
        transfer
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.nodes.polynomial_transfer()
    }
}
