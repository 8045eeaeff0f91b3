//! Decisions on an expression of one symbol over an interval, each with a proof.
//!
//! The interval is halved until enclosures prove the claim on each part, and numbers on the way are
//! looked at for a counterexample. Three things prove a sign where the expression's own enclosure does
//! not:
//!
//! - the mean-value form;
//! - a slope: f ≥ f(a) on [a, b] where f′ ≥ 0 there, and f′ ≥ 0 is proved in the same way, so that
//!   x − sin x ≥ 0 for x ≥ 0 although both sides meet at 0;
//! - pieces: what is piecewise in the symbol itself is cut there, and each piece is decided by itself.
//!
//! A divisor that changes sign, or a cosine under a tangent, proves a pole wherever that is.
//!
//! What only touches 0 inside the interval at a number that is not met stays undecided.

mod curve;
mod pieces;
mod poles;
mod search;

use super::Expr;
use super::interval::Interval;
pub(super) use pieces::cuts;

use curve::{Budget, Curve, Point};
use rug::Rational;

/// How many nodes are evaluated before a decision is given up.
pub const DECIDE_BUDGET: usize = 60_000;

/// What is claimed of an expression, everywhere on an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Claim {
    /// It has a finite value.
    Defined,
    /// It has a value ≥ 0.
    NonNegative,
    /// It has a value > 0.
    Positive,
    /// It has a value that is not 0.
    Nonzero,
}

/// What became of a claim.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision {
    /// It holds on the whole interval.
    Proved,
    /// It fails.
    Refuted {
        /// Where it fails, or beside it: [`Claim::Nonzero`] may fail by a change of sign, and
        /// [`Claim::Defined`] by that of a divisor.
        witness: Rational,
        /// What the expression is there, or around there where its sign changes; nothing where it is
        /// not defined.
        value: Option<Interval>,
    },
    /// Neither is known.
    Undecided {
        /// A number that no proof got close to.
        near: Rational,
    },
}

/// What one number says about a claim.
enum Judgement {
    Holds,
    Fails(Option<Interval>),
    Unclear,
}

impl Claim {
    fn judge(self, point: &Point) -> Judgement {
        let value = match point {
            Point::Value(value) => value,
            Point::NotDefined => return Judgement::Fails(None),
            Point::Unclear => return Judgement::Unclear,
        };
        let (holds, fails) = match self {
            Claim::Defined => (true, false),
            Claim::NonNegative => (value.is_nonnegative(), value.is_negative()),
            Claim::Positive => (value.is_positive(), value.is_nonpositive()),
            Claim::Nonzero => (!value.contains_zero(), value.is_zero()),
        };
        if holds {
            Judgement::Holds
        } else if fails {
            Judgement::Fails(Some(value.clone()))
        } else {
            Judgement::Unclear
        }
    }
}

/// Whether `claim` holds for `expr` while `symbol` is anywhere from `from` to `to`.
///
/// [`Decision::Proved`] and [`Decision::Refuted`] are certain. An expression with other symbols is
/// undecided, and so is one whose proof needs more than [`DECIDE_BUDGET`].
#[must_use]
pub fn decide(expr: &Expr, symbol: &str, from: &Rational, to: &Rational, claim: Claim) -> Decision {
    let (from, to) = (from.min(to), from.max(to));
    if expr.symbols().iter().any(|name| **name != *symbol) {
        return Decision::Undecided { near: from.clone() };
    }
    let mut budget = Budget::new(DECIDE_BUDGET);
    let mut whole = Curve::new(expr.clone(), symbol);
    let cuts = cuts(expr, symbol, from, to);
    let mut unclear = None;
    for at in cuts.iter().cloned().chain(probes(from, to)) {
        if budget.is_spent() {
            unclear = Some(at);
            break;
        }
        match claim.judge(whole.at(&at, &mut budget)) {
            Judgement::Fails(value) => return Decision::Refuted { witness: at, value },
            Judgement::Unclear if cuts.contains(&at) => unclear = Some(at),
            Judgement::Holds | Judgement::Unclear => {}
        }
    }
    match unclear {
        // One number is all there is.
        None if from == to => return Decision::Proved,
        Some(near) if from == to => return Decision::Undecided { near },
        _ => {}
    }
    let mut pieces = Vec::new();
    for (from, to) in cuts.iter().zip(cuts.iter().skip(1)) {
        let piece = pieces::on_piece(expr, symbol, from, to);
        pieces.push(search::Piece::new(piece, symbol, from, to));
    }
    // A piece says nothing of its ends, where the expression may be another one.
    let ends_unclear = unclear.filter(|_| pieces.iter().any(|piece| !piece.is(expr)));
    match (search::search(pieces, claim, &mut budget), ends_unclear) {
        (Decision::Proved, Some(near)) => Decision::Undecided { near },
        (undecided @ Decision::Undecided { .. }, _) if claim == Claim::Defined => {
            let mut pieces = cuts.iter().zip(cuts.iter().skip(1));
            let pole = pieces.find_map(|(from, to)| {
                let piece = pieces::on_piece(expr, symbol, from, to);
                poles::pole(&piece, symbol, from, to)
            });
            let refuted = |witness| Decision::Refuted {
                witness,
                value: None,
            };
            pole.map_or(undecided, refuted)
        }
        (decision, _) => decision,
    }
}

/// Numbers that counterexamples are often at: halves, thirds, fifths of the interval, near its ends.
fn probes(from: &Rational, to: &Rational) -> impl Iterator<Item = Rational> {
    let width = Rational::from(to - from);
    [
        (1, 2),
        (1, 3),
        (2, 3),
        (1, 4),
        (3, 4),
        (1, 5),
        (4, 5),
        (1, 64),
        (63, 64),
    ]
    .into_iter()
    .map(move |part: (i32, i32)| from + &width * Rational::from(part))
}
