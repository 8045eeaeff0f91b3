//! Halving: proofs on parts of an interval, counterexamples between them.

use super::curve::{Budget, Curve, Point, Range};
use super::{Claim, Decision, Judgement};
use crate::symbolic::simplest::simplest_between;
use crate::symbolic::{Expr, Interval, Kind};
use rug::Rational;
use std::collections::VecDeque;

/// Parts narrower than the interval by this power of 2 are not halved.
const MAX_HALVINGS: u32 = 40;
/// Parts narrower than the interval by this power of 2 are looked at with more bits.
const COARSE_HALVINGS: u32 = 16;
/// How many derivatives prove a sign: as many as a zero at an end may have orders.
const MAX_ORDER: u32 = 4;
/// How closely a change of sign is enclosed, in halvings.
const BRACKET_HALVINGS: u32 = 24;

/// What halving costs beside the evaluations, in nodes.
const PART_COST: usize = 16;

/// A sign that a function is to have.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sign {
    Positive,
    NonNegative,
    NonPositive,
    Negative,
}

impl Sign {
    fn of(self, values: &Interval) -> bool {
        match self {
            Sign::Positive => values.is_positive(),
            Sign::NonNegative => values.is_nonnegative(),
            Sign::NonPositive => values.is_nonpositive(),
            Sign::Negative => values.is_negative(),
        }
    }

    fn at(self, point: &Point) -> bool {
        matches!(point, Point::Value(value) if self.of(value))
    }

    /// The signs of the slope with which a function keeps this sign from its first number on, and up to
    /// its last.
    fn slopes(self) -> (Sign, Sign) {
        match self {
            Sign::Positive | Sign::NonNegative => (Sign::NonNegative, Sign::NonPositive),
            Sign::Negative | Sign::NonPositive => (Sign::NonPositive, Sign::NonNegative),
        }
    }
}

/// The expression between two numbers where it changes.
pub(super) struct Piece {
    curve: Curve,
    /// The bases of its fractional powers, inner ones first.
    bases: Vec<Curve>,
    from: Rational,
    to: Rational,
}

impl Piece {
    pub(super) fn new(expr: Expr, symbol: &str, from: &Rational, to: &Rational) -> Piece {
        let bases = expr
            .nodes()
            .into_iter()
            .filter_map(|node| match node.kind() {
                Kind::Power(base, exponent) if *exponent > 0 && *exponent.denom() != 1 => {
                    Some(Curve::new(base.clone(), symbol))
                }
                _ => None,
            })
            .collect();
        Piece {
            curve: Curve::new(expr, symbol),
            bases,
            from: from.clone(),
            to: to.clone(),
        }
    }

    pub(super) fn is(&self, expr: &Expr) -> bool {
        self.curve.expr == *expr
    }

    /// Whether the expression is defined and continuous on all of a part.
    fn is_continuous(&mut self, part: &Part, budget: &mut Budget) -> bool {
        match self.curve.over(&part.range, budget) {
            Some(range) => !range.may_jump && self.is_defined(part, &range, budget),
            None => false,
        }
    }

    /// Whether an expression that has a range is defined: the bases of its fractional powers are ≥ 0.
    fn is_defined(&mut self, part: &Part, range: &Range, budget: &mut Budget) -> bool {
        !range.clamped
            || self
                .bases
                .iter_mut()
                .all(|base| has_sign(base, part, Sign::NonNegative, MAX_ORDER, budget))
    }

    /// Whether the claim is proved on all of a part.
    fn proves(&mut self, claim: Claim, part: &Part, budget: &mut Budget) -> bool {
        let Some(range) = self.curve.over(&part.range, budget) else {
            return false;
        };
        let signs: &[Sign] = match claim {
            Claim::Defined => &[],
            Claim::NonNegative => &[Sign::NonNegative],
            Claim::Positive => &[Sign::Positive],
            Claim::Nonzero => &[Sign::Positive, Sign::Negative],
        };
        let has_sign = signs.is_empty()
            || signs
                .iter()
                .any(|sign| has_sign(&mut self.curve, part, *sign, MAX_ORDER, budget));
        has_sign && self.is_defined(part, &range, budget)
    }
}

/// A part of a piece.
struct Part {
    from: Rational,
    to: Rational,
    range: Interval,
}

impl Part {
    fn new(from: Rational, to: Rational, bits: u32) -> Part {
        let range = Interval::hull(bits, &from, &to);
        Part { from, to, range }
    }

    fn width(&self) -> Rational {
        Rational::from(&self.to - &self.from)
    }

    /// The simplest number in its middle half: zeros and poles are often at such.
    fn middle(&self) -> Rational {
        let quarter = self.width() / 4;
        simplest_between(
            &Rational::from(&self.from + &quarter),
            &Rational::from(&self.to - &quarter),
        )
    }
}

/// Whether a function has a sign on all of a part, by its range, by the mean-value form, or because it
/// has it at one end and moves away from 0 from there on.
fn has_sign(curve: &mut Curve, part: &Part, sign: Sign, order: u32, budget: &mut Budget) -> bool {
    let Some(range) = curve.over(&part.range, budget) else {
        return false;
    };
    if sign.of(&range.values) {
        return true;
    }
    // Where it may jump its slope says nothing.
    if range.may_jump || order == 0 || budget.is_spent() {
        return false;
    }
    let Some(slope) = curve
        .derivative()
        .and_then(|derivative| derivative.over(&part.range, budget))
    else {
        return false;
    };
    let form = curve.mean_value(&part.range, &slope.values, budget);
    if form.is_some_and(|form| sign.of(&form)) {
        return true;
    }
    let (onward, backward) = sign.slopes();
    [(&part.from, onward), (&part.to, backward)]
        .into_iter()
        .any(|(end, slope)| {
            sign.at(curve.at(end, budget))
                && curve
                    .derivative()
                    .is_some_and(|derivative| has_sign(derivative, part, slope, order - 1, budget))
        })
}

/// Proves the claim on every piece, or finds a number where it fails.
pub(super) fn search(pieces: Vec<Piece>, claim: Claim, budget: &mut Budget) -> Decision {
    let mut pieces = pieces;
    let mut queue = VecDeque::new();
    for (place, piece) in pieces.iter().enumerate() {
        queue.push_back((place, piece.from.clone(), piece.to.clone()));
    }
    let mut stuck: Option<Rational> = None;
    while let Some((place, from, to)) = queue.pop_front() {
        let Some(piece) = pieces.get_mut(place) else {
            continue;
        };
        let whole = Rational::from(&piece.to - &piece.from);
        let coarse = Rational::from(&to - &from) << COARSE_HALVINGS > whole;
        let part = Part::new(from, to, if coarse { 64 } else { 128 });
        let middle = part.middle();
        if budget.is_spent() {
            return Decision::Undecided {
                near: stuck.unwrap_or(middle),
            };
        }
        budget.spend(PART_COST);
        if piece.proves(claim, &part, budget) {
            continue;
        }
        if claim == Claim::Nonzero
            && let Some(refuted) = change_of_sign(piece, &part, budget)
        {
            return refuted;
        }
        if let Judgement::Fails(value) = claim.judge(piece.curve.at(&middle, budget)) {
            return Decision::Refuted {
                witness: middle,
                value,
            };
        }
        if part.width() << MAX_HALVINGS < whole {
            let _ = stuck.get_or_insert(middle);
            continue;
        }
        queue.push_back((place, part.from, middle.clone()));
        queue.push_back((place, middle, part.to));
    }
    match stuck {
        Some(near) => Decision::Undecided { near },
        None => Decision::Proved,
    }
}

/// The place of a zero between numbers of opposite signs, where the expression is continuous.
fn change_of_sign(piece: &mut Piece, part: &Part, budget: &mut Budget) -> Option<Decision> {
    let rises = crosses(&mut piece.curve, &part.from, &part.to, budget)?;
    if !piece.is_continuous(part, budget) {
        return None;
    }
    let (mut from, mut to) = (part.from.clone(), part.to.clone());
    for _ in 0..BRACKET_HALVINGS {
        let middle = Rational::from(&from + &to) / 2;
        match piece.curve.at(&middle, budget) {
            Point::Value(value) if value.contains_zero() => break,
            Point::Value(value) if value.is_negative() == rises => from = middle,
            Point::Value(_) => to = middle,
            Point::NotDefined | Point::Unclear => break,
        }
    }
    let value = match (value_at(piece, &from, budget), value_at(piece, &to, budget)) {
        (Some(a), Some(b)) => a.union(&b),
        _ => return None,
    };
    Some(Decision::Refuted {
        witness: Rational::from(&from + &to) / 2,
        value: Some(value),
    })
}

/// Whether it rises from < 0 to > 0; nothing where it has no such signs at the ends.
fn crosses(curve: &mut Curve, from: &Rational, to: &Rational, budget: &mut Budget) -> Option<bool> {
    let (below, above) = (
        Sign::Negative.at(curve.at(from, budget)),
        Sign::Positive.at(curve.at(from, budget)),
    );
    let end = curve.at(to, budget);
    if below && Sign::Positive.at(end) {
        Some(true)
    } else if above && Sign::Negative.at(end) {
        Some(false)
    } else {
        None
    }
}

fn value_at(piece: &mut Piece, at: &Rational, budget: &mut Budget) -> Option<Interval> {
    match piece.curve.at(at, budget) {
        Point::Value(value) => Some(value.clone()),
        Point::NotDefined | Point::Unclear => None,
    }
}
