//! The asymptotic window: the longest fine-side run of levels whose pairwise orders agree.

use serde::Serialize;

/// Fewest levels a window may have.
pub(super) const MIN_WINDOW: usize = 4;

/// How closely pairwise orders have to agree with the last one, tried in this order.
const TOLERANCES: [f64; 4] = [0.02, 0.05, LOOSEST, 0.25];

/// At this tolerance orders that move one way all along are bias on its way to another order, and no
/// plateau. They move by more than 0.05 then: otherwise they would agree within 0.05 already.
const LOOSEST: f64 = 0.1;

/// The levels an order was fitted in.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
pub struct Window {
    /// Index of the coarsest level.
    pub first: usize,
    /// Index of the finest level.
    pub last: usize,
    /// Step of the coarsest level.
    pub coarsest_step: f64,
    /// Step of the finest level.
    pub finest_step: f64,
    /// Number of segments of the coarsest level, where known.
    pub coarsest_n: Option<u64>,
    /// Number of segments of the finest level, where known.
    pub finest_n: Option<u64>,
    /// How closely the pairwise orders agree with the last: 0.02, 0.05, 0.1 or 0.25; of errors with standard errors,
    /// the largest distance.
    pub tolerance: f64,
}

/// How many pairs at the fine end make a window, and at which tolerance.
pub(super) fn find(orders: &[f64]) -> Option<(usize, f64)> {
    let last = *orders.last()?;
    TOLERANCES.into_iter().find_map(|tolerance| {
        let pairs = orders
            .iter()
            .rev()
            .take_while(|p| (*p - last).abs() <= tolerance)
            .count();
        (pairs + 1 >= MIN_WINDOW).then_some((pairs, tolerance))
    })
}

/// Do these orders, which agree within the tolerance, stand at one order, not on the way to another?
pub(super) fn is_plateau(orders: &[f64], tolerance: f64) -> bool {
    let drift = orders.is_sorted() || orders.iter().rev().is_sorted();
    tolerance < LOOSEST || (tolerance == LOOSEST && !drift)
}
