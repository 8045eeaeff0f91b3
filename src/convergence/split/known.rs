//! Exponentials of a level without rounding, kept for those who come near: replays, whose depths differ by an input's rounding.

use crate::method::{Exponential, Exponentials, Row};
use crate::real::{Mpfr, MpfrReal, Near, Real, row};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Depths and their exponentials.
#[derive(Debug)]
struct Values {
    depths: Vec<MpfrReal>,
    exponentials: Vec<MpfrReal>,
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

    /// The row of the same places by another rule whose depth at the far end is nearest.
    fn nearest(&self, of: &Row, depths: &[MpfrReal]) -> Option<Arc<Values>> {
        let end = depths.last()?;
        let distance = |values: &Values| {
            let other = values.depths.last()?;
            Some((end.clone() - other).log2_abs())
        };
        let rows = self.rows();
        let alike = rows.iter().filter(|(row, values)| {
            let same = (&row.scope, &row.offset) == (&of.scope, &of.offset);
            same && values.depths.len() == depths.len()
        });
        let with = alike.filter_map(|(_, values)| Some((distance(values)?, values)));
        let nearest = with.min_by(|(a, _), (b, _)| a.total_cmp(b));
        nearest.map(|(_, values)| Arc::clone(values))
    }

    /// Exponentials of depths beside known ones, one by one where a series is quicker than a function.
    fn beside(&self, known: &Values, depths: &[MpfrReal]) -> Vec<MpfrReal> {
        let mut near = Near::new(self.format.bits);
        let both = known.depths.iter().zip(&known.exponentials);
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
        depths: &[MpfrReal],
    ) -> Vec<MpfrReal> {
        if exponential != Exponential::Exact {
            return each(exponential, depths);
        }
        let values = Arc::new(Values {
            depths: depths.to_vec(),
            exponentials: match self.0.nearest(&of, depths) {
                Some(known) => self.0.beside(&known, depths),
                None => each(exponential, depths),
            },
        });
        self.0.rows().push((of, Arc::clone(&values)));
        values.exponentials.clone()
    }
}

/// A replay of it.
pub(super) struct Again<'k>(pub(super) &'k Known);

impl Exponentials<MpfrReal> for Again<'_> {
    fn of_negatives(
        &self,
        exponential: Exponential,
        of: Row,
        depths: &[MpfrReal],
    ) -> Vec<MpfrReal> {
        match (self.0.find(&of), exponential) {
            (Some(known), Exponential::Exact) if known.depths.len() == depths.len() => {
                self.0.beside(&known, depths)
            }
            _ => each(exponential, depths),
        }
    }
}

fn each(exponential: Exponential, depths: &[MpfrReal]) -> Vec<MpfrReal> {
    row(depths.iter().map(|depth| exponential.of_negative(depth)))
}
