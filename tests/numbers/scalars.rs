//! Every native number is the nearest one: + − × ÷ √, and what a format makes of integers, quotients
//! and rationals, gradual underflow, ties and overflow included.
//!
//! The judge is exact: a result's neighbours are taken from its bit pattern, and the midpoints
//! between them are compared with the true value in rational arithmetic. Nothing is rounded there.

use half::{bf16, f16};
use quickcheck::QuickCheck;
use rug::{Float, Rational};
use volver::real::{Format, Mpfr, Native, NativeFloat, Real};

/// A native number as its bit pattern.
trait Pattern: NativeFloat {
    const WIDTH: u32;
    /// The pattern of +∞; magnitudes below it are finite and ascending.
    const INFINITY: u64;
    fn from_pattern(pattern: u64) -> Self;
    fn pattern(self) -> u64;
}

macro_rules! pattern {
    ($float:ty, $bits:ty, $infinity:expr) => {
        impl Pattern for $float {
            const WIDTH: u32 = <$bits>::BITS;
            const INFINITY: u64 = $infinity;
            fn from_pattern(pattern: u64) -> Self {
                <$float>::from_bits(<$bits>::try_from(pattern >> (64 - <$bits>::BITS)).unwrap())
            }
            fn pattern(self) -> u64 {
                self.to_bits().into()
            }
        }
    };
}
pattern!(f32, u32, 0x7f80_0000);
pattern!(f64, u64, 0x7ff0_0000_0000_0000);
pattern!(f16, u16, 0x7c00);
pattern!(bf16, u16, 0x7f80);

/// The value of a magnitude; ∞ stands where the next finite number would.
fn value<T: Pattern>(magnitude: u64) -> Rational {
    let of = |m: u64| T::from_pattern(m << (64 - T::WIDTH)).to_rational().unwrap();
    if magnitude == T::INFINITY {
        let largest = of(magnitude - 1);
        Rational::from(&largest * 2) - of(magnitude - 2)
    } else {
        of(magnitude)
    }
}

fn magnitude<T: Pattern>(x: T) -> u64 {
    x.pattern() & (u64::MAX >> (65 - T::WIDTH))
}

/// The midpoints below and above x ≥ 0: exact values between them round to x.
fn midpoints<T: Pattern>(x: T) -> (Rational, Option<Rational>) {
    let m = magnitude(x);
    let half = |a: u64, b: u64| (value::<T>(a) + value::<T>(b)) / 2;
    let below = if m == 0 {
        -value::<T>(1) / 2
    } else {
        half(m - 1, m)
    };
    (below, (m < T::INFINITY).then(|| half(m, m + 1)))
}

/// Whether x is `exact` rounded to nearest, ties to even.
fn is_nearest<T: Pattern>(x: T, exact: &Rational) -> bool {
    let m = magnitude(x);
    if m > T::INFINITY {
        return false;
    }
    if m > 0 && (*exact < 0) != x.is_sign_negative() {
        return false;
    }
    let size = exact.clone().abs();
    let even = m.is_multiple_of(2);
    let (below, above) = midpoints(x);
    let above_lower = size > below || (even && size == below);
    above_lower && above.is_none_or(|above| size < above || (even && size == above))
}

/// Two finite numbers from random bits; the second of a similar size if asked, so that sums cancel.
fn operands<T: Pattern>(a: u64, b: u64, alike: bool) -> Option<(T, T)> {
    let second = if alike { a ^ (b >> 10) } else { b };
    let (a, b) = (T::from_pattern(a), T::from_pattern(second));
    (a.is_finite() && b.is_finite()).then_some((a, b))
}

/// Whether MPFR, which has no subnormals and no overflow here, must round `exact` to the very same number.
/// The exact value decides: one below the smallest normal number may be rounded up to it.
fn is_in_normal_range<T: Pattern>(native: T, exact: &Rational) -> bool {
    let smallest = T::min_positive_value().to_rational().unwrap();
    native.is_finite() && (*exact == 0 || exact.clone().abs() >= smallest)
}

fn arithmetic<T: Pattern>(a: u64, b: u64, alike: bool) -> bool {
    let Some((x, y)) = operands::<T>(a, b, alike) else {
        return true;
    };
    let (p, q) = (x.to_rational().unwrap(), y.to_rational().unwrap());
    let mpfr = Mpfr {
        bits: Native::<T>::new().bits(),
    };
    let (u, v) = (mpfr.ratio(&p), mpfr.ratio(&q));
    let mut checks = vec![
        (x + y, Rational::from(&p + &q), u.clone() + &v),
        (x - y, Rational::from(&p - &q), u.clone() - &v),
        (x * y, Rational::from(&p * &q), u.clone() * &v),
    ];
    if q != 0 {
        checks.push((x / y, p / q, u / &v));
    }
    checks.into_iter().all(|(native, exact, mpfr)| {
        let same =
            !is_in_normal_range(native, &exact) || native.to_rational() == mpfr.to_rational();
        same && is_nearest(native, &exact)
    })
}

fn square_root<T: Pattern>(a: u64) -> bool {
    let x = num_traits::Float::abs(T::from_pattern(a));
    if !x.is_finite() {
        return true;
    }
    let root = Real::sqrt(x);
    let exact = x.to_rational().unwrap();
    // √x lies between two midpoints where x lies between their squares; a root is never a tie.
    let (below, above) = midpoints(root);
    let below = below.max(Rational::new());
    Rational::from(below.square_ref()) <= exact
        && above.is_some_and(|above| exact <= Rational::from(above.square_ref()))
        && root.to_rational() == {
            let bits = Native::<T>::new().bits();
            Float::with_val(bits, &exact).sqrt().to_rational()
        }
}

/// A rational near some number of T: 53 random bits beyond it, or exactly on a midpoint.
fn rational<T: Pattern>(a: u64, beyond: i64, on_midpoint: bool) -> Option<Rational> {
    let x = T::from_pattern(a);
    if !x.is_finite() {
        return None;
    }
    let m = magnitude(x);
    let (low, high) = (value::<T>(m), value::<T>(m + 1));
    let gap = Rational::from(&high - &low);
    let place = if on_midpoint {
        Rational::from((1, 2))
    } else {
        Rational::from((beyond, i64::MAX))
    };
    let size = low + gap * place;
    Some(if x.is_sign_negative() { -size } else { size })
}

fn ratio<T: Pattern>(a: u64, beyond: i64, on_midpoint: bool) -> bool {
    rational::<T>(a, beyond, on_midpoint)
        .is_none_or(|q| is_nearest(Native::<T>::new().ratio(&q), &q))
}

/// Ties, and what lies a hair to either side of one: a double rounding falls for these.
fn ratio_near_a_tie<T: Pattern>(a: u64, hair: u8) -> bool {
    let Some(tie) = rational::<T>(a, 0, true) else {
        return true;
    };
    let hair = Rational::from(1) >> (60 + u32::from(hair));
    [
        &tie * (Rational::from(1) + &hair),
        &tie * (Rational::from(1) - &hair),
        tie,
    ]
    .iter()
    .all(|q| is_nearest(Native::<T>::new().ratio(q), q))
}

/// The same where a number comes as a sum of two of binary64: nearest, or not decided; always decided off ties.
fn nearest_to_a_sum<T: Pattern>(a: u64, beyond: i64, hair: u8) -> bool {
    let Some(tie) = rational::<T>(a, 0, true) else {
        return true;
    };
    let nearest = |q: &Rational| {
        let high = Native::<f64>::new().ratio(q);
        let low = (q - Rational::from_f64(high)?).to_f64();
        Native::<T>::new().nearest(high, low)
    };
    let hair = Rational::from(1) >> (60 + u32::from(hair % 30));
    let near = [
        &tie * (Rational::from(1) + &hair),
        &tie * (Rational::from(1) - &hair),
        tie,
    ];
    let off = rational::<T>(a, beyond, false).filter(|q| {
        // Far from a tie, and not so small that what binary64 leaves of it is lost.
        let part = beyond as f64 / i64::MAX as f64;
        *q > 1e-250 && (0.1..0.4).contains(&part)
    });
    near.iter()
        .all(|q| nearest(q).is_none_or(|x| is_nearest(x, q)))
        && off.is_none_or(|q| nearest(&q).is_some_and(|x| is_nearest(x, &q)))
}

fn fraction<T: Pattern>(a: u64, b: u64, shift: u8, factor: u8) -> bool {
    let format = Native::<T>::new();
    // Operands of every size, so that the short cut and the rational path are both taken.
    let a = a >> (shift % 64);
    let b = (b >> (shift % 61)).max(1);
    let q = Rational::from((a, b));
    let quotient = format.fraction(a, b);
    let same = match (
        a.checked_mul(factor.max(1).into()),
        b.checked_mul(factor.max(1).into()),
    ) {
        (Some(a), Some(b)) => format.fraction(a, b).pattern() == quotient.pattern(),
        _ => true,
    };
    same && is_nearest(quotient, &q) && quotient.pattern() == format.ratio(&q).pattern()
}

fn integer<T: Pattern>(n: i64, shift: u8) -> bool {
    let n = n >> (shift % 64);
    is_nearest(Native::<T>::new().int(n), &Rational::from(n))
}

/// 127.6 of the smallest subnormals round to 128, the smallest normal number, and to 127.5 without subnormals.
#[test]
fn a_product_that_rounds_up_to_the_smallest_normal_number() {
    assert!(arithmetic::<bf16>(
        12_152_119_169_529_151_488,
        10_900_399_948_096_864_256,
        false
    ));
}

fn all<T: Pattern>() {
    let mut check = QuickCheck::new().tests(3000).max_tests(3000);
    check.quickcheck(arithmetic::<T> as fn(u64, u64, bool) -> bool);
    check.quickcheck(square_root::<T> as fn(u64) -> bool);
    check.quickcheck(ratio::<T> as fn(u64, i64, bool) -> bool);
    check.quickcheck(ratio_near_a_tie::<T> as fn(u64, u8) -> bool);
    check.quickcheck(nearest_to_a_sum::<T> as fn(u64, i64, u8) -> bool);
    check.quickcheck(fraction::<T> as fn(u64, u64, u8, u8) -> bool);
    check.quickcheck(integer::<T> as fn(i64, u8) -> bool);
}

#[test]
fn binary32_is_nearest() {
    all::<f32>();
}

#[test]
fn binary64_is_nearest() {
    all::<f64>();
}

#[test]
fn binary16_is_nearest() {
    all::<f16>();
}

#[test]
fn bfloat16_is_nearest() {
    all::<bf16>();
}

#[test]
fn every_tie_of_binary16_and_bfloat16_goes_to_even() {
    fn ties<T: Pattern>() {
        for m in 0..T::INFINITY {
            let tie = (value::<T>(m) + value::<T>(m + 1)) / 2;
            let even = m + m % 2;
            assert_eq!(magnitude(Native::<T>::new().ratio(&tie)), even);
        }
    }
    ties::<f16>();
    ties::<bf16>();
}

/// IEEE 754-2019, section 4.3.1: 65519.99… is binary16's largest number, 65520 and beyond overflow.
#[test]
fn binary16_overflows_from_65520_on() {
    let format = Native::<f16>::new();
    let just_below = Rational::from(65520) - Rational::from((1, 1_u64 << 60));
    assert_eq!(format.ratio(&just_below), f16::MAX);
    assert_eq!(format.ratio(&Rational::from(65520)), f16::INFINITY);
    assert_eq!(format.ratio(&Rational::from(-65520)), f16::NEG_INFINITY);
    assert_eq!(format.int(65519), f16::MAX);
    assert_eq!(format.int(65536), f16::INFINITY);
    assert_eq!(format.fraction(65536, 65536), f16::ONE);
    // 2049 is a tie between 2048 and 2050.
    assert_eq!(format.int(2049), f16::from_f32(2048.0));
    assert_eq!(format.int(2051), f16::from_f32(2052.0));
}

#[test]
fn the_least_subnormals_half_rounds_to_zero_and_anything_more_to_itself() {
    fn check<T: Pattern>() {
        let format = Native::<T>::new();
        let least = value::<T>(1);
        let half = Rational::from(&least / 2);
        let more = &half * Rational::from((1_000_001, 1_000_000));
        assert_eq!(magnitude(format.ratio(&half)), 0);
        assert_eq!(magnitude(format.ratio(&more)), 1);
        // 3⁄2 of it is a tie between 1 and 2.
        assert_eq!(magnitude(format.ratio(&Rational::from(&half * 3))), 2);
        // A number of thousands of digits below the format's range is 0, not a fault.
        let tiny = Rational::from(1) >> 20_000_u32;
        assert_eq!(magnitude(format.ratio(&tiny)), 0);
        let huge = Rational::from(1) << 20_000_u32;
        assert_eq!(magnitude(format.ratio(&huge)), T::INFINITY);
    }
    check::<f32>();
    check::<f64>();
    check::<f16>();
    check::<bf16>();
}

/// A tie of few bits, and one to either side of it: rounding through binary32 would see only the tie.
#[test]
fn integers_beside_a_tie_are_rounded_once() {
    fn check<T: Pattern>() {
        let format = Native::<T>::new();
        for exponent in format.bits() + 2..62 {
            let tie = (1_i64 << exponent) + (1 << (exponent - format.bits()));
            for n in [tie - 1, tie, tie + 1, -tie - 1] {
                assert!(is_nearest(format.int(n), &n.into()), "{n} in {format}");
            }
        }
    }
    check::<f32>();
    check::<f64>();
    check::<f16>();
    check::<bf16>();
}

#[test]
fn significant_bits_follow_mpfr() {
    assert_eq!(Native::<bf16>::new().bits(), 8);
    assert_eq!(Native::<f16>::new().bits(), 11);
    assert_eq!(Native::<f32>::new().bits(), 24);
    assert_eq!(Native::<f64>::new().bits(), 53);
}
