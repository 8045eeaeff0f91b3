//! Expressions with branches, cut into pieces without.

mod inside;
mod joints;
mod place;
mod roots;

pub(super) use inside::Stretch;
pub use joints::{Joint, joints};
pub use place::Place;

use super::choice::{Choice, Which, innermost};
use super::normal_form::{Reduction, reduce};
use super::{Claim, Decision, Expr, decide};
use roots::roots;
use rug::Rational;
use std::cmp::Ordering;

/// Expressions of more pieces are not cut.
const MAX_PIECES: usize = 64;

/// What some expressions are strictly between two places: the same expressions without min, max, abs and
/// piecewise.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Piece {
    /// Where it begins.
    pub from: Place,
    /// Where it ends.
    pub to: Place,
    /// The expressions there, in the order they were given.
    pub exprs: Vec<Expr>,
}

/// Why expressions are not cut into pieces.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PiecesError {
    /// It is not known on which side of 0 an expression lies there.
    #[error("cannot tell where {difference} changes sign near {symbol} = {}", near.to_f64())]
    Undecided {
        /// The expression whose sign decides between branches.
        difference: Expr,
        /// The symbol.
        symbol: String,
        /// Near where.
        near: Rational,
    },
    /// More pieces than is reasonable.
    #[error("more than {MAX_PIECES} pieces")]
    TooMany,
}

/// Cuts `exprs` at every place strictly between `from` and `to` where one of them goes from one branch to
/// another, if only for a single point; all pieces are proved to be complete. What an expression is at the
/// places themselves is for [`joints`] to say.
///
/// # Errors
/// [`PiecesError`] where a place cannot be told, as where both sides of a comparison come to the same at
/// no number that is found.
pub fn pieces(
    exprs: &[Expr],
    symbol: &str,
    from: &Rational,
    to: &Rational,
) -> Result<Vec<Piece>, PiecesError> {
    let mut open = vec![Piece {
        from: Place::rational(from.clone()),
        to: Place::rational(to.clone()),
        exprs: exprs.to_vec(),
    }];
    let mut done = Vec::new();
    while let Some(piece) = open.pop() {
        let mut exprs = piece.exprs.iter();
        let Some(choice) = exprs.find_map(|expr| innermost(expr, Which::All)) else {
            done.push(piece);
            continue;
        };
        let undecided = |near| PiecesError::Undecided {
            difference: choice.difference.simplify(),
            symbol: symbol.into(),
            near,
        };
        let places = cuts(&choice, symbol, &piece).map_err(undecided)?;
        if open.len() + done.len() + places.len() > MAX_PIECES {
            return Err(PiecesError::TooMany);
        }
        // Pieces are taken from the end: the first of them goes there last.
        for ends in places.windows(2).rev() {
            if let [from, to] = ends {
                let sign = sign_between(&choice.difference, symbol, from, to).map_err(undecided)?;
                let chosen = choice.taken(sign);
                let exprs = piece.exprs.iter().map(|expr| {
                    expr.rebuild(|node| (*node == choice.node).then(|| chosen.clone()))
                });
                open.push(Piece {
                    from: from.clone(),
                    to: to.clone(),
                    exprs: exprs.collect(),
                });
            }
        }
    }
    Ok(done)
}

/// The ends of a piece and the places inside between which a choice is the same; on the error is a number
/// near which that is not known.
fn cuts(choice: &Choice, symbol: &str, piece: &Piece) -> Result<Vec<Place>, Rational> {
    let difference = choice.difference.simplify();
    if reduce(&difference) == Reduction::Zero {
        return Ok(vec![piece.from.clone(), piece.to.clone()]);
    }
    let inside = match one_sign(&difference, symbol, piece) {
        Some(sign) if !choice.differs_at_zero(sign) => Vec::new(),
        Some(sign) => touched(&difference, sign, symbol, piece)?,
        None => roots(&difference, symbol, &piece.from, &piece.to)?,
    };
    let (from, to) = ([piece.from.clone()], [piece.to.clone()]);
    Ok(from.into_iter().chain(inside).chain(to).collect())
}

/// The sign that the difference has on the piece wherever it is not 0.
fn one_sign(difference: &Expr, symbol: &str, piece: &Piece) -> Option<Ordering> {
    let (from, to) = (&piece.from.bracket.0, &piece.to.bracket.1);
    let proved =
        |expr: &Expr| decide(expr, symbol, from, to, Claim::NonNegative) == Decision::Proved;
    if proved(difference) {
        Some(Ordering::Greater)
    } else if proved(&-difference) {
        Some(Ordering::Less)
    } else {
        None
    }
}

/// Where a difference of one sign may be 0 inside the piece: nowhere, or where its slope is.
fn touched(
    difference: &Expr,
    sign: Ordering,
    symbol: &str,
    piece: &Piece,
) -> Result<Vec<Place>, Rational> {
    let stretch = Stretch::new(symbol, &piece.from, &piece.to);
    if stretch.keeps_off_zero(difference, sign) {
        return Ok(Vec::new());
    }
    let bottoms = inside::even_root(difference);
    match roots(&bottoms, symbol, &piece.from, &piece.to) {
        Ok(places) => Ok(places),
        // Between the zeros of its slope a function is strictly monotone, and 0 at no end but one.
        Err(near) => {
            let slope = difference.differentiate(symbol).simplify();
            roots(&slope, symbol, &piece.from, &piece.to).map_err(|_| near)
        }
    }
}

/// The sign of a difference that has one sign between two places; what is 0 throughout is 0.
fn sign_between(
    difference: &Expr,
    symbol: &str,
    from: &Place,
    to: &Place,
) -> Result<Ordering, Rational> {
    let difference = difference.simplify();
    let (from, to) = (&from.bracket.1, &to.bracket.0);
    // Numbers inside, in case the difference is 0 at one of them.
    for part in [(1, 2), (1, 3), (3, 5), (5, 7), (1, 11)] {
        let at = Rational::from(to - from) * Rational::from(part) + from;
        if let Some(value) = roots::value_at(&difference, symbol, &at) {
            if value.is_positive() {
                return Ok(Ordering::Greater);
            }
            if value.is_negative() {
                return Ok(Ordering::Less);
            }
        }
    }
    if reduce(&difference) == Reduction::Zero {
        return Ok(Ordering::Equal);
    }
    Err(Rational::from(to + from) / 2)
}
