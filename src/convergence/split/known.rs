//! Exponentials of a level without rounding, kept for those who come near: replays, whose depths differ by an input's rounding.

use crate::method::{Alone, Depths, Exponential, Exponentials, Row};
use crate::real::{Mpfr, MpfrReal, Near, Real, row};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Exponentials come of one of MPFR by at most so many series one after the other.
const MOST_SERIES: u32 = 8;
/// What they are off by is then less than 2^(this − bits) of themselves: 2^−bits and 1.25·2^−bits for each series, a replay's
/// or a run's among them.
const ERROR_BITS: u32 = 4;

/// Depths and their exponentials.
#[derive(Debug)]
struct Values {
    /// How many series lie behind the exponentials.
    series: u32,
    depths: Depths<MpfrReal>,
    exponentials: Arc<Vec<MpfrReal>>,
}

/// What one level took of exponentials.
#[derive(Debug)]
pub(super) struct Known {
    format: Mpfr,
    rows: Mutex<Vec<(Row, Arc<Values>)>>,
}

impl Known {
    /// Nothing yet, in that format.
    pub(super) fn new(format: Mpfr) -> Self {
        Known {
            format,
            rows: Mutex::default(),
        }
    }

    fn rows(&self) -> MutexGuard<'_, Vec<(Row, Arc<Values>)>> {
        // Rows go in whole, so a poisoned list is still sound.
        self.rows.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn find(&self, wanted: &Row) -> Option<Arc<Values>> {
        let rows = self.rows();
        let found = rows.iter().find(|(row, _)| row == wanted);
        found.map(|(_, values)| Arc::clone(values))
    }

    /// The row of the same places by the same rule, of so many exponentials.
    fn alike(&self, of: &Row, exponential: Exponential, count: usize) -> Option<Arc<Values>> {
        let found = self
            .find(of)
            .filter(|_| exponential == Exponential::Exact)?;
        (found.depths.values().len() == count).then_some(found)
    }

    /// The row of the same places by another rule whose depth at the far end is nearest.
    fn nearest(&self, of: &Row, depths: &[MpfrReal]) -> Option<Arc<Values>> {
        let end = depths.last()?;
        let distance = |values: &Values| {
            let other = values.depths.values().last()?;
            Some((end.clone() - other).log2_abs())
        };
        let rows = self.rows();
        let alike = rows.iter().filter(|(row, values)| {
            let same = (&row.scope, &row.offset) == (&of.scope, &of.offset);
            same && values.series < MOST_SERIES && values.depths.values().len() == depths.len()
        });
        let with = alike.filter_map(|(_, values)| Some((distance(values)?, values)));
        let nearest = with.min_by(|(a, _), (b, _)| a.total_cmp(b));
        nearest.map(|(_, values)| Arc::clone(values))
    }

    /// Exponentials of depths beside known ones, one by one where a series is quicker than a function.
    fn beside(&self, known: &Values, depths: &[MpfrReal]) -> Vec<MpfrReal> {
        let mut near = Near::new(self.format.bits);
        let both = known.depths.values().iter().zip(known.exponentials.iter());
        row(depths.iter().zip(both).map(|(x, (y, of_y))| {
            let beside = near.exp_of_negative(x, y, of_y);
            beside.unwrap_or_else(|| Exponential::Exact.of_negative(x))
        }))
    }
}

/// The level without rounding itself: depths by one rule lie near those by another, and all are kept.
pub(super) struct First<'k>(pub(super) &'k Known);

impl Exponentials<MpfrReal> for First<'_> {
    fn of_negatives(
        &self,
        exponential: Exponential,
        of: Row,
        depths: Depths<MpfrReal>,
    ) -> Arc<Vec<MpfrReal>> {
        if exponential != Exponential::Exact {
            return Alone.of_negatives(exponential, of, depths);
        }
        let (series, exponentials) = match self.0.nearest(&of, depths.values()) {
            Some(known) => (known.series + 1, self.0.beside(&known, depths.values())),
            None => (0, exponential.of_negatives(depths.values())),
        };
        let exponentials = Arc::new(exponentials);
        let values = Values {
            series,
            depths,
            exponentials: Arc::clone(&exponentials),
        };
        self.0.rows().push((of, Arc::new(values)));
        exponentials
    }
}

/// A replay of it.
pub(super) struct Again<'k>(pub(super) &'k Known);

impl Exponentials<MpfrReal> for Again<'_> {
    fn of_negatives(
        &self,
        exponential: Exponential,
        of: Row,
        depths: Depths<MpfrReal>,
    ) -> Arc<Vec<MpfrReal>> {
        match self.0.alike(&of, exponential, depths.values().len()) {
            Some(known) => Arc::new(self.0.beside(&known, depths.values())),
            None => Alone.of_negatives(exponential, of, depths),
        }
    }
}

/// A run in a format of MPFR with fewer bits, whose exponentials are the level's own, rounded: the same bits as MPFR gives
/// them, which rounds correctly too.
pub(super) struct Rounded<'k>(pub(super) &'k Known);

impl<R: Real> Exponentials<R> for Rounded<'_> {
    fn of_negatives(&self, exponential: Exponential, of: Row, depths: Depths<R>) -> Arc<Vec<R>> {
        let depths_here = depths.values();
        let Some(known) = self.0.alike(&of, exponential, depths_here.len()) else {
            return Alone.of_negatives(exponential, of, depths);
        };
        let bits = self.0.format.bits;
        let mut near = Near::new(bits);
        let both = known.depths.values().iter().zip(known.exponentials.iter());
        Arc::new(row(depths_here.iter().zip(both).map(|(x, (y, of_y))| {
            let wide = MpfrReal::from(x.to_float_of(bits));
            let beside = near.exp_of_negative(&wide, y, of_y);
            let rounded = beside.and_then(|beside| x.rounded(&beside, ERROR_BITS));
            rounded.unwrap_or_else(|| exponential.of_negative(x))
        })))
    }
}
