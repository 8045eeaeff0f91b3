//! Where errors stop falling, found in the errors alone.

use super::FLOOR_MARGIN;
use std::cmp::Ordering;

/// Levels that show that errors have stopped falling.
const LEVELS: usize = 3;

/// The level whose error is the floor: the largest of the first few that are no larger than one of the last two.
///
/// `heights` are log₂|e|, coarse to fine. `None` where errors fall to the end, or did not fall by 30 floors before.
pub(super) fn stops_at(heights: &[f64]) -> Option<usize> {
    let [coarsest, .., before, last] = heights else {
        return None;
    };
    let end = before.max(*last);
    let first = heights.iter().position(|height| *height <= end)?;
    let tail = heights.get(first..).filter(|tail| tail.len() >= LEVELS)?;
    let largest = tail.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if *coarsest <= largest + f64::from(FLOOR_MARGIN).log2() {
        return None;
    }
    let order =
        |a: &(usize, &f64), b: &(usize, &f64)| a.1.partial_cmp(b.1).unwrap_or(Ordering::Equal);
    let (place, height) = tail.iter().enumerate().take(LEVELS).max_by(order)?;
    height.is_finite().then_some(first + place)
}
