//! One cell of the table.

use super::{Kind, Level, Measured, Place};
use crate::convergence::{Fit, Verdict};
use crate::method::Expected;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// One rule on one case: the order of its errors beside theory.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// What breaks.
    pub kind: Kind,
    /// Where.
    pub place: Place,
    /// The row's name.
    pub rule: &'static str,
    /// The method: inner rule × outer rule.
    pub method: String,
    /// The order that theory gives on the numbers of segments that were run.
    pub theory: Expected,
    /// The order that it gives wherever the break lies.
    pub guaranteed: Expected,
    /// The order measured, and what that says of theory.
    pub measured: Measured,
    /// The errors, level by level.
    pub levels: Vec<Level>,
    /// What a usual study, on a ladder of doublings, sees.
    pub usual: Fit,
}

impl Cell {
    /// Whether the measurement says something else than theory.
    #[must_use]
    pub fn contradicts_theory(&self) -> bool {
        match self.measured.verdict {
            Verdict::Confirmed | Verdict::Fitted | Verdict::Blind => false,
            // Where there should be an order, its lack is a contradiction too: levels and precision suffice.
            Verdict::Exact => self.theory != Expected::Exact,
            _ => true,
        }
    }
}

/// A number where it is one, a word otherwise.
pub(super) fn theory<M: SerializeMap>(
    map: &mut M,
    key: &'static str,
    expected: Expected,
) -> Result<(), M::Error> {
    match expected {
        Expected::Order(order) | Expected::Blind { general: order, .. } => {
            map.serialize_entry(key, &order)
        }
        Expected::Exact => map.serialize_entry(key, "exact"),
        Expected::Unknown => map.serialize_entry(key, &None::<f64>),
    }
}

impl Serialize for Cell {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("kind", &self.kind)?;
        map.serialize_entry("place", &self.place)?;
        map.serialize_entry("rule", self.rule)?;
        map.serialize_entry("method", &self.method)?;
        theory(&mut map, "expected_order", self.theory)?;
        theory(&mut map, "guaranteed_order", self.guaranteed)?;
        map.serialize_entry("order", &self.measured.order)?;
        map.serialize_entry("half_width", &self.measured.half_width)?;
        map.serialize_entry("verdict", &self.measured.verdict)?;
        map.serialize_entry("levels", &self.levels)?;
        map.serialize_entry("usual", &self.usual)?;
        map.end()
    }
}
