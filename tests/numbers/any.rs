//! Numbers of a format known at run time have the bits of that format's own numbers.

use half::{bf16, f16};
use quickcheck::QuickCheck;
use rug::{Float, Rational};
use std::cmp::Ordering;
use volver::real::lanes::LaneFormat;
use volver::real::{AnyReal, Fixed, Format, FormatName, Ieee, Mpfr, Native, Real};

/// The same number, or NaN both, and the same text of it.
fn same<R: Real>(own: &R, any: &AnyReal) -> bool {
    let (a, b) = (own.to_float(), any.to_float());
    (a == b || (a.is_nan() && b.is_nan()))
        && a.is_sign_negative() == b.is_sign_negative()
        && own.to_rational() == any.to_rational()
        && own.is_finite() == any.is_finite()
        && own.log2_abs().to_bits() == any.log2_abs().to_bits()
        && own.to_string() == any.to_string()
}

/// All that a number can do, in the format's own type and in the one for all.
fn all_the_same<F: Format>(own: F, name: FormatName, x: &Rational, y: &Rational) -> bool {
    let (a, b) = (own.ratio(x), own.ratio(y));
    let (any_a, any_b) = (name.ratio(x), name.ratio(y));
    macro_rules! functions {
        ($($function:ident),*) => {
            $(same(&a.clone().$function(), &any_a.clone().$function()))&&*
        };
    }
    macro_rules! operators {
        ($($operator:tt, $assign:tt;)*) => {
            $({
                let (mut assigned, mut any_assigned) = (a.clone(), any_a.clone());
                assigned $assign &b;
                any_assigned $assign &any_b;
                same(&assigned, &any_assigned)
                    && same(&(a.clone() $operator &b), &(any_a.clone() $operator &any_b))
            })&&*
        };
    }
    let (sin, cos) = a.clone().sin_cos();
    let (any_sin, any_cos) = any_a.clone().sin_cos();
    let (mut set, mut any_set) = (a.clone(), any_a.clone());
    set.set(&b);
    any_set.set(&any_b);
    same(&a, &any_a)
        && any_a.format() == name
        && Format::bits(name) == own.bits()
        && name.to_string() == own.to_string()
        && operators! { +, +=; -, -=; *, *=; /, /=; }
        && same(&-a.clone(), &-any_a.clone())
        && functions!(
            abs, sqrt, exp, exp_m1, ln, ln_1p, tan, sinh, cosh, tanh, atan, erf
        )
        && same(&sin, &any_sin)
        && same(&cos, &any_cos)
        && same(&set, &any_set)
        && a.partial_cmp(&b) == any_a.partial_cmp(&any_b)
        && (a == b) == (any_a == any_b)
}

fn in_every_format(a: i32, b: u16, c: i16, d: u8) -> bool {
    let x = Rational::from((a, u32::from(b) + 1));
    let y = Rational::from((i32::from(c), u32::from(d) + 1));
    let fixed = Fixed::new(8, 15).unwrap();
    let mpfr = Mpfr { bits: 100 };
    all_the_same(Native::<f16>::new(), FormatName::F16, &x, &y)
        && all_the_same(Native::<bf16>::new(), FormatName::Bf16, &x, &y)
        && all_the_same(Native::<f32>::new(), FormatName::F32, &x, &y)
        && all_the_same(Native::<f64>::new(), FormatName::F64, &x, &y)
        && all_the_same(LaneFormat::<f32>::new(), FormatName::F32Lanes, &x, &y)
        && all_the_same(LaneFormat::<f64>::new(), FormatName::F64Lanes, &x, &y)
        && all_the_same(Ieee::TF32, FormatName::Ieee(Ieee::TF32), &x, &y)
        && all_the_same(Ieee::E4M3, FormatName::Ieee(Ieee::E4M3), &x, &y)
        && all_the_same(fixed, FormatName::Fixed(fixed), &x, &y)
        && all_the_same(mpfr, FormatName::Mpfr(100), &x, &y)
}

#[test]
fn numbers_of_a_named_format_are_those_of_its_own_type() {
    QuickCheck::new().quickcheck(in_every_format as fn(i32, u16, i16, u8) -> bool);
    // 0/0, x/0 and equal numbers, which random ones seldom are.
    assert!(in_every_format(0, 0, 0, 0));
    assert!(in_every_format(-3, 1, 0, 0));
    assert!(in_every_format(3, 1, 3, 1));
}

#[test]
fn constants_of_a_named_format_are_those_of_its_own_type() {
    fn check<F: Format>(own: F, name: FormatName) {
        for n in [0, -7, 65_519, 65_520, i64::MAX] {
            assert!(same(&own.int(n), &name.int(n)), "{name}: {n}");
        }
        for (p, q) in [(1, 3), (2, 3), (u64::MAX, 7), (1, u64::MAX)] {
            let (own, any) = (own.fraction(p, q), name.fraction(p, q));
            assert!(same(&own, &any), "{name}: {p}/{q}");
        }
        for x in [0.1, -0.0, 1e300, 1e-300, f64::NAN, f64::INFINITY] {
            assert!(same(&own.binary64(x), &name.binary64(x)), "{name}: {x}");
        }
        assert!(same(&own.pi(), &name.pi()), "{name}: π");
    }
    let fixed = Fixed::new(16, 30).unwrap();
    check(Native::<f16>::new(), FormatName::F16);
    check(Native::<bf16>::new(), FormatName::Bf16);
    check(Native::<f32>::new(), FormatName::F32);
    check(Native::<f64>::new(), FormatName::F64);
    check(Ieee::E5M2, FormatName::Ieee(Ieee::E5M2));
    check(fixed, FormatName::Fixed(fixed));
    check(Mpfr { bits: 53 }, FormatName::Mpfr(53));
}

/// 1 + 2⁻¹² is 1 in binary16, which has 11 bits, and itself in binary64.
#[test]
fn a_number_of_another_format_is_first_rounded_to_that_on_the_left() {
    let fine = FormatName::F64.ratio(&Rational::from((4097, 4096)));
    let half = FormatName::F16.int(1);
    let sum = half.clone() + &fine;
    assert_eq!(sum.format(), FormatName::F16);
    assert_eq!(sum.to_float(), Float::with_val(53, 2));
    let sum = fine.clone() + &half;
    assert_eq!(sum.format(), FormatName::F64);
    assert_eq!(sum.to_rational(), Some(Rational::from((8193, 4096))));
    let mut set = half.clone();
    set.set(&fine);
    assert_eq!(set.format(), FormatName::F16);
    assert_eq!(set.to_float(), Float::with_val(53, 1));
    // Compared by value, whatever the formats.
    assert_eq!(half.partial_cmp(&fine), Some(Ordering::Less));
    assert_eq!(half, FormatName::Mpfr(20).int(1));
    let infinite = FormatName::F64.int(1) / &FormatName::F64.int(0);
    assert!((half - &infinite).to_float().is_nan());
}
