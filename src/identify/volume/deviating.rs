//! What is read of a volume otherwise than it is to be: linear between grid points and between entries, from end to end.

use super::{Lookup, Optics};
use crate::identify::deviation::Deviation;
use crate::identify::part::short;

/// What reads grid or table otherwise.
pub(in crate::identify) fn deviations(optics: &Optics) -> Vec<Deviation> {
    let deviation = |name, does: String, linear: Option<&str>| Deviation {
        name,
        value: None,
        bracket: None,
        exact: false,
        probe: "emission in one entry of the table alone",
        validated: Vec::new(),
        does,
        instead_of: linear.map(Into::into),
    };
    let looked = |name, lookup, of: &str| {
        let taken = match lookup {
            Lookup::Linear => return None,
            Lookup::Nearest => "the nearest one is taken",
            Lookup::Below => "the one before is taken",
        };
        let does = format!("between {of} {taken}");
        Some(deviation(name, does, Some("linear between both")))
    };
    let [begin, end] = optics.cells;
    let is_moved = begin.abs() > 0.0 || end.abs() > 0.0;
    let ends = is_moved.then(|| {
        let (begin, end) = (short(begin), short(end));
        let does = format!(
            "the march begins {begin} cells behind the front of the ray, and ends {end} cells behind its back"
        );
        deviation("grid-ends", does, None)
    });
    let is_shifted = optics.intervals.abs() > 0.0 || optics.shift.abs() > 0.0;
    let entries = is_shifted.then(|| {
        let (more, shift) = (short(optics.intervals - 1.0), short(optics.shift));
        let does = format!("the range of the field is E + ({more}) entries wide, moved by {shift}");
        deviation("table-entries", does, Some("E − 1, not moved"))
    });
    let lookups = [
        looked("grid-lookup", optics.field, "grid points"),
        looked("table-lookup", optics.table, "entries of the table"),
    ];
    lookups
        .into_iter()
        .chain([ends, entries])
        .flatten()
        .collect()
}
