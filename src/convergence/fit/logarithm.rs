//! e = d^p·(c₁ − c₂·ln d): an order up to a logarithm, whose pairwise orders creep towards p for ever.

use super::drift::Local;

/// Pairs that the family has to fit.
const PAIRS: usize = 5;
/// Of the change of the orders over these pairs, the share that may stay unexplained.
const UNEXPLAINED: f64 = 0.005;
/// What a power as the next term leaves unexplained has to be this many times as much.
const ALONE: f64 = 10.0;

/// p and how far it may be off, where a logarithm explains the finest orders and a second power does not.
pub(super) fn logarithm(locals: &[Local]) -> Option<(f64, f64)> {
    let finest = locals.get(locals.len().checked_sub(PAIRS)?..)?;
    let [.., before, last] = finest else {
        return None;
    };
    let zero = zero_of_factor(before, last)?;
    let left = |local: &Local| local.order - share(local, zero);
    let order = left(last);
    let unexplained = finest.iter().map(|local| (left(local) - order).abs());
    let unexplained = unexplained.fold(0.0, f64::max);
    let explained = (finest.first()?.order - last.order).abs();
    if unexplained > UNEXPLAINED * explained || ALONE * unexplained > missed_by_a_power(finest)? {
        return None;
    }
    Some((order, (order - last.order).abs() / 2.0))
}

/// What the factor (z − log₂ d) adds to the order of a pair: below 0, since it grows.
fn share(local: &Local, zero: f64) -> f64 {
    ((zero - local.coarse) / (zero - local.fine)).log2() / (local.coarse - local.fine)
}

/// The z of the factor from the rise of the order from one pair to the next.
fn zero_of_factor(before: &Local, last: &Local) -> Option<f64> {
    let rise = last.order - before.order;
    let rise_of = |zero: f64| share(last, zero) - share(before, zero);
    // The rise falls from ∞ at the coarsest level as z grows.
    let (mut low, mut high) = (before.coarse, before.coarse + 1e4);
    if rise <= rise_of(high) {
        return None;
    }
    for _ in 0..100 {
        let middle = low + (high - low) / 2.0;
        if rise_of(middle) > rise {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(high)
}

/// How far the coarser pairs are from p + g·d^q, with p, g and q from the last three.
fn missed_by_a_power(locals: &[Local]) -> Option<f64> {
    let [coarser @ .., a, b, c] = locals else {
        return None;
    };
    let of = super::drift::next_power(&[*a, *b, *c])?;
    let missed = coarser.iter().map(|local| (local.order - of(local)).abs());
    Some(missed.fold(0.0, f64::max))
}
