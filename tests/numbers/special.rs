//! Against MPFR with more bits, where the quotient's roundings do not show.

use half::{bf16, f16};
use quickcheck::QuickCheck;
use rug::{Float, Rational};
use volver::real::special::relative_opacity;
use volver::real::{Format, Mpfr, Native, NativeFloat, Real};

/// (1 − e^(−x))/x with `bits` bits: by its series Σ (−x)ᵏ/(k+1)! below 1, by subtraction above.
fn oracle(x: &Rational, bits: u32) -> Float {
    let x = Float::with_val(bits + 64, x);
    if x.clone().abs() > 1 {
        let exponential = (-x.clone()).exp();
        return (1_u32 - exponential) / x;
    }
    let mut sum = Float::with_val(bits + 64, 1);
    let mut term = sum.clone();
    for k in 2_u32.. {
        term *= &x;
        term /= -i64::from(k);
        sum += &term;
        if term.is_zero() || term.get_exp() < Some(-i32::try_from(bits).unwrap() - 32) {
            break;
        }
    }
    sum
}

/// The error in units of the last place of the true value.
fn ulps<R: Real>(x: &R) -> f64 {
    let bits = x.format().bits();
    let exact = oracle(&x.to_rational().unwrap(), 2 * bits + 64);
    let value = relative_opacity(x).to_rational().unwrap();
    let error = Float::with_val(128, value - exact.to_rational().unwrap());
    let unit = exact.get_exp().unwrap() - i32::try_from(bits).unwrap();
    (error >> unit).abs().to_f64()
}

#[test]
fn binary64_is_within_two_units_from_the_least_subnormal_to_a_thousand() {
    let by_bits = |bits: u64| {
        // Positive, from 0 to 1000.
        let x = f64::from_bits(bits % (1000_f64.to_bits() + 1));
        x == 0.0 || ulps(&x) <= 2.0
    };
    QuickCheck::new()
        .tests(4000)
        .quickcheck(by_bits as fn(u64) -> bool);
    for exponent in -1074..10 {
        let power = 2_f64.powi(exponent.max(-1022)) * 2_f64.powi((exponent + 1022).min(0));
        for x in [power, power * 1.5, -power] {
            if x.abs() < 700.0 {
                assert!(ulps(&x) <= 2.0, "{x:e}: {} ulp", ulps(&x));
            }
        }
    }
    for x in [1e-300, 1e-20, 1e-16, 1e-8, 1e-3, 0.5, 1.0, 30.0, 1e3] {
        assert!(ulps(&x) <= 2.0, "{x:e}");
    }
}

fn every_magnitude<T: NativeFloat>(from_bits: impl Fn(u16) -> T) {
    for bits in 1..0x7c00 {
        let x = from_bits(bits);
        // Up to where e^(−x)/x leaves the normal range.
        if x.is_finite() && x.to_f64() < Some(1000.0) {
            assert!(ulps(&x) <= 2.0, "{x}: {} ulp", ulps(&x));
        }
    }
}

#[test]
fn short_formats_are_within_two_units_at_every_number() {
    every_magnitude(f16::from_bits);
    every_magnitude(bf16::from_bits);
}

#[test]
fn mpfr_is_within_two_units_at_any_precision() {
    for bits in [2, 11, 53, 200, 1000] {
        let format = Mpfr { bits };
        for exponent in [-5000, -1000, -300, -60, -7, -1, 0, 1, 2, 3] {
            let power = Float::with_val(64, Float::i_exp(3, exponent));
            let x = format.ratio(&power.to_rational().unwrap());
            assert!(ulps(&x) <= 2.0, "{x} with {bits} bits");
            assert!(ulps(&-x.clone()) <= 2.0, "−{x} with {bits} bits");
        }
        assert_eq!(relative_opacity(&format.int(0)), format.int(1));
    }
}

#[test]
fn ends() {
    assert_eq!(relative_opacity(&0.0_f64), 1.0);
    assert_eq!(relative_opacity(&-0.0_f32), 1.0);
    assert_eq!(relative_opacity(&f64::INFINITY), 0.0);
    assert!(relative_opacity(&f64::NAN).is_nan());
    assert_eq!(relative_opacity(&Native::<f16>::new().int(0)), f16::ONE);
}
