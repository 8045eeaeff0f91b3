//! Sums of rational multiples of logarithms, arc tangents and π.
//!
//! Σ nₖ ln xₖ = 0 for integers nₖ where ∏ xₖ^nₖ = 1. The argument of ∏ (1 + i xₖ)^nₖ is Σ nₖ atan xₖ but for
//! whole turns: where the product is real, the sum is a multiple of π, and an enclosure says which.

use crate::symbolic::{Expr, Function, Interval, Kind, expand};
use rug::{Integer, Rational};

/// Sums of more multiples are not looked at.
const MAX_MULTIPLES: u32 = 64;
/// Precision of the enclosure that tells multiples of π apart.
const BITS: u32 = 128;

/// A sum taken apart: coefficients and arguments.
#[derive(Default)]
struct Parts {
    logarithms: Vec<(Rational, Expr)>,
    angles: Vec<(Rational, Expr)>,
    half_turns: Rational,
    rest: Vec<Expr>,
}

impl Parts {
    fn of(expr: &Expr) -> Option<Parts> {
        let expanded = expand(expr)?;
        let terms = match expanded.kind() {
            Kind::Sum(terms) => terms.clone(),
            _ => vec![expanded.clone()],
        };
        let mut parts = Parts::default();
        for term in terms {
            let one = Rational::from(1);
            let (coefficient, factor) = match term.kind() {
                Kind::Product(factors) => match &factors[..] {
                    [number, factor] => (number.as_number().cloned(), factor.clone()),
                    _ => (None, term.clone()),
                },
                _ => (Some(one), term.clone()),
            };
            match (factor.kind(), coefficient) {
                (Kind::Pi, Some(coefficient)) => parts.half_turns += coefficient,
                (Kind::Call(Function::Ln, x), Some(coefficient)) => {
                    parts.logarithms.push((coefficient, x.clone()));
                }
                (Kind::Call(Function::Atan, x), Some(coefficient)) => {
                    parts.angles.push((coefficient, x.clone()));
                }
                _ => parts.rest.push(term),
            }
        }
        Some(parts)
    }
}

/// Whether a constant that has a value is a sum whose logarithms, angles and other terms are each 0.
pub(super) fn is_zero(expr: &Expr, vanishes: &dyn Fn(&Expr) -> bool) -> bool {
    let Some(parts) = Parts::of(expr) else {
        return false;
    };
    // What has neither is no simpler for having been taken apart.
    if parts.logarithms.is_empty() && parts.angles.is_empty() {
        return false;
    }
    (parts.rest.is_empty() || vanishes(&Expr::sum(parts.rest)))
        && are_logarithms_zero(&parts.logarithms, vanishes)
        && are_angles_zero(&parts.angles, &parts.half_turns, vanishes)
}

/// The integers that coefficients are when multiplied by the least that makes them so.
fn multiples(parts: &[(Rational, Expr)], other: &Rational) -> Option<(Integer, Vec<i32>)> {
    let denominators = parts.iter().map(|(coefficient, _)| coefficient.denom());
    let scale = denominators
        .chain([other.denom()])
        .fold(Integer::from(1), Integer::lcm);
    let scaled = |coefficient: &Rational| Rational::from(coefficient * &scale).numer().to_i32();
    let all: Option<Vec<i32>> = parts.iter().map(|(c, _)| scaled(c)).collect();
    let all = all?;
    let total = all
        .iter()
        .fold(0_u32, |sum, n| sum.saturating_add(n.unsigned_abs()));
    (total <= MAX_MULTIPLES).then_some((scale, all))
}

fn are_logarithms_zero(parts: &[(Rational, Expr)], vanishes: &dyn Fn(&Expr) -> bool) -> bool {
    if parts.is_empty() {
        return true;
    }
    let Some((_, powers)) = multiples(parts, &Rational::new()) else {
        return false;
    };
    let factors = parts.iter().zip(powers).map(|((_, x), n)| x.pow(n));
    vanishes(&(Expr::product(factors) - Expr::number(1)))
}

fn are_angles_zero(
    parts: &[(Rational, Expr)],
    half_turns: &Rational,
    vanishes: &dyn Fn(&Expr) -> bool,
) -> bool {
    if parts.is_empty() {
        return *half_turns == 0;
    }
    let Some((scale, multiples)) = multiples(parts, half_turns) else {
        return false;
    };
    let (mut re, mut im) = (Expr::number(1), Expr::number(0));
    for ((_, x), n) in parts.iter().zip(multiples) {
        let x = if n < 0 { -x } else { x.clone() };
        for _ in 0..n.unsigned_abs() {
            let (next_re, next_im) = (&re - &(&im * &x), &im + &(&re * &x));
            re = expand(&next_re).unwrap_or(next_re);
            im = expand(&next_im).unwrap_or(next_im);
        }
    }
    // Less than half a turn off: of all multiples of π only 0 is so near.
    let angles = parts
        .iter()
        .map(|(c, x)| Expr::number(c.clone()) * x.call(Function::Atan));
    let sum = Expr::sum(angles.chain([Expr::number(half_turns.clone()) * Expr::pi()]));
    let sum = Expr::number(Rational::from(scale)) * sum;
    let is_near = |value: Interval| *value.lower() > -3 && *value.upper() < 3;
    sum.enclose(BITS, &|_| None).is_ok_and(is_near) && vanishes(&im)
}
