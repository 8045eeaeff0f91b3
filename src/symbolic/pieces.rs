//! Expressions with branches, cut into pieces without.

mod roots;

use super::{Claim, Decision, Expr, Function, Kind, Relation, decide};
use roots::roots;
use rug::Rational;

/// Expressions of more pieces are not cut.
const MAX_PIECES: usize = 64;

/// A number where pieces meet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The number itself, where it has a closed form.
    pub exact: Option<Expr>,
    /// Rational numbers that it lies between; both are the number where that is rational.
    pub bracket: (Rational, Rational),
}

impl Place {
    /// A rational place.
    #[must_use]
    pub fn rational(q: Rational) -> Place {
        Place {
            exact: Some(Expr::number(q.clone())),
            bracket: (q.clone(), q),
        }
    }

    /// The number, where it is rational.
    #[must_use]
    pub fn as_rational(&self) -> Option<&Rational> {
        (self.bracket.0 == self.bracket.1).then_some(&self.bracket.0)
    }
}

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
/// another; all pieces are proved to be complete.
///
/// # Errors
/// [`PiecesError`] where a place cannot be told, as where both sides of a comparison only touch, or come
/// to the same at no number that is found.
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
        let Some(choice) = piece.exprs.iter().find_map(innermost_choice) else {
            done.push(piece);
            continue;
        };
        let difference = choice.difference.simplify();
        let mut places = vec![piece.from.clone()];
        if !has_one_sign(&difference, symbol, &piece) {
            let inside = roots(&difference, symbol, &piece.from, &piece.to);
            places.extend(inside.map_err(|near| PiecesError::Undecided {
                difference: difference.clone(),
                symbol: symbol.into(),
                near,
            })?);
        }
        places.push(piece.to.clone());
        if open.len() + done.len() + places.len() > MAX_PIECES {
            return Err(PiecesError::TooMany);
        }
        // Pieces are taken from the end: the first of them goes there last.
        for ends in places.windows(2).rev() {
            if let [from, to] = ends {
                let positive =
                    is_positive_between(&difference, symbol, from, to).map_err(|near| {
                        PiecesError::Undecided {
                            difference: difference.clone(),
                            symbol: symbol.into(),
                            near,
                        }
                    })?;
                let chosen = choice.taken(positive);
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

/// A node that is one of two things by the sign of a difference.
struct Choice {
    node: Expr,
    difference: Expr,
    /// Where the difference is > 0.
    above: Expr,
    /// Where it is < 0.
    below: Expr,
}

impl Choice {
    fn taken(&self, positive: bool) -> Expr {
        if positive {
            self.above.clone()
        } else {
            self.below.clone()
        }
    }
}

/// The first choice that has no other choice in what decides it.
fn innermost_choice(expr: &Expr) -> Option<Choice> {
    // Parts come before what is made of them.
    expr.nodes().into_iter().find_map(|node| match node.kind() {
        Kind::Min(a, b) => Some(choice(node, a - b, b.clone(), a.clone())),
        Kind::Max(a, b) => Some(choice(node, a - b, a.clone(), b.clone())),
        Kind::Call(Function::Abs, x) => Some(choice(node, x.clone(), x.clone(), -x)),
        Kind::Piecewise(branches, otherwise) => {
            let (first, rest) = branches.split_first()?;
            let others = Expr::piecewise(rest.to_vec(), otherwise.clone());
            let difference = &first.condition.left - &first.condition.right;
            Some(match first.condition.relation {
                Relation::Less | Relation::LessEqual => {
                    choice(node, difference, others, first.value.clone())
                }
                Relation::Greater | Relation::GreaterEqual => {
                    choice(node, difference, first.value.clone(), others)
                }
            })
        }
        _ => None,
    })
}

fn choice(node: &Expr, difference: Expr, above: Expr, below: Expr) -> Choice {
    Choice {
        node: node.clone(),
        difference,
        above,
        below,
    }
}

/// Whether the difference is never less than 0 on the piece, or never more.
fn has_one_sign(difference: &Expr, symbol: &str, piece: &Piece) -> bool {
    let (from, to) = (&piece.from.bracket.0, &piece.to.bracket.1);
    let proved =
        |expr: &Expr| decide(expr, symbol, from, to, Claim::NonNegative) == Decision::Proved;
    proved(difference) || proved(&-difference)
}

/// The sign of a difference that has one sign between two places; what is 0 throughout is called positive.
fn is_positive_between(
    difference: &Expr,
    symbol: &str,
    from: &Place,
    to: &Place,
) -> Result<bool, Rational> {
    let (from, to) = (&from.bracket.1, &to.bracket.0);
    // Numbers inside, in case the difference is 0 at one of them.
    for part in [(1, 2), (1, 3), (3, 5), (5, 7), (1, 11)] {
        let at = Rational::from(to - from) * Rational::from(part) + from;
        if let Some(value) = roots::value_at(difference, symbol, &at) {
            if value.is_positive() {
                return Ok(true);
            }
            if value.is_negative() {
                return Ok(false);
            }
        }
    }
    if difference.as_number().is_some_and(|q| *q == 0) {
        return Ok(true);
    }
    Err(Rational::from(to + from) / 2)
}
