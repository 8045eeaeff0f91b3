//! Media of expressions, cut where these are not analytic.

use super::classify::form;
use super::medium::nearest;
use super::{Piece, SceneProblem};
use crate::case::Transfer;
use crate::symbolic::{Claim, Decision, Expr, Place, decide, pieces};
use rug::{Float, Rational};

/// Bits to which the closed form of an irrational place is rounded.
const PLACE_BITS: u32 = 512;

/// What became of expressions.
pub(super) struct Cut {
    pub(super) pieces: Vec<Piece>,
    pub(super) blur: f64,
    pub(super) unproved: Vec<&'static str>,
}

/// The pieces of C and τ, of `lambda`, on a stretch of the ray, checked for being finite and not negative.
pub(super) fn cut(
    formulas: &[Transfer<Expr>],
    from: &Rational,
    to: &Rational,
) -> Result<Cut, SceneProblem> {
    let mut unproved = Vec::new();
    for of_one in formulas {
        // As they stand: in a piece that ends beside an irrational place they may be just beyond 0.
        check("extinction", &of_one.extinction, from, to, &mut unproved)?;
        check("emission", &of_one.emission, from, to, &mut unproved)?;
    }
    let flat: Vec<Expr> = formulas
        .iter()
        .flat_map(|of_one| [of_one.emission.clone(), of_one.extinction.clone()])
        .collect();
    let parts = pieces(&flat, "lambda", from, to).map_err(|error| SceneProblem::Breaks {
        reason: error.to_string(),
    })?;
    let mut result = Cut {
        pieces: Vec::new(),
        blur: 0.0,
        unproved,
    };
    let mut front = from.clone();
    let count = parts.len();
    for (i, part) in parts.into_iter().enumerate() {
        let (back, blur) = if i + 1 == count {
            (to.clone(), 0.0)
        } else {
            place(&part.to)
        };
        result.blur += blur;
        let of_channels = part.exprs.chunks_exact(2).map(|both| Transfer {
            emission: both[0].clone(),
            extinction: both[1].clone(),
        });
        let of_channels: Vec<Transfer<Expr>> = of_channels.collect();
        let form = form(of_channels, &front, &back).map_err(|error| SceneProblem::Breaks {
            reason: error.to_string(),
        })?;
        result.pieces.push(Piece {
            from: front,
            to: back.clone(),
            form,
        });
        front = back;
    }
    Ok(result)
}

/// A rational number at the place or beside it, and how far it may be from it.
fn place(place: &Place) -> (Rational, f64) {
    if let Some(q) = place.as_rational() {
        return (q.clone(), 0.0);
    }
    let closed = place.exact.as_ref();
    let enclosed = closed.and_then(|exact| exact.enclose(PLACE_BITS, &|_| None).ok());
    if let Some(q) = enclosed.and_then(|interval| interval.midpoint().to_rational()) {
        return (q, 0.0);
    }
    let (low, high) = &place.bracket;
    let width = Float::with_val(53, Rational::from(high - low)).to_f64();
    (Rational::from(low + high) / 2, width)
}

/// Neither negative nor without a value, as far as that is decided.
fn check(
    what: &'static str,
    expr: &Expr,
    from: &Rational,
    to: &Rational,
    unproved: &mut Vec<&'static str>,
) -> Result<(), SceneProblem> {
    match decide(expr, "lambda", from, to, Claim::NonNegative) {
        Decision::Proved => Ok(()),
        Decision::Refuted { witness, value } => Err(SceneProblem::Value {
            what,
            at: nearest(&witness),
            value: value.map(|value| value.midpoint().to_f64()),
        }),
        Decision::Undecided { .. } => {
            let note = match what {
                "extinction" => "extinction >= 0",
                _ => "emission >= 0",
            };
            if !unproved.contains(&note) {
                unproved.push(note);
            }
            Ok(())
        }
    }
}
