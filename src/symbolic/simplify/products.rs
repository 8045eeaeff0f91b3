//! xᵃ·xᵇ = xᵃ⁺ᵇ and eᵃ·eᵇ = eᵃ⁺ᵇ.

use crate::symbolic::hash::HashMap;
use crate::symbolic::{Expr, Function, Kind};
use rug::Rational;

/// The product with like factors joined, as far as no place is gained or lost where it has a value.
pub(super) fn like_factors(factors: &[Expr]) -> Expr {
    if factors[0].is(0) && factors.iter().all(|factor| factor.facts().total) {
        return Expr::number(0);
    }
    let mut places: HashMap<Expr, Vec<usize>> = HashMap::default();
    let mut joined: Vec<(Expr, Rational)> = Vec::new();
    let mut exponent_of_e: Option<(usize, Vec<Expr>)> = None;
    for factor in factors {
        if let Kind::Call(Function::Exp, argument) = factor.kind() {
            let place = joined.len();
            let (_, sum) = exponent_of_e.get_or_insert_with(|| {
                joined.push((Expr::number(1), Rational::from(1)));
                (place, Vec::new())
            });
            sum.push(argument.clone());
            continue;
        }
        let (base, exponent) = match factor.kind() {
            Kind::Power(base, exponent) => (base.clone(), exponent.clone()),
            _ => (factor.clone(), Rational::from(1)),
        };
        let same_base = places.entry(base.clone()).or_default();
        let partner = same_base
            .iter()
            .find(|&&place| may_join(&base, &joined[place].1, &exponent));
        if let Some(&place) = partner {
            joined[place].1 += exponent;
        } else {
            same_base.push(joined.len());
            joined.push((base, exponent));
        }
    }
    if let Some((place, sum)) = exponent_of_e {
        joined[place].0 = Expr::sum(sum).exp();
    }
    // A base to the power 0 is left to the rule for powers.
    Expr::product(
        joined
            .into_iter()
            .map(|(base, exponent)| base.pow(exponent)),
    )
}

/// Whether xᵃ·xᵇ has the same value as xᵃ⁺ᵇ, and has one at the same places.
fn may_join(base: &Expr, a: &Rational, b: &Rational) -> bool {
    let sum = Rational::from(a + b);
    let facts = base.facts();
    // Both exist at 0, or neither does.
    let same_at_zero = (*a > 0) == (*b > 0) && *a != 0 && *b != 0 || facts.nonzero;
    let integer = |q: &Rational| *q.denom() == 1;
    // Both exist for negative bases, or neither does.
    let same_below_zero = integer(a) && integer(b) || !integer(&sum) || facts.nonnegative;
    // x⁰ is left out altogether: what is left must have a value everywhere.
    same_at_zero && same_below_zero && (sum != 0 || facts.total)
}
