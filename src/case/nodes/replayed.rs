//! The inputs of another run, exactly.

use super::recorded::Log;
use super::{Column, Nodes, Number};
use crate::case::{Case, PolynomialTransfer, Transfer};
use crate::real::{Format, Mpfr, MpfrReal, Real};
use rug::float::Special;
use rug::{Float, Rational};
use std::collections::HashMap;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A rule's nodes are known to 64 bits beyond those of the format, and a node inside a segment's part is a
/// product of two.
const OFFSET_BITS: u32 = 60;

/// What a [`Recorded`](super::Recorded) run used, for the same methods in the same order in MPFR.
///
/// The case is not evaluated: C, τ and s are those that the recorded run got, errors and all.
#[derive(Debug)]
pub struct Replayed<'a, N: Nodes> {
    nodes: &'a N,
    log: Arc<Log<Number<N>>>,
    format: Mpfr,
    columns: Mutex<HashMap<(u64, Option<Rational>), Arc<Column<MpfrReal>>>>,
    extinctions: AtomicUsize,
    transfers: AtomicUsize,
    /// The same method in another format asked for what was not recorded.
    exhausted: AtomicBool,
    /// λ where τ was asked for, and s where C and τ were: the recorded run may have stood on another side
    /// of a jump.
    places: Mutex<Vec<MpfrReal>>,
    fields: Mutex<Vec<MpfrReal>>,
}

impl<'a, N: Nodes> Replayed<'a, N> {
    pub(super) fn new(nodes: &'a N, log: Arc<Log<Number<N>>>, bits: u32) -> Self {
        Replayed {
            nodes,
            log,
            format: Mpfr { bits },
            columns: Mutex::default(),
            extinctions: AtomicUsize::new(0),
            transfers: AtomicUsize::new(0),
            exhausted: AtomicBool::new(false),
            places: Mutex::default(),
            fields: Mutex::default(),
        }
    }

    /// Whether all that was recorded was asked for again, and nothing else: otherwise the methods took
    /// another way here.
    #[must_use]
    pub fn is_complete(&self) -> bool {
        !self.exhausted.load(Ordering::Relaxed)
            && self.extinctions.load(Ordering::Relaxed) == self.log.extinctions.len()
            && self.transfers.load(Ordering::Relaxed) == self.log.transfers.len()
    }

    /// Whether the recorded run stood on the same side of every jump and kink of `case` as MPFR does, at
    /// every place and at every field value that was asked for.
    pub fn took_the_same_sides<C: Case>(&self, case: &C) -> bool {
        let format = self.nodes.format();
        let same_place = |part: Rational| {
            let lambda = part * self.nodes.length();
            case.branches(&format.ratio(&lambda)) == case.branches(&self.format.ratio(&lambda))
        };
        let columns = self.log.columns.iter().all(|(n, offset)| match offset {
            None => (0..=*n).all(|i| same_place(Rational::from((i, *n)))),
            Some(offset) => (0..*n).all(|j| same_place(Rational::from(offset + j) / *n)),
        });
        let places = kept(&self.places);
        let mut extinctions = self.log.extinctions.iter().zip(places.iter());
        let fields = kept(&self.fields);
        let mut transfers = self.log.transfers.iter().zip(fields.iter());
        columns
            && extinctions
                .all(|((recorded, _), here)| case.branches(recorded) == case.branches(here))
            && transfers.all(|((recorded, _), here)| {
                case.transfer_branches(recorded) == case.transfer_branches(here)
            })
    }

    fn number(&self, x: &Number<N>) -> MpfrReal {
        Float::with_val(self.format.bits, x.to_float()).into()
    }

    fn numbers(&self, values: &[Number<N>]) -> Vec<MpfrReal> {
        values.iter().map(|x| self.number(x)).collect()
    }

    fn of_transfer(&self, transfer: &Transfer<Number<N>>) -> Transfer<MpfrReal> {
        Transfer {
            emission: self.number(&transfer.emission),
            extinction: self.number(&transfer.extinction),
        }
    }

    fn column(&self, n: u64, offset: Option<&Rational>) -> Arc<Column<MpfrReal>> {
        let mut columns = kept(&self.columns);
        let key = (n, offset.cloned());
        if let Some(column) = columns.get(&key) {
            return Arc::clone(column);
        }
        let recorded = match offset.map(|offset| self.recorded_offset(n, offset)) {
            None => self.nodes.boundaries(n),
            Some(offset) => self.nodes.interior(n, &offset),
        };
        let column = Arc::new(Column {
            field: self.numbers(&recorded.field),
            emission: self.numbers(&recorded.emission),
            extinction: self.numbers(&recorded.extinction),
        });
        columns.insert(key, Arc::clone(&column));
        column
    }

    /// The recorded offset that `offset` stands for. An irrational one is known to 2^−(bits + 64) of the
    /// format that asks, so that two formats do not mean the very same rational.
    fn recorded_offset(&self, n: u64, offset: &Rational) -> Rational {
        let of_level = self.log.columns.iter().filter(|(level, _)| *level == n);
        let nearest = of_level
            .filter_map(|(_, recorded)| recorded.as_ref())
            .min_by_key(|recorded| Rational::from(*recorded - offset).abs());
        let tolerance = Rational::from(1) >> (self.nodes.format().bits() + OFFSET_BITS);
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

impl<N: Nodes> Nodes for Replayed<'_, N> {
    type Format = Mpfr;

    fn format(&self) -> Mpfr {
        self.format
    }

    fn length(&self) -> &Rational {
        self.nodes.length()
    }

    fn boundaries(&self, n: u64) -> Arc<Column<MpfrReal>> {
        self.column(n, None)
    }

    fn march(&self, n: u64) -> impl Iterator<Item = Transfer<MpfrReal>> {
        let column = self.boundaries(n);
        (0..column.extinction.len()).map(move |i| Transfer {
            emission: column.emission[i].clone(),
            extinction: column.extinction[i].clone(),
        })
    }

    fn interior(&self, n: u64, offset: &Rational) -> Arc<Column<MpfrReal>> {
        self.column(n, Some(offset))
    }

    fn beyond(&self, n: u64) -> MpfrReal {
        self.number(&self.nodes.beyond(n))
    }

    fn extinction_at(&self, lambda: &MpfrReal) -> MpfrReal {
        kept(&self.places).push(lambda.clone());
        let index = self.extinctions.fetch_add(1, Ordering::Relaxed);
        match self.log.extinctions.get(index) {
            Some((_, extinction)) => self.number(extinction),
            None => self.nothing(),
        }
    }

    fn transfer(&self, s: &MpfrReal) -> Transfer<MpfrReal> {
        let index = self.transfers.fetch_add(1, Ordering::Relaxed);
        kept(&self.fields).push(s.clone());
        match self.log.transfers.get(index) {
            Some((_, transfer)) => self.of_transfer(transfer),
            None => Transfer {
                emission: self.nothing(),
                extinction: self.nothing(),
            },
        }
    }

    fn polynomial_transfer(&self) -> Option<&PolynomialTransfer> {
        self.nodes.polynomial_transfer()
    }
}
