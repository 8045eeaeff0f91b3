//! a·x + b·x = (a + b)·x.

use crate::symbolic::hash::HashMap;
use crate::symbolic::{Expr, Kind};
use rug::Rational;

/// The sum with like terms joined. A term that cancels is dropped where it is certain to have a value.
pub(super) fn like_terms(terms: &[Expr]) -> Expr {
    let mut places: HashMap<Expr, usize> = HashMap::default();
    let mut joined: Vec<(Rational, Expr)> = Vec::new();
    for term in terms {
        let (coefficient, rest) = split(term);
        if let Some(&place) = places.get(&rest) {
            joined[place].0 += coefficient;
        } else {
            places.insert(rest.clone(), joined.len());
            joined.push((coefficient, rest));
        }
    }
    Expr::sum(joined.into_iter().filter_map(|(coefficient, rest)| {
        let vanishes = coefficient == 0 && rest.facts().total;
        (!vanishes).then(|| Expr::number(coefficient) * rest)
    }))
}

/// The coefficient of a term, and the rest.
fn split(term: &Expr) -> (Rational, Expr) {
    match term.kind() {
        Kind::Number(q) => (q.clone(), Expr::number(1)),
        Kind::Product(factors) => match factors[0].as_number() {
            Some(q) => (q.clone(), Expr::product(factors[1..].iter().cloned())),
            None => (Rational::from(1), term.clone()),
        },
        _ => (Rational::from(1), term.clone()),
    }
}
