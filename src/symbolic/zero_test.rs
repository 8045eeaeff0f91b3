//! Whether an expression is 0 everywhere: proved, refuted, or unknown.

mod identity;

use super::constant::ConstantTest;
use super::normal_form::{Reduction, reduce};
use super::pieces::{Joint, Stretch, joints};
use super::refute::refute_inside;
use super::{Expr, Piece, Place, Witness, pieces, refute_zero};
use identity::is_identity;
use rug::Rational;

/// What became of the claim that an expression is 0 wherever it has a value.
#[derive(Clone, Debug, PartialEq)]
pub enum ZeroTest {
    /// It is.
    Proved,
    /// It is not.
    Refuted(Witness),
    /// Neither is known.
    Unknown,
}

/// Which points count.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Points {
    /// Those where pieces meet, too.
    All,
    /// Those strictly between.
    Inside,
}

/// Tests whether `expr` is 0 for all values of its symbols in `ranges`, wherever it has a value; a symbol
/// without a range is looked at between 1/8 and 9/8.
///
/// Where it has branches, it is tested on each piece and, by itself, at each place where pieces end.
///
/// ```
/// use volver::symbolic::{Expr, ZeroTest, zero_test};
///
/// let identity: Expr = "sin(2*x) - 2*sin(x)*cos(x)".parse()?;
/// assert_eq!(zero_test(&identity, &[]), ZeroTest::Proved);
/// let wrong: Expr = "sin(2*x) - 2*sin(x)".parse()?;
/// assert!(matches!(zero_test(&wrong, &[]), ZeroTest::Refuted(_)));
/// # Ok::<(), volver::symbolic::ParseError>(())
/// ```
#[must_use]
pub fn zero_test(expr: &Expr, ranges: &[(String, Rational, Rational)]) -> ZeroTest {
    test(expr, ranges, Points::All)
}

/// The same but for the places where pieces meet and the ends, where a derivative is none of both sides.
#[must_use]
pub fn zero_test_inside(expr: &Expr, ranges: &[(String, Rational, Rational)]) -> ZeroTest {
    test(expr, ranges, Points::Inside)
}

fn test(expr: &Expr, ranges: &[(String, Rational, Rational)], points: Points) -> ZeroTest {
    if reduce(expr) == Reduction::Zero {
        return ZeroTest::Proved;
    }
    // √(x²) is |x|, and |x| is x where x ≥ 0; what cancels hides no small difference.
    let expr = &expr.simplify();
    let symbols = expr.symbols();
    if symbols.is_empty() {
        return of_constant(expr);
    }
    let range = match &symbols[..] {
        [symbol] => ranges.iter().find(|(name, ..)| **name == **symbol),
        _ => None,
    };
    let on_ray = range.map(|(symbol, from, to)| Ray {
        expr,
        symbol,
        from: from.min(to),
        to: from.max(to),
    });
    let has_choices = has_choices(expr);
    let cut = on_ray.as_ref().filter(|_| has_choices);
    let cut = cut.and_then(|ray| ray.cut(points));
    if let Some(cut) = &cut {
        if let Some(witness) = &cut.refuted {
            return ZeroTest::Refuted(witness.clone());
        }
        if cut.are_joints_zero && cut.pieces.iter().all(is_zero_by_normal_form) {
            return ZeroTest::Proved;
        }
    }
    let refuted = match points {
        Points::All => refute_zero(expr, ranges).or_else(|| on_ray.as_ref()?.refuted_at_ends()),
        Points::Inside => refute_inside(expr, ranges),
    };
    if let Some(witness) = refuted {
        return ZeroTest::Refuted(witness);
    }
    let cut = cut.or_else(|| on_ray.as_ref().filter(|_| !has_choices)?.cut(points));
    match (cut, on_ray) {
        (Some(cut), Some(ray)) if cut.are_joints_zero && ray.is_zero_on(&cut.pieces) => {
            ZeroTest::Proved
        }
        _ => ZeroTest::Unknown,
    }
}

fn of_constant(expr: &Expr) -> ZeroTest {
    match ConstantTest::of(expr) {
        ConstantTest::Zero => ZeroTest::Proved,
        ConstantTest::Nonzero(value) => ZeroTest::Refuted(Witness {
            at: Vec::new(),
            value,
        }),
        ConstantTest::NotDefined | ConstantTest::Unknown => ZeroTest::Unknown,
    }
}

fn is_zero_by_normal_form(piece: &Piece) -> bool {
    piece.exprs.iter().all(|e| reduce(e) == Reduction::Zero)
}

/// An expression of one symbol in its range.
struct Ray<'e> {
    expr: &'e Expr,
    symbol: &'e str,
    from: &'e Rational,
    to: &'e Rational,
}

/// Its pieces, and what it is where they end.
struct Cut {
    pieces: Vec<Piece>,
    /// Whether it is 0 at all of their ends, wherever the pieces are.
    are_joints_zero: bool,
    refuted: Option<Witness>,
}

impl Ray<'_> {
    /// `None` where it is not known how the expression is cut.
    fn cut(&self, points: Points) -> Option<Cut> {
        let exprs = std::slice::from_ref(self.expr);
        let pieces = pieces(exprs, self.symbol, self.from, self.to).ok()?;
        let mut cut = Cut {
            pieces,
            are_joints_zero: true,
            refuted: None,
        };
        if points == Points::Inside || !has_choices(self.expr) {
            return Some(cut);
        }
        for joint in joints(self.expr, self.symbol, self.from, self.to).ok()? {
            match self.at_joint(&joint) {
                ConstantTest::Zero | ConstantTest::NotDefined => {}
                ConstantTest::Unknown => cut.are_joints_zero = false,
                ConstantTest::Nonzero(value) => {
                    let near = joint.place.bracket.0.clone();
                    cut.refuted = Some(Witness {
                        at: vec![(self.symbol.into(), near)],
                        value,
                    });
                    break;
                }
            }
        }
        Some(cut)
    }

    /// The end at which the expression is certainly not 0.
    fn refuted_at_ends(&self) -> Option<Witness> {
        [self.from, self.to].into_iter().find_map(|end| {
            match Place::rational(end.clone()).value(self.expr, self.symbol) {
                ConstantTest::Nonzero(value) => Some(Witness {
                    at: vec![(self.symbol.into(), end.clone())],
                    value,
                }),
                _ => None,
            }
        })
    }

    /// What the expression is at an end. Nothing is said of an end at which it is what it is beside it: it
    /// is 0 there if the piece is.
    fn at_joint(&self, joint: &Joint) -> ConstantTest {
        let Some(at) = &joint.at else {
            return ConstantTest::Unknown;
        };
        if joint.sides().any(|side| side == at) {
            return ConstantTest::Zero;
        }
        joint.place.value(at, self.symbol)
    }

    fn is_zero_on(&self, pieces: &[Piece]) -> bool {
        pieces.iter().all(|piece| {
            let stretch = Stretch::new(self.symbol, &piece.from, &piece.to);
            piece.exprs.iter().all(|expr| is_identity(expr, &stretch))
        })
    }
}

fn has_choices(expr: &Expr) -> bool {
    !super::choice::differences(expr).is_empty()
}
