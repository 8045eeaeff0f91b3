//! What a run really used, kept to be used again.

use super::{Column, Nodes, Number, Replayed};
use crate::case::{PolynomialTransfer, Transfer};
use rug::Rational;
use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Nodes that remember what was asked of them: a run in one format whose inputs another can take over.
///
/// Values at places of a grid are looked up again; values at places or at field values that a method made up
/// come back in the order in which they were asked for.
#[derive(Debug)]
pub struct Recorded<'a, N: Nodes> {
    nodes: &'a N,
    log: Mutex<Log<Number<N>>>,
}

/// The inputs of a run.
#[derive(Clone, Debug)]
pub struct Recording<'a, N: Nodes> {
    nodes: &'a N,
    log: Arc<Log<Number<N>>>,
}

impl<'a, N: Nodes> Recording<'a, N> {
    /// The inputs, exactly, for runs in MPFR with `bits` bits: at least as many as the recorded format has,
    /// or they are rounded.
    #[must_use]
    pub fn replay(&self, bits: u32) -> Replayed<'a, N> {
        Replayed::new(self.nodes, Arc::clone(&self.log), bits)
    }
}

/// What was asked for.
#[derive(Clone, Debug)]
pub(super) struct Log<R> {
    /// By n and offset; boundaries have no offset.
    pub(super) columns: BTreeSet<(u64, Option<Rational>)>,
    /// λ and τ there.
    pub(super) extinctions: Vec<(R, R)>,
    /// s, C and τ.
    pub(super) transfers: Vec<(R, Transfer<R>)>,
}

impl<'a, N: Nodes> Recorded<'a, N> {
    /// Nothing recorded yet.
    pub fn new(nodes: &'a N) -> Self {
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
    pub fn recording(&self) -> Recording<'a, N> {
        Recording {
            nodes: self.nodes,
            log: Arc::new(self.log().clone()),
        }
    }

    fn log(&self) -> MutexGuard<'_, Log<Number<N>>> {
        // Records go in whole, so a poisoned log is still sound.
        self.log.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<N: Nodes> Nodes for Recorded<'_, N> {
    type Format = N::Format;

    fn format(&self) -> N::Format {
        self.nodes.format()
    }

    fn length(&self) -> &Rational {
        self.nodes.length()
    }

    fn boundaries(&self, n: u64) -> Arc<Column<Number<N>>> {
        self.log().columns.insert((n, None));
        self.nodes.boundaries(n)
    }

    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<Number<N>>> {
        self.log().columns.insert((n, None));
        self.nodes.march(n)
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<Number<N>>> {
        self.log().columns.insert((n, Some(offset.clone())));
        self.nodes.interior(n, offset)
    }

    fn beyond(&self, n: u64) -> Number<N> {
        self.nodes.beyond(n)
    }

    fn extinction_at(&self, lambda: &Number<N>) -> Number<N> {
        let extinction = self.nodes.extinction_at(lambda);
        let record = (lambda.clone(), extinction.clone());
        self.log().extinctions.push(record);
        extinction
    }

    fn transfer(&self, s: &Number<N>) -> Transfer<Number<N>> {
        let transfer = self.nodes.transfer(s);
        self.log().transfers.push((s.clone(), transfer.clone()));
        transfer
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.nodes.polynomial_transfer()
    }
}
