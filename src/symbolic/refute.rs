//! Numbers at which an expression is certainly not 0.

use super::choice::differences;
use super::decide::cuts;
use super::{Expr, Interval};
use rug::Rational;

/// The precisions at which a point is looked at.
const BITS: [u32; 3] = [64, 128, 256];
/// How many points are looked at for each piece of the expression.
const POINTS: usize = 16;
/// How many points are looked at in all.
const MAX_POINTS: usize = 256;
/// One base of the radical inverse for each symbol, in turn.
const PRIMES: [u32; 12] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37];

/// A place where the expression is certainly not 0.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// What the symbols are, in the order of their names; beside an irrational place, numbers next to it.
    pub at: Vec<(String, Rational)>,
    /// What the expression is there.
    pub value: Interval,
}

/// Looks for numbers in the ranges of the symbols at which the expression is certainly not 0, at 64, 128
/// and 256 bits.
///
/// A symbol without a range is between 1/8 and 9/8. The numbers are simple and the same each time; where
/// the expression is piecewise in one symbol, each of its pieces gets some. Numbers where it is not
/// defined are passed over. Nothing found is no proof of 0.
#[must_use]
pub fn refute_zero(expr: &Expr, ranges: &[(String, Rational, Rational)]) -> Option<Witness> {
    refute(expr, ranges, &[])
}

/// The same, but for numbers where two pieces meet.
pub(super) fn refute_inside(
    expr: &Expr,
    ranges: &[(String, Rational, Rational)],
) -> Option<Witness> {
    refute(expr, ranges, &differences(expr))
}

/// Looks for numbers at which the expression is certainly not 0, and neither are others.
fn refute(
    expr: &Expr,
    ranges: &[(String, Rational, Rational)],
    others: &[Expr],
) -> Option<Witness> {
    let names: Vec<String> = expr.symbols().iter().map(ToString::to_string).collect();
    let cuts: Vec<Vec<Rational>> = names
        .iter()
        .map(
            |name| match ranges.iter().find(|(known, ..)| known == name) {
                Some((_, from, to)) => cuts(expr, name, from.min(to), from.max(to)),
                None => cuts(expr, name, &Rational::from((1, 8)), &Rational::from((9, 8))),
            },
        )
        .collect();
    let pieces = cuts.iter().map(Vec::len).max().unwrap_or(0).max(2) - 1;
    let points = if names.is_empty() {
        1
    } else {
        pieces.saturating_mul(POINTS).min(MAX_POINTS)
    };
    (0..points).find_map(|point| {
        let at: Vec<(String, Rational)> = names
            .iter()
            .zip(&cuts)
            .enumerate()
            .map(|(place, (name, cuts))| (name.clone(), coordinate(cuts, point, place)))
            .collect();
        let value = nonzero(expr, &at)?;
        // A difference without a value is in a branch that is not taken.
        let is_apart = |other: &Expr| !may_vanish(other, &at);
        others.iter().all(is_apart).then_some(Witness { at, value })
    })
}

/// Whether the value at a point may be 0.
fn may_vanish(expr: &Expr, at: &[(String, Rational)]) -> bool {
    let bits = BITS[BITS.len() - 1];
    let value = expr.enclose(bits, &|name| coordinate_of(name, at, bits));
    value.is_ok_and(|value| value.contains_zero())
}

/// What a symbol is at a point.
fn coordinate_of(name: &str, at: &[(String, Rational)], bits: u32) -> Option<Interval> {
    let (_, q) = at.iter().find(|(known, _)| known == name)?;
    Some(Interval::point(bits, q))
}

/// The value at a point, where that is certainly not 0.
fn nonzero(expr: &Expr, at: &[(String, Rational)]) -> Option<Interval> {
    for bits in BITS {
        match expr.enclose(bits, &|name| coordinate_of(name, at, bits)) {
            Ok(value) if !value.contains_zero() => return Some(value),
            Ok(value) if value.is_zero() => return None,
            _ => {}
        }
    }
    None
}

/// One number of a point: the pieces in turn, and in each the radical inverse in a base of its own.
fn coordinate(cuts: &[Rational], point: usize, place: usize) -> Rational {
    let pieces = cuts.len().max(2) - 1;
    let (piece, round) = (point % pieces, point / pieces);
    let base = PRIMES[place % PRIMES.len()];
    // Where the bases begin anew the points do not.
    let part = radical_inverse(round + 1 + place / PRIMES.len(), base);
    match (cuts.get(piece), cuts.get(piece + 1)) {
        (Some(from), Some(to)) => from + Rational::from(to - from) * part,
        (Some(only), None) => only.clone(),
        _ => part,
    }
}

/// The digits of n mirrored at the point, strictly between 0 and 1 for n > 0.
fn radical_inverse(n: usize, base: u32) -> Rational {
    let (mut rest, mut result, mut digit) = (n, Rational::new(), Rational::from((1, base)));
    while rest > 0 {
        result += Rational::from(rest % base as usize) * &digit;
        digit /= base;
        rest /= base as usize;
    }
    result
}
