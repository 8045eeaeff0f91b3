//! Powers of numbers.

use rug::{Integer, Rational};

/// Powers are worked out up to results of this many bits; larger ones stay powers.
const MAX_FOLDED_BITS: u64 = 4096;

/// qᵉ, where it is rational and of reasonable size.
pub(super) fn power_of_number(q: &Rational, exponent: &Rational) -> Option<Rational> {
    if *q == 0 {
        return (*exponent > 0).then(Rational::new);
    }
    let base = match exponent.denom().to_u32()? {
        1 => q.clone(),
        _ if *q < 0 => return None,
        degree => Rational::from((root(q.numer(), degree)?, root(q.denom(), degree)?)),
    };
    let exponent = exponent.numer().to_i32()?;
    let bits = base
        .numer()
        .significant_bits()
        .max(base.denom().significant_bits());
    if bits > 1 && u64::from(bits) * u64::from(exponent.unsigned_abs()) > MAX_FOLDED_BITS {
        return None;
    }
    Some(rug::ops::Pow::pow(base, exponent))
}

/// The root of that degree, where it is an integer.
fn root(n: &Integer, degree: u32) -> Option<Integer> {
    let (root, rest) = n.clone().root_rem(Integer::new(), degree);
    (rest == 0).then_some(root)
}
