//! How near to 0 an algebraic number may be without being 0.
//!
//! A bound u on the conjugates of an algebraic integer and another, l, on those of the integer that it is
//! divided by are carried through the expression: C. Burnikel, S. Funke, K. Mehlhorn, S. Schirra and
//! S. Schmitt, *A separation bound for real algebraic expressions*, Algorithmica 55 (2009). With D the
//! degree of the field, |E| ≥ 1/(l·u^(D² − 1)) for every E other than 0. Cosines of rational parts of a turn are
//! halves of algebraic integers with conjugates of at most 2.

use crate::symbolic::{Expr, Function, Kind, expand};
use rug::{Integer, Rational};
use std::collections::HashMap;

/// Numbers that need more bits are not looked at.
const MAX_BITS: u64 = 20_000;
/// Bits beyond those of the bound, for the roundings on the way.
const GUARD_BITS: u32 = 128;

/// log₂ of the bounds, rounded upwards.
#[derive(Clone, Copy, Debug)]
struct Bound {
    above: u64,
    below: u64,
}

impl Bound {
    fn recip(self) -> Bound {
        Bound {
            above: self.below,
            below: self.above,
        }
    }

    fn power(self, k: u64) -> Bound {
        Bound {
            above: self.above.saturating_mul(k),
            below: self.below.saturating_mul(k),
        }
    }

    fn root(self, k: u64) -> Bound {
        let mean = |one: u64, many: u64| {
            one.saturating_add(many.saturating_mul(k.saturating_sub(1)))
                .div_ceil(k.max(1))
        };
        let Bound { above, below } = self;
        if above >= below {
            Bound {
                above: mean(above, below),
                below,
            }
        } else {
            Bound {
                above,
                below: mean(below, above),
            }
        }
    }
}

/// The field that all parts are in: its degree, turns apart, and the common denominator of half turns.
struct Field {
    degree: u64,
    turns: u64,
}

/// Whether a constant is algebraic and certainly 0.
pub(super) fn is_zero(expr: &Expr) -> bool {
    distance(expr).is_some_and(|bits| {
        let precision = u32::try_from(bits).unwrap_or(u32::MAX);
        let value = expr.enclose(precision.saturating_add(GUARD_BITS), &|_| None);
        // Less than 2^(−bits) on either side.
        value.is_ok_and(|value| {
            [value.lower(), value.upper()].into_iter().all(|end| {
                end.is_zero()
                    || end
                        .get_exp()
                        .is_some_and(|exponent| i64::from(exponent) <= -i64::from(precision))
            })
        })
    })
}

/// Bits b so that the constant is 0 or at least 2^(−b); `None` where it is not seen to be algebraic, or
/// takes too many.
fn distance(expr: &Expr) -> Option<u64> {
    let mut field = Field {
        degree: 1,
        turns: 1,
    };
    let mut bounds: HashMap<&Expr, Bound> = HashMap::new();
    let nodes = expr.nodes();
    // Arguments of trigonometric functions are not algebraic themselves.
    for node in nodes {
        if let Some(bound) = of_node(node, &bounds, &mut field) {
            bounds.insert(node, bound);
        }
    }
    let Bound { above, below } = *bounds.get(expr)?;
    let degree = field
        .degree
        .saturating_mul((totient(field.turns.saturating_mul(2)) / 2).max(1));
    let bits = degree
        .saturating_mul(degree)
        .saturating_sub(1)
        .saturating_mul(above)
        .saturating_add(below)
        .saturating_add(1);
    (bits <= MAX_BITS).then_some(bits)
}

fn of_node(node: &Expr, bounds: &HashMap<&Expr, Bound>, field: &mut Field) -> Option<Bound> {
    match node.kind() {
        Kind::Number(q) => Some(Bound {
            above: bits(q.numer()),
            below: bits(q.denom()),
        }),
        Kind::Sum(terms) => {
            let parts = all(terms, bounds)?;
            let below = parts
                .iter()
                .fold(0, |sum: u64, part| sum.saturating_add(part.below));
            let greatest = parts
                .iter()
                .map(|part| part.above.saturating_add(below.saturating_sub(part.below)));
            let count = Integer::from(parts.len());
            Some(Bound {
                above: greatest.max()?.saturating_add(bits(&count)),
                below,
            })
        }
        Kind::Product(factors) => {
            let parts = all(factors, bounds)?;
            Some(
                parts
                    .iter()
                    .fold(Bound { above: 0, below: 0 }, |product, part| Bound {
                        above: product.above.saturating_add(part.above),
                        below: product.below.saturating_add(part.below),
                    }),
            )
        }
        Kind::Power(base, exponent) => {
            let power = bounds
                .get(base)?
                .power(exponent.numer().clone().abs().to_u64()?);
            let power = if *exponent < 0 { power.recip() } else { power };
            let root = exponent.denom().to_u64()?;
            field.degree = field.degree.saturating_mul(root);
            Some(power.root(root))
        }
        Kind::Call(Function::Abs, x) => bounds.get(x).copied(),
        Kind::Call(function @ (Function::Sin | Function::Cos | Function::Tan), x) => {
            let half_turns = half_turns(x)?;
            let from_quarter = Rational::from((1, 2)) - &half_turns;
            let needed: &[&Rational] = match function {
                Function::Sin => &[&from_quarter],
                Function::Cos => &[&half_turns],
                _ => &[&half_turns, &from_quarter],
            };
            for turns in needed {
                let turns = turns.denom().to_u64()?;
                field.turns = Integer::from(field.turns)
                    .lcm(&Integer::from(turns))
                    .to_u64()?;
            }
            let half = u64::from(*function == Function::Tan) + 1;
            Some(Bound {
                above: half,
                below: half,
            })
        }
        _ => None,
    }
}

fn all(parts: &[Expr], bounds: &HashMap<&Expr, Bound>) -> Option<Vec<Bound>> {
    parts.iter().map(|part| bounds.get(part).copied()).collect()
}

/// q of an angle q·π.
fn half_turns(angle: &Expr) -> Option<Rational> {
    let angle = expand(angle)?;
    match angle.kind() {
        Kind::Pi => Some(Rational::from(1)),
        Kind::Number(q) if *q == 0 => Some(Rational::new()),
        Kind::Product(factors) => match &factors[..] {
            [number, pi] if *pi.kind() == Kind::Pi => number.as_number().cloned(),
            _ => None,
        },
        _ => None,
    }
}

/// log₂ |n|, rounded upwards.
fn bits(n: &Integer) -> u64 {
    u64::from(n.significant_bits())
}

/// How many numbers from 1 to n have no divisor in common with it.
fn totient(n: u64) -> u64 {
    let (mut result, mut rest, mut divisor) = (n, n, 2);
    while divisor <= rest / divisor {
        if rest.is_multiple_of(divisor) {
            while rest.is_multiple_of(divisor) {
                rest /= divisor;
            }
            result -= result / divisor;
        }
        divisor += 1;
    }
    if rest > 1 {
        result -= result / rest;
    }
    result
}
