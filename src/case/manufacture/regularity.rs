//! How smooth a function of λ is, and where it is not.

use super::Outcome;
use super::checks::constant_vanishes;
use crate::symbolic::{Expr, Kind, Piece, Place, ZeroTest, expand, zero_test};
use rug::Rational;

/// Derivatives are compared up to this one.
const MAX_DERIVATIVE: u32 = 6;

/// The power α of the strongest |λ − b|^α in the function at the place b where two pieces meet: 0 for a
/// jump, 1 for a kink; `None` where both sides are the same function.
pub(super) fn where_pieces_meet(before: &Expr, after: &Expr, place: &Place) -> Option<Rational> {
    let mut difference = after - before;
    if zero_test(&difference, &[]) == ZeroTest::Proved {
        return None;
    }
    let near = place.bracket.0.clone();
    for order in 0..=MAX_DERIVATIVE {
        let at_place = place
            .exact
            .as_ref()
            .map(|at| difference.substitute("lambda", at));
        let vanishes = at_place.map(|constant| constant_vanishes(&constant, &near));
        if vanishes != Some(Outcome::Proved) {
            // Where it is unknown, the rougher of the two.
            return Some(Rational::from(order));
        }
        difference = difference.differentiate("lambda");
    }
    Some(Rational::from(MAX_DERIVATIVE + 1))
}

/// The least exponent of λ in the function at the near end that is no integer ≥ 0; `None` where there is
/// none.
pub(super) fn at_near_end(piece: &Piece, expr: &Expr) -> Option<Rational> {
    if piece.from.as_rational().is_none_or(|from| *from != 0) {
        return None;
    }
    let expanded = expand(expr)?;
    let mut least: Option<Rational> = None;
    for node in expanded.nodes() {
        if let Kind::Power(base, exponent) = node.kind()
            && matches!(base.kind(), Kind::Symbol(_))
            && *exponent.denom() != 1
        {
            least = Some(match least {
                Some(least) => least.min(exponent.clone()),
                None => exponent.clone(),
            });
        }
    }
    least
}
