//! The simplest number between two others.

use rug::{Integer, Rational};

/// The rational number of the least denominator in [from, to], and of these the nearest to 0.
///
/// Descends along the continued fraction that both bounds share.
pub(crate) fn simplest_between(from: &Rational, to: &Rational) -> Rational {
    if *from > *to {
        return simplest_between(to, from);
    }
    if *from <= 0 && *to >= 0 {
        return Rational::new();
    }
    if *to < 0 {
        return -simplest_between(&Rational::from(-to), &Rational::from(-from));
    }
    let (mut low, mut high) = (from.clone(), to.clone());
    let mut shared: Vec<Integer> = Vec::new();
    let mut result = loop {
        let floor = Integer::from(low.floor_ref());
        if low == floor {
            break Rational::from(floor);
        }
        let next = Integer::from(&floor + 1);
        if high >= next {
            break Rational::from(next);
        }
        // Neither is an integer, and both have the same floor.
        let (below, above) = (low - &floor, high - &floor);
        low = above.recip();
        high = below.recip();
        shared.push(floor);
    };
    for quotient in shared.into_iter().rev() {
        result = result.recip() + quotient;
    }
    result
}
