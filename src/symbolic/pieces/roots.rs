//! Every place where an expression changes sign, each proved to be the only one near it.

use super::Place;
use crate::symbolic::simplest::simplest_between;
use crate::symbolic::{Expr, Interval, Kind, enclose_range, expand};
use rug::Rational;

/// Precision of enclosures.
const BITS: u32 = 192;
/// How often an interval is halved before a root is given up, and before one is narrow enough.
const MAX_HALVINGS: u32 = 48;
/// Intervals looked at before the search is given up.
const MAX_INTERVALS: usize = 4000;

/// The roots of `expr` strictly between two places, in order.
///
/// On the error is a number near which it could not be told whether there is a root.
pub(super) fn roots(
    expr: &Expr,
    symbol: &str,
    from: &Place,
    to: &Place,
) -> Result<Vec<Place>, Rational> {
    let mut search = Search {
        expr,
        derivative: &expr.differentiate(symbol).simplify(),
        symbol,
        closed_form: closed_form(expr, symbol),
        intervals: 0,
        found: Vec::new(),
    };
    search.isolate(&from.bracket.0, &to.bracket.1, 0)?;
    let mut places = std::mem::take(&mut search.found);
    places.dedup();
    let mut inside = Vec::new();
    for place in places {
        let touches =
            |end: &Place| place.bracket.0 <= end.bracket.1 && end.bracket.0 <= place.bracket.1;
        let ends = [from, to].into_iter().find(|end| touches(end));
        match ends {
            None => inside.push(place),
            // A root at the end itself, and not beside it.
            Some(end) if same(&place, end) || search.is_same_root(&place, end) => {}
            Some(end) => return Err(end.bracket.0.clone()),
        }
    }
    Ok(inside)
}

fn same(a: &Place, b: &Place) -> bool {
    match (&a.exact, &b.exact) {
        (Some(a), Some(b)) => a == b || expand(&(a - b)).is_some_and(|difference| difference.is(0)),
        _ => false,
    }
}

/// The enclosure at a number.
pub(super) fn value_at(expr: &Expr, symbol: &str, at: &Rational) -> Option<Interval> {
    let value = |name: &str| (name == symbol).then(|| Interval::point(BITS, at));
    // A number that MPFR rounds is replaced exactly: 1/3 − 1/3 is to be 0.
    let exact = expr
        .substitute(symbol, &Expr::number(at.clone()))
        .simplify();
    match exact.as_number() {
        Some(q) => Some(Interval::point(BITS, q)),
        None => expr.enclose(BITS, &value).ok(),
    }
}

struct Search<'e> {
    expr: &'e Expr,
    derivative: &'e Expr,
    symbol: &'e str,
    closed_form: Option<Expr>,
    intervals: usize,
    found: Vec<Place>,
}

impl Search<'_> {
    /// Whether an end is a root of the same function, of which there is one only so near.
    fn is_same_root(&self, place: &Place, end: &Place) -> bool {
        let is_root = end.zero_of.as_ref().is_some_and(|zero| {
            zero == self.expr || expand(&(zero + self.expr)).is_some_and(|sum| sum.is(0))
        });
        let (from, to) = (
            place.bracket.0.clone().min(end.bracket.0.clone()),
            place.bracket.1.clone().max(end.bracket.1.clone()),
        );
        let over = |name: &str| (name == self.symbol).then(|| Interval::hull(BITS, &from, &to));
        let slope = || self.derivative.enclose(BITS, &over);
        is_root && slope().is_ok_and(|slope| !slope.contains_zero())
    }

    /// Adds the roots in [from, to].
    fn isolate(&mut self, from: &Rational, to: &Rational, halvings: u32) -> Result<(), Rational> {
        self.intervals += 1;
        let range = Interval::hull(BITS, from, to);
        let enclosure = enclose_range(self.expr, self.derivative, self.symbol, &range);
        if enclosure.as_ref().is_ok_and(|value| !value.contains_zero()) {
            return Ok(());
        }
        let over = |name: &str| (name == self.symbol).then(|| range.clone());
        let slope = self.derivative.enclose(BITS, &over);
        if enclosure.is_ok() && slope.is_ok_and(|slope| !slope.contains_zero())
            // Strictly monotone: one root at most.
            && let Some(roots) = self.only_root(from, to)
        {
            self.found.extend(roots);
            return Ok(());
        }
        if halvings == MAX_HALVINGS || self.intervals >= MAX_INTERVALS {
            return Err(from.clone());
        }
        let middle = Rational::from(from + to) / 2;
        self.isolate(from, &middle, halvings + 1)?;
        self.isolate(&middle, to, halvings + 1)
    }

    /// The roots, at most one, of what is strictly monotone; `None` where that is unclear.
    fn only_root(&self, from: &Rational, to: &Rational) -> Option<Vec<Place>> {
        let at = |q: &Rational| value_at(self.expr, self.symbol, q);
        let (low, high) = (at(from)?, at(to)?);
        if low.is_zero() {
            return Some(vec![Place::rational(from.clone())]);
        }
        if high.is_zero() {
            return Some(vec![Place::rational(to.clone())]);
        }
        if low.contains_zero() || high.contains_zero() {
            return None;
        }
        if low.is_positive() == high.is_positive() {
            return Some(Vec::new());
        }
        let rising = high.is_positive();
        let (mut from, mut to) = (from.clone(), to.clone());
        for _ in 0..MAX_HALVINGS {
            let middle = Rational::from(&from + &to) / 2;
            let value = at(&middle)?;
            if value.is_zero() {
                return Some(vec![Place::rational(middle)]);
            }
            if value.contains_zero() {
                break;
            }
            if value.is_positive() == rising {
                to = middle;
            } else {
                from = middle;
            }
        }
        let simplest = simplest_between(&from, &to);
        if at(&simplest)?.is_zero() {
            return Some(vec![Place::rational(simplest)]);
        }
        let bracket = Interval::hull(BITS, &from, &to);
        let exact = self.closed_form.clone().filter(|root| {
            let value = root.enclose(BITS, &|_| None);
            // Of several branches of a root only one lies here.
            value.is_ok_and(|value| {
                value.lower() >= bracket.lower() && value.upper() <= bracket.upper()
            })
        });
        Some(vec![Place {
            exact,
            bracket: (from, to),
            zero_of: Some(self.expr.clone()),
        }])
    }
}

/// (−b/a)^(1/k) for an expression a·xᵏ + b with constants a and b.
fn closed_form(expr: &Expr, symbol: &str) -> Option<Expr> {
    let expanded = expand(expr)?;
    let terms = match expanded.kind() {
        Kind::Sum(terms) => terms.clone(),
        _ => vec![expanded.clone()],
    };
    let (mut constant, mut coefficient) = (Vec::new(), Vec::new());
    let mut degree: Option<Rational> = None;
    for term in terms {
        if !term.contains(symbol) {
            constant.push(term);
            continue;
        }
        let factors = match term.kind() {
            Kind::Product(factors) => factors.clone(),
            _ => vec![term.clone()],
        };
        let (with, without): (Vec<Expr>, Vec<Expr>) = factors
            .into_iter()
            .partition(|factor| factor.contains(symbol));
        let [power] = &with[..] else { return None };
        let exponent = match power.kind() {
            Kind::Symbol(_) => Rational::from(1),
            Kind::Power(base, exponent) if matches!(base.kind(), Kind::Symbol(_)) => {
                exponent.clone()
            }
            _ => return None,
        };
        if *degree.get_or_insert_with(|| exponent.clone()) != exponent {
            return None;
        }
        coefficient.push(Expr::product(without));
    }
    let degree = degree.filter(|degree| *degree > 0)?;
    let base = -Expr::sum(constant) / Expr::sum(coefficient);
    expand(&base).map(|base| base.pow(degree.recip()))
}
