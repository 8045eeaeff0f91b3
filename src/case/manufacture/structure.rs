//! What theory needs to know of a derived case.

use super::derive::Derived;
use super::ends;
use super::regularity::{at_near_end, where_pieces_meet};
use crate::case::{Along, Break, END_DERIVATIVES, PolynomialTransfer, Structure};
use crate::symbolic::{Expr, Interval, Kind, Place, ZeroTest, expand, pieces, zero_test};
use rug::Rational;

/// The highest degree that counts as a polynomial.
const MAX_DEGREE: usize = 64;
/// Parts of the ray on which it is seen whether C has a zero, and the bits that takes.
const PANELS: u32 = 32;
const PANEL_BITS: u32 = 64;

/// The structure, and where its breaks are.
pub(super) fn of(length: &Rational, derived: &Derived) -> (Structure, Vec<Option<Place>>) {
    let source = Expr::product([derived.emission.clone(), derived.extinction.clone()]);
    let extinction_of_field = coefficients(&derived.extinction_of_field, "s");
    let source_of_field = coefficients(
        &Expr::product([
            derived.emission_of_field.clone(),
            derived.extinction_of_field.clone(),
        ]),
        "s",
    );
    let degree = |expr: &Expr| coefficients(expr, "lambda").map(|c| c.len().saturating_sub(1));
    let ranges = [("lambda".to_string(), Rational::new(), length.clone())];
    let vanishes = |expr: &Expr| zero_test(expr, &ranges) == ZeroTest::Proved;
    let (breaks, places): (Vec<Break>, Vec<Option<Place>>) =
        breaks(length, &derived.extinction, &source)
            .into_iter()
            .unzip();
    let structure = Structure {
        field_degree: degree(&derived.field),
        transfer: extinction_of_field
            .zip(source_of_field)
            .map(|(extinction, source)| PolynomialTransfer { extinction, source }),
        along: Along {
            extinction_degree: degree(&derived.extinction),
            source_is_constant: breaks.iter().all(|b| b.source.is_none())
                && vanishes(&source.differentiate("lambda")),
            source_is_zero: vanishes(&source),
            parabolas_hide_source: breaks.is_empty() && vanishes(&parabola_error(derived, &source)),
            emission_is_constant: derived.emission.as_number().is_some()
                || breaks.is_empty() && vanishes(&derived.emission.differentiate("lambda")),
            emission_has_no_zero: has_no_zero(length, &derived.emission),
            end_samples_cancel: breaks.is_empty() && ends::end_samples_cancel(length, derived),
            equal_at_ends: if breaks.is_empty() {
                ends::equal_derivatives(length, derived)
            } else {
                [false; END_DERIVATIVES]
            },
        },
        breaks,
    };
    (structure, places)
}

/// Whether an enclosure of C says of every panel of the ray that it has that one sign.
fn has_no_zero(length: &Rational, emission: &Expr) -> bool {
    let mut signs = (0..PANELS).map(|panel| {
        let end = |part: u32| Rational::from(length * part) / PANELS;
        let range = Interval::hull(PANEL_BITS, &end(panel), &end(panel + 1));
        let over = |name: &str| (name == "lambda").then(|| range.clone());
        let values = emission.enclose(PANEL_BITS, &over).ok();
        values
            .filter(|values| !values.contains_zero())
            .map(|values| values.is_positive())
    });
    let first = signs.next().flatten();
    first.is_some() && signs.all(|sign| sign == first)
}

/// What [`Along::parabolas_hide_source`] is about, times (s′)² e^t, which leaves no quotient.
fn parabola_error(derived: &Derived, source: &Expr) -> Expr {
    let derivative = |expr: &Expr| expr.differentiate("lambda");
    let first = derivative(&derived.field);
    let second = derivative(&first);
    let third = derivative(&second);
    let fourth = derivative(&third);
    // w = h e^(−t)/s′ with h = (C τ)′
    let change = derivative(source);
    let slope = (derivative(&change) - &derived.extinction * &change) * first.clone();
    let turn = &change * &second;
    change * first * fourth + Expr::number(4) * third * (slope - turn)
}

/// The coefficients of a polynomial, that of degree 0 first; none for 0.
fn coefficients(expr: &Expr, symbol: &str) -> Option<Vec<Rational>> {
    let expanded = expand(expr)?;
    let terms = match expanded.kind() {
        Kind::Sum(terms) => terms.clone(),
        _ => vec![expanded.clone()],
    };
    let mut all = Vec::new();
    for term in terms {
        let (coefficient, power) = match term.kind() {
            Kind::Product(factors) => match &factors[..] {
                [coefficient, power] => (coefficient.as_number()?.clone(), power.clone()),
                _ => return None,
            },
            Kind::Number(q) => (q.clone(), Expr::number(1)),
            _ => (Rational::from(1), term.clone()),
        };
        let degree = match power.kind() {
            Kind::Number(_) => 0,
            Kind::Symbol(name) if **name == *symbol => 1,
            Kind::Power(base, exponent) if *base == Expr::symbol(symbol) => {
                let degree = exponent
                    .numer()
                    .to_usize()
                    .filter(|_| *exponent.denom() == 1)?;
                Some(degree).filter(|degree| *degree <= MAX_DEGREE)?
            }
            _ => return None,
        };
        if all.len() <= degree {
            all.resize(degree + 1, Rational::new());
        }
        all[degree] += coefficient;
    }
    while all.last().is_some_and(|c| *c == 0) {
        all.pop();
    }
    Some(all)
}

/// Where τ or C·τ is not analytic.
fn breaks(length: &Rational, extinction: &Expr, source: &Expr) -> Vec<(Break, Option<Place>)> {
    let both = [extinction.clone(), source.clone()];
    let Ok(pieces) = pieces(&both, "lambda", &Rational::new(), length) else {
        // Somewhere, nobody knows where or how.
        let anything = Break {
            part: None,
            extinction: Some(Rational::new()),
            source: Some(Rational::new()),
        };
        return vec![(anything, None)];
    };
    let mut breaks = Vec::new();
    let mut add = |place: &Place, extinction: Option<Rational>, source: Option<Rational>| {
        if extinction.is_some() || source.is_some() {
            let part = place.as_rational().map(|at| Rational::from(at / length));
            let found = Break {
                part,
                extinction,
                source,
            };
            breaks.push((found, Some(place.clone())));
        }
    };
    if let Some(first) = pieces.first()
        && let [extinction, source] = &first.exprs[..]
    {
        add(
            &first.from,
            at_near_end(first, extinction),
            at_near_end(first, source),
        );
    }
    for pair in pieces.windows(2) {
        let [before, after] = pair else { continue };
        let place = &after.from;
        let power = |i: usize| where_pieces_meet(before.exprs.get(i)?, after.exprs.get(i)?, place);
        add(place, power(0), power(1));
    }
    breaks
}
