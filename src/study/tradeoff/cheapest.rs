//! The cheapest way to an error, and what is usually done beside it.

use super::catalogue::{USUAL_FORMAT, USUAL_METHOD};
use super::{Cost, Point, Unit};
use rug::Float;
use std::cmp::Ordering;
use std::ops::RangeInclusive;

/// The errors asked for are 10^(−k).
pub(super) const DIGITS: RangeInclusive<u32> = 2..=30;

/// The cheapest way to an error.
#[derive(Clone, Copy, Debug)]
pub struct Goal<'r> {
    /// The error is at most 10^(−digits).
    pub digits: u32,
    /// Unit and point; `None` where nothing that was run gets there.
    pub best: Option<(&'r Unit, &'r Point)>,
    /// The cheapest of the usual choice, left Riemann sums with opacity 1 − e^(−τd) in binary32; `None` where no
    /// n that was run gets there.
    pub usual: Option<(&'r Unit, &'r Point)>,
}

/// The cheapest way to each of 1e-2, 1e-3, … 1e-30, by `cost`, in the units of one case; of equals that of
/// fewer bits, then of fewer operations.
#[must_use]
pub fn cheapest<'r>(units: &[&'r Unit], cost: Cost) -> Vec<Goal<'r>> {
    let all = || {
        units
            .iter()
            .flat_map(|unit| unit.points.iter().map(move |point| (*unit, point)))
    };
    let usual = || all().filter(|(unit, point)| is_usual(unit, point));
    DIGITS
        .map(|digits| Goal {
            digits,
            best: least(all().filter(|(_, point)| !point.only_usual), digits, cost),
            usual: least(usual(), digits, cost),
        })
        .collect()
}

/// Whether it is what most renderers do.
pub(super) fn is_usual(unit: &Unit, point: &Point) -> bool {
    unit.format == USUAL_FORMAT && point.method.name() == USUAL_METHOD
}

fn least<'r>(
    points: impl Iterator<Item = (&'r Unit, &'r Point)>,
    digits: u32,
    cost: Cost,
) -> Option<(&'r Unit, &'r Point)> {
    let goal = Float::with_val(128, 10).recip();
    let goal = Float::with_val(128, rug::ops::Pow::pow(goal, digits));
    let reaches = points.filter(|(_, point)| point.outcome.error().is_some_and(|e| e <= goal));
    let priced = reaches.filter_map(|(unit, point)| Some((cost.of(point)?, unit, point)));
    priced.min_by(order).map(|(_, unit, point)| (unit, point))
}

fn order(a: &(f64, &Unit, &Point), b: &(f64, &Unit, &Point)) -> Ordering {
    let work = |point: &Point| point.counts.operations();
    a.0.total_cmp(&b.0)
        .then(a.1.bits.cmp(&b.1.bits))
        .then(work(a.2).cmp(&work(b.2)))
}
