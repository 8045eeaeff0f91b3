//! Exponentials of a level without rounding, kept for those who come near: replays, whose depths differ by an input's rounding.

use crate::method::{Exponential, Exponentials, Row};
use crate::real::{Mpfr, MpfrReal, Near, row};
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
}

/// The level without rounding itself: each row by itself, and kept.
pub(super) struct First<'k>(pub(super) &'k Known);

impl Exponentials<MpfrReal> for First<'_> {
    fn of_negatives(
        &self,
        exponential: Exponential,
        of: Row,
        depths: &[MpfrReal],
    ) -> Vec<MpfrReal> {
        let plain = row(depths.iter().map(|depth| exponential.of_negative(depth)));
        if exponential == Exponential::Exact {
            let values = Values {
                depths: depths.to_vec(),
                exponentials: plain.clone(),
            };
            self.0.rows().push((of, Arc::new(values)));
        }
        plain
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
        let known = self.0.find(&of);
        let known = known.filter(|known| known.depths.len() == depths.len());
        let (Some(known), Exponential::Exact) = (known, exponential) else {
            return row(depths.iter().map(|depth| exponential.of_negative(depth)));
        };
        let mut near = Near::new(self.0.format.bits);
        let both = known.depths.iter().zip(&known.exponentials);
        row(depths.iter().zip(both).map(|(x, (y, of_y))| {
            let beside = near.exp_of_negative(x, y, of_y);
            beside.unwrap_or_else(|| exponential.of_negative(x))
        }))
    }
}
