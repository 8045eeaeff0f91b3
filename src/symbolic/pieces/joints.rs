//! What an expression is where its pieces end, from either side and at the very place.

use super::{PiecesError, Place, pieces};
use crate::symbolic::choice::{Which, resolve};
use crate::symbolic::constant::sign;
use crate::symbolic::{ConstantTest, Expr};
use rug::Rational;

/// An end of a piece. Functions here are without the branches of piecewise; min, max and abs, which are
/// continuous, may be left.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Where.
    pub place: Place,
    /// The function up to the place; `None` at the first end.
    pub before: Option<Expr>,
    /// The function whose value is taken at the place itself; `None` where it cannot be told which.
    pub at: Option<Expr>,
    /// The function from the place on; `None` at the last end.
    pub after: Option<Expr>,
}

impl Joint {
    /// The functions on either side.
    pub fn sides(&self) -> impl Iterator<Item = &Expr> {
        self.before.iter().chain(&self.after)
    }

    /// What one function less another is at the place; the same function needs no value for being 0.
    #[must_use]
    pub fn difference(&self, a: &Expr, b: &Expr, symbol: &str) -> ConstantTest {
        if a == b {
            return ConstantTest::Zero;
        }
        self.place.value(&(a - b), symbol)
    }
}

/// Both ends of the interval and every place between where pieces of the expression meet.
///
/// # Errors
/// [`PiecesError`] as of [`pieces`].
pub fn joints(
    expr: &Expr,
    symbol: &str,
    from: &Rational,
    to: &Rational,
) -> Result<Vec<Joint>, PiecesError> {
    let cut = pieces(std::slice::from_ref(expr), symbol, from, to)?;
    let mut joints = Vec::new();
    let mut before = None;
    let joint = |place: &Place, before, after| Joint {
        place: place.clone(),
        before,
        at: place.resolve(expr, symbol, Which::Branches),
        after,
    };
    for piece in &cut {
        // Anywhere inside the same branches are taken.
        let middle = Rational::from(&piece.from.bracket.1 + &piece.to.bracket.0) / 2;
        let middle = Expr::number(middle);
        let inside = resolve(expr, Which::Branches, &|difference| {
            sign(&difference.substitute(symbol, &middle))
        });
        let inside = inside.or_else(|| piece.exprs.first().cloned());
        joints.push(joint(&piece.from, before, inside.clone()));
        before = inside;
    }
    if let Some(last) = cut.last() {
        joints.push(joint(&last.to, before, None));
    }
    Ok(joints)
}
