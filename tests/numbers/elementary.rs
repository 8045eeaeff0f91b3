//! Elementary functions, exact values and logarithms, in native formats and in MPFR.

use half::{bf16, f16};
use quickcheck::QuickCheck;
use rug::float::Special;
use rug::ops::Pow;
use rug::{Float, Rational};
use volver::real::{Format, Mpfr, MpfrReal, Native, NativeFloat, Real};

/// One elementary function in any scalar, so that a native format and MPFR run the same.
#[derive(Clone, Copy, Debug)]
enum Function {
    Exp,
    ExpM1,
    Ln,
    Ln1p,
    Sin,
    Cos,
    Tan,
    Sinh,
    Cosh,
    Tanh,
    Atan,
    Erf,
}

const FUNCTIONS: [Function; 12] = [
    Function::Exp,
    Function::ExpM1,
    Function::Ln,
    Function::Ln1p,
    Function::Sin,
    Function::Cos,
    Function::Tan,
    Function::Sinh,
    Function::Cosh,
    Function::Tanh,
    Function::Atan,
    Function::Erf,
];

impl Function {
    fn of<R: Real>(self, x: R) -> R {
        match self {
            Function::Exp => x.exp(),
            Function::ExpM1 => x.exp_m1(),
            Function::Ln => x.abs().ln(),
            Function::Ln1p => x.abs().ln_1p(),
            Function::Sin => x.sin_cos().0,
            Function::Cos => x.sin_cos().1,
            Function::Tan => x.tan(),
            Function::Sinh => x.sinh(),
            Function::Cosh => x.cosh(),
            Function::Tanh => x.tanh(),
            Function::Atan => x.atan(),
            Function::Erf => x.erf(),
        }
    }

    /// By rug alone.
    fn by_mpfr(self, x: Float) -> Float {
        match self {
            Function::Exp => x.exp(),
            Function::ExpM1 => x.exp_m1(),
            Function::Ln => x.abs().ln(),
            Function::Ln1p => x.abs().ln_1p(),
            Function::Sin => x.sin(),
            Function::Cos => x.cos(),
            Function::Tan => x.tan(),
            Function::Sinh => x.sinh(),
            Function::Cosh => x.cosh(),
            Function::Tanh => x.tanh(),
            Function::Atan => x.atan(),
            Function::Erf => x.erf(),
        }
    }
}

/// x = ±m·2⁻ᵏ with |x| < 16 and k up to 40: large, moderate and tiny arguments.
fn argument(numerator: i32, shift: u8) -> Rational {
    Rational::from(numerator) >> (27 + u32::from(shift % 40))
}

/// |y − exact| in units of the last of `bits` places of the exact value.
fn ulps(y: &Rational, exact: &Float, bits: u32) -> Float {
    let exponent = exact.get_exp().unwrap_or(0) - bits.cast_signed();
    let error = Float::with_val(exact.prec(), exact - y).abs();
    error >> exponent
}

fn native_is_close<T: NativeFloat>(numerator: i32, shift: u8) -> bool {
    let format = Native::<T>::new();
    let x = format.ratio(&argument(numerator, shift));
    let bits = format.bits();
    let exact_argument = Float::with_val(4 * bits, x.to_rational().unwrap());
    FUNCTIONS.iter().all(|&function| {
        let y = function.of(x);
        let exact = function.by_mpfr(exact_argument.clone());
        let normal = exact.is_finite()
            && exact.clone().abs() >= T::min_positive_value().to_rational().unwrap()
            && exact.clone().abs() < T::max_value().to_rational().unwrap();
        // Libraries promise less than 1 ulp for binary32 and binary64, and up to 2 for the hyperbolic
        // functions; half's are rounded from those.
        let promised = match function {
            Function::Sinh | Function::Cosh | Function::Tanh => 2.5,
            _ => 1.5,
        };
        !normal || ulps(&y.to_rational().unwrap(), &exact, bits) <= promised
    })
}

#[test]
fn native_elementary_functions_are_within_ulps_of_mpfr() {
    let mut check = QuickCheck::new().tests(2000).max_tests(2000);
    check.quickcheck(native_is_close::<f32> as fn(i32, u8) -> bool);
    check.quickcheck(native_is_close::<f64> as fn(i32, u8) -> bool);
    check.quickcheck(native_is_close::<f16> as fn(i32, u8) -> bool);
    check.quickcheck(native_is_close::<bf16> as fn(i32, u8) -> bool);
}

#[test]
fn mpfr_elementary_functions_are_correctly_rounded() {
    fn check(numerator: i32, shift: u8, bits: u8) -> bool {
        let format = Mpfr {
            bits: 2 + u32::from(bits),
        };
        let x = format.ratio(&argument(numerator, shift));
        FUNCTIONS.iter().all(|&function| {
            let y = Float::from(function.of(x.clone()));
            let wide = Float::with_val(2 * format.bits + 64, x.as_float());
            let exact = function.by_mpfr(wide);
            // Rounded once from twice the precision is rounded correctly unless that ends in a tie.
            let expected = Float::with_val(format.bits, &exact);
            y.prec() == format.bits && y == expected
        })
    }
    let mut quickcheck = QuickCheck::new().tests(2000).max_tests(2000);
    quickcheck.quickcheck(check as fn(i32, u8, u8) -> bool);
}

#[test]
fn expm1_and_ln1p_do_not_cancel() {
    // To first order both are x itself: 2⁻⁴⁰ vanishes beside 1 in binary32.
    let x = Native::<f32>::new().ratio(&(Rational::from(1) >> 40_u32));
    assert_eq!(Real::exp_m1(x).to_bits(), x.to_bits());
    assert_eq!(Real::ln_1p(x).to_bits(), x.to_bits());
}

fn pi_is_nearest<T: NativeFloat>(exact: &Float) {
    let format = Native::<T>::new();
    let pi = Float::with_val(format.bits(), exact);
    assert_eq!(format.pi().to_rational(), pi.to_rational());
}

#[test]
fn pi_is_rounded_once() {
    // The first 40 digits of OEIS A000796, far beyond 53 bits.
    let digits = "3.141592653589793238462643383279502884197";
    let exact = Float::with_val(130, Float::parse(digits).unwrap());
    pi_is_nearest::<f32>(&exact);
    pi_is_nearest::<f64>(&exact);
    pi_is_nearest::<f16>(&exact);
    pi_is_nearest::<bf16>(&exact);
    let at_100 = Float::from(Mpfr { bits: 100 }.pi());
    assert_eq!(at_100, Float::with_val(100, &exact));
}

#[test]
fn exact_values_go_out_and_come_back() {
    fn native(a: u64) -> bool {
        let x = f64::from_bits(a);
        match x.to_rational() {
            Some(q) => x == 0.0 || Native::<f64>::new().ratio(&q).to_bits() == a,
            None => !x.is_finite(),
        }
    }
    fn mpfr(mantissa: i64, shift: i16) -> bool {
        // 63 bits of mantissa do not fit 53: a value that goes through binary64 would be lost.
        let q = Rational::from(mantissa) << i32::from(shift);
        Mpfr { bits: 64 }.ratio(&q).to_rational() == Some(q)
    }
    let mut check = QuickCheck::new().tests(2000).max_tests(2000);
    check.quickcheck(native as fn(u64) -> bool);
    check.quickcheck(mpfr as fn(i64, i16) -> bool);
}

#[test]
fn what_is_not_finite_has_no_exact_value() {
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(x.to_rational(), None);
        assert!(!Real::is_finite(&x));
        assert_eq!(Real::to_rational(&f16::from_f64(x)), None);
    }
    for special in [Special::Nan, Special::Infinity, Special::NegInfinity] {
        let x = MpfrReal::from(Float::with_val(53, special));
        assert_eq!(x.to_rational(), None);
        assert!(!x.is_finite());
    }
    assert!(Real::is_finite(&1.0_f32));
    assert!(Mpfr { bits: 9 }.int(1).is_finite());
}

#[test]
fn log2_abs_survives_zero_subnormals_and_beyond() {
    assert_eq!(0.0_f64.log2_abs().to_bits(), f64::NEG_INFINITY.to_bits());
    assert_eq!((-0.0_f32).log2_abs().to_bits(), f64::NEG_INFINITY.to_bits());
    assert_eq!(
        f64::from_bits(1).log2_abs().to_bits(),
        (-1074.0_f64).to_bits()
    );
    assert_eq!(
        f32::from_bits(1).log2_abs().to_bits(),
        (-149.0_f64).to_bits()
    );
    assert_eq!(
        f16::from_bits(1).log2_abs().to_bits(),
        (-24.0_f64).to_bits()
    );
    assert_eq!((-8.0_f64).log2_abs().to_bits(), 3.0_f64.to_bits());
    assert!(f64::NAN.log2_abs().is_nan());

    let mpfr = Mpfr { bits: 100 };
    assert_eq!(
        mpfr.int(0).log2_abs().to_bits(),
        f64::NEG_INFINITY.to_bits()
    );
    assert_eq!(mpfr.int(-8).log2_abs().to_bits(), 3.0_f64.to_bits());
    // −5000 log₂ 10, far below binary64's least exponent.
    let tiny = mpfr.ratio(&Rational::from(10).pow(-5000));
    assert!((tiny.log2_abs() + 5000.0 * std::f64::consts::LOG2_10).abs() < 1e-10);
}

#[test]
fn a_number_keeps_its_own_precision_when_it_takes_a_value() {
    let third = Rational::from((1, 3));
    let mut narrow = Mpfr { bits: 20 }.int(0);
    narrow.set(&Mpfr { bits: 200 }.ratio(&third));
    assert_eq!(narrow.format(), Mpfr { bits: 20 });
    assert_eq!(narrow, Mpfr { bits: 20 }.ratio(&third));
    let mut native = 0.0_f64;
    native.set(&0.75);
    assert_eq!(native.to_bits(), 0.75_f64.to_bits());
    assert_eq!(0.5_f32.format(), Native::<f32>::new());
}

#[test]
fn absolute_value_and_negation() {
    assert_eq!(Real::abs(-2.5_f64).to_bits(), 2.5_f64.to_bits());
    let mpfr = Mpfr { bits: 30 };
    assert_eq!((-mpfr.int(7)).abs(), mpfr.int(7));
    assert_eq!(-mpfr.int(7), mpfr.int(-7));
}

#[test]
fn formats_and_numbers_print() {
    assert_eq!(Native::<f16>::default().to_string(), "f16");
    assert_eq!(format!("{:?}", Native::<f64>::new()), "f64");
    assert_eq!(Mpfr { bits: 77 }.to_string(), "mpfr:77");
    assert_eq!(Mpfr { bits: 10 }.int(3).to_string(), "3.0000");
}
