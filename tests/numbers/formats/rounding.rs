//! Rounding by definition, on the bits of binary64: the second implementation.

use volver::real::FormatName;

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

/// No rounding takes more than half a unit, and ties take all of it.
#[test]
fn half_a_unit_is_what_rounding_takes_at_most() {
    let mut worst: f64 = 0.0;
    for (name, bits, emin, emax) in [("f16", 11, -14, 15), ("f32", 24, -126, 127)] {
        let format: FormatName = name.parse().unwrap();
        assert_eq!(format.smallest_normal(), Some(power(emin)));
        for k in 0..4000 {
            let x = power(emin - 8 + k % 24) * (1.0 + f64::from(k) / 4099.0);
            let error = (rounded(x, bits, emin, emax) - x).abs();
            worst = worst.max(error / format.half_unit(x));
        }
        let tie = 1.0 + power(-i32::try_from(bits).unwrap());
        let error = (rounded(tie, bits, emin, emax) - tie).abs();
        assert!(error > 0.999 * format.half_unit(tie) && error <= format.half_unit(tie));
        let least = 1.5 * power(emin - i32::try_from(bits).unwrap() + 1);
        let error = (rounded(least, bits, emin, emax) - least).abs();
        assert_eq!(error.to_bits(), format.half_unit(least).to_bits());
    }
    assert!((0.9..=1.0).contains(&worst), "{worst}");
    let fixed: FormatName = "fixed:8".parse().unwrap();
    assert_eq!(fixed.half_unit(3.0).to_bits(), power(-9).to_bits());
    assert_eq!(fixed.smallest_normal(), None);
    let many: FormatName = "mpfr:200".parse().unwrap();
    assert_eq!(many.half_unit(-2.0).to_bits(), power(-199).to_bits());
}
