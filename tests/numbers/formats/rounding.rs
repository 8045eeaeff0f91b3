//! Rounding by definition, on the bits of binary64: the second implementation.

/// `x` rounded to nearest, ties to even, at `bits` significant bits, with gradual underflow below 2^emin
/// and ∞ from 2^(emax + 1) on. The format's half quantum must lie above binary64's subnormal numbers.
///
/// For operands of at most 25 bits the sum, product, quotient and root that binary64 gives, rounded like
/// this, are those rounded once (Figueroa 1995): 53 ≥ 2·25 + 2.
pub(crate) fn rounded(x: f64, bits: u32, emin: i32, emax: i32) -> f64 {
    if x == 0.0 || !x.is_finite() {
        return x;
    }
    let pattern = x.to_bits();
    let biased = i32::try_from(pattern >> 52 & 0x7ff).unwrap();
    let exponent = biased - 1023;
    let below_normal = u32::try_from((emin - exponent).max(0)).unwrap();
    let drop = 53 - bits + below_normal;
    if biased == 0 || drop > 54 {
        return 0.0_f64.copysign(x);
    }
    let significand = pattern & ((1 << 52) - 1) | 1 << 52;
    let (kept, rest, half) = (
        significand >> drop,
        significand & ((1 << drop) - 1),
        1 << (drop - 1),
    );
    let up = rest > half || (rest == half && kept % 2 == 1);
    let quantum = exponent - 52 + i32::try_from(drop).unwrap();
    let size = (kept + u64::from(up)) as f64 * power(quantum);
    let size = if size >= power(emax) * 2.0 {
        f64::INFINITY
    } else {
        size
    };
    size.copysign(x)
}

/// 2^exponent.
fn power(exponent: i32) -> f64 {
    f64::from_bits(u64::try_from(exponent + 1023).unwrap() << 52)
}

#[test]
fn rounding_by_bits_is_that_of_conversions() {
    for x in [1.0, 0.1, 1e-40, 3.5e38, 1e-46, 7e-46, 7.1e-46, -2.5e-45] {
        let x: f64 = x;
        #[allow(clippy::cast_possible_truncation)]
        let converted = f64::from(x as f32);
        assert_eq!(
            rounded(x, 24, -126, 127).to_bits(),
            converted.to_bits(),
            "{x}"
        );
    }
}
