//! The inputs of another run, exactly.

use super::{Column, Nodes, Recording, transfers};
use crate::case::{PolynomialTransfer, Transfer};
use crate::real::{Mpfr, MpfrReal};
use rug::float::Special;
use rug::{Float, Rational};
use std::collections::{BTreeSet, HashMap};
use std::fmt::Debug;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A rule's nodes are known to 64 bits beyond those of the format, and a node inside a segment's part is a
/// product of two.
const OFFSET_BITS: u32 = 60;

/// n, and the offset inside segments.
pub(super) type Key = (u64, Option<Rational>);

/// Nodes of any format, their values as they are.
pub(super) trait Exactly: Debug + Sync + Send {
    fn bits(&self) -> u32;
    fn length(&self) -> &Rational;
    /// Rounded to that many bits: exact where they are no fewer than the nodes'.
    fn column(&self, n: u64, offset: Option<&Rational>, bits: u32) -> Column<MpfrReal>;
    fn beyond(&self, n: u64) -> Float;
    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer>;
}

/// What a [`Recorded`](super::Recorded) run used, for the same methods in the same order in MPFR.
///
/// The case is not evaluated: C, τ and s are those that the recorded run got, errors and all.
#[derive(Debug)]
pub struct Replayed<'a> {
    recording: Recording<'a>,
    format: Mpfr,
    /// By n and offset; boundaries have no offset.
    columns: Mutex<HashMap<Key, Arc<Column<MpfrReal>>>>,
    /// The same method in another format asked for what was not recorded.
    exhausted: AtomicBool,
    extinctions: AtomicUsize,
    transfers: AtomicUsize,
    /// λ where τ was asked for, and s where C and τ were: the recorded run may have stood on another side
    /// of a jump.
    places: Mutex<Vec<MpfrReal>>,
    fields: Mutex<Vec<MpfrReal>>,
}

impl<'a> Replayed<'a> {
    pub(super) fn new(recording: Recording<'a>, bits: u32) -> Self {
        Replayed {
            recording,
            format: Mpfr { bits },
            columns: Mutex::default(),
            exhausted: AtomicBool::new(false),
            extinctions: AtomicUsize::new(0),
            transfers: AtomicUsize::new(0),
            places: Mutex::default(),
            fields: Mutex::default(),
        }
    }

    /// Whether all that was recorded was asked for again, and nothing else: otherwise the methods took
    /// another way here.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        let asked = |count: &AtomicUsize| count.load(Ordering::Relaxed);
        !self.exhausted.load(Ordering::Relaxed)
            && asked(&self.extinctions) == self.recording.extinctions.len()
            && asked(&self.transfers) == self.recording.transfers.len()
    }

    pub(super) fn columns(&self) -> &BTreeSet<Key> {
        &self.recording.columns
    }

    pub(super) fn places(&self) -> MutexGuard<'_, Vec<MpfrReal>> {
        kept(&self.places)
    }

    pub(super) fn fields(&self) -> MutexGuard<'_, Vec<MpfrReal>> {
        kept(&self.fields)
    }

    fn number(&self, x: &Float) -> MpfrReal {
        Float::with_val(self.format.bits, x).into()
    }

    fn column(&self, n: u64, offset: Option<&Rational>) -> Arc<Column<MpfrReal>> {
        let mut columns = kept(&self.columns);
        let key = (n, offset.cloned());
        if let Some(column) = columns.get(&key) {
            return Arc::clone(column);
        }
        let offset = offset.map(|offset| self.recorded_offset(n, offset));
        let nodes = &self.recording.nodes;
        let column = Arc::new(nodes.column(n, offset.as_ref(), self.format.bits));
        columns.insert(key, Arc::clone(&column));
        column
    }

    /// The recorded offset that `offset` stands for. An irrational one is known to 2^−(bits + 64) of the
    /// format that asks, so that two formats do not mean the very same rational.
    fn recorded_offset(&self, n: u64, offset: &Rational) -> Rational {
        let of_level = self.columns().iter().filter(|(level, _)| *level == n);
        let nearest = of_level
            .filter_map(|(_, recorded)| recorded.as_ref())
            .min_by_key(|recorded| Rational::from(*recorded - offset).abs());
        let tolerance = Rational::from(1) >> (self.recording.nodes.bits() + OFFSET_BITS);
        match nearest {
            Some(recorded) if Rational::from(recorded - offset).abs() <= tolerance => {
                recorded.clone()
            }
            _ => {
                self.exhausted.store(true, Ordering::Relaxed);
                offset.clone()
            }
        }
    }

    /// What a method gets that asks for more than was recorded: nothing that could pass for a number.
    fn nothing(&self) -> MpfrReal {
        self.exhausted.store(true, Ordering::Relaxed);
        Float::with_val(self.format.bits, Special::Nan).into()
    }
}

/// What stands in `mutex`: entries go in whole, so that of a poisoned one too.
fn kept<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Nodes for Replayed<'_> {
    type Format = Mpfr;

    fn format(&self) -> Mpfr {
        self.format
    }

    fn length(&self) -> &Rational {
        self.recording.nodes.length()
    }

    fn boundaries(&self, n: u64) -> Arc<Column<MpfrReal>> {
        self.column(n, None)
    }

    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<MpfrReal>> {
        transfers(self.boundaries(n))
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<MpfrReal>> {
        self.column(n, Some(offset))
    }

    fn beyond(&self, n: u64) -> MpfrReal {
        self.number(&self.recording.nodes.beyond(n))
    }

    fn extinction_at(&self, lambda: &MpfrReal) -> MpfrReal {
        kept(&self.places).push(lambda.clone());
        let index = self.extinctions.fetch_add(1, Ordering::Relaxed);
        match self.recording.extinctions.get(index) {
            Some(extinction) => self.number(extinction),
            None => self.nothing(),
        }
    }

    fn transfer(&self, s: &MpfrReal) -> Transfer<MpfrReal> {
        kept(&self.fields).push(s.clone());
        let index = self.transfers.fetch_add(1, Ordering::Relaxed);
        match self.recording.transfers.get(index) {
            Some(transfer) => Transfer {
                emission: self.number(&transfer.emission),
                extinction: self.number(&transfer.extinction),
            },
            None => Transfer {
                emission: self.nothing(),
                extinction: self.nothing(),
            },
        }
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.recording.nodes.polynomial_transfer()
    }
}
