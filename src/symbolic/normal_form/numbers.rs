//! Positive rational numbers as products of powers of integers.

use rug::{Integer, Rational};

/// Prime factors are looked for up to this number; what is left then stays whole.
const MAX_PRIME: u32 = 1000;

/// The factors of a positive rational number with their powers; numbers are of reasonable size.
pub(super) fn factors(q: &Rational) -> Vec<(Integer, i32)> {
    let mut all = of_integer(q.numer(), 1);
    all.extend(of_integer(q.denom(), -1));
    all
}

fn of_integer(n: &Integer, sign: i32) -> Vec<(Integer, i32)> {
    let mut rest = n.clone();
    let mut factors = Vec::new();
    for candidate in 2..=MAX_PRIME {
        let mut power = 0;
        while rest != 1 && rest.is_divisible_u(candidate) {
            rest.div_exact_u_mut(candidate);
            power += sign;
        }
        if power != 0 {
            factors.push((Integer::from(candidate), power));
        }
    }
    if rest != 1 {
        factors.push((rest, sign));
    }
    factors
}
