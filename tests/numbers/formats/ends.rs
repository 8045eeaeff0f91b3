//! What defines an emulated format: its ends, ties, gradual underflow, and what is refused.

use half::{bf16, f16};
use rug::{Float, Rational};
use volver::real::{
    Format, FormatError, Ieee, MAX_EXPONENT, MAX_IEEE_BITS, Native, NativeFloat, Overflow, Real,
};

fn power(exponent: i32) -> Rational {
    Rational::from(1) << exponent
}

#[test]
fn named_formats_have_the_ends_of_native_ones() {
    fn check<T: NativeFloat>(format: Ieee) {
        assert_eq!(format.bits(), Native::<T>::new().bits());
        let smallest = Real::to_rational(&T::min_positive_value()).unwrap();
        assert_eq!(power(format.emin()), smallest);
        let largest = Real::to_rational(&T::max_value()).unwrap();
        assert_eq!(format.ratio(&largest).to_rational(), Some(largest.clone()));
        let half_more = largest + power(format.emax() - format.bits().cast_signed());
        assert!(!format.ratio(&half_more).is_finite());
    }
    check::<f16>(Ieee::BINARY16);
    check::<bf16>(Ieee::BFLOAT16);
    check::<f32>(Ieee::BINARY32);
    check::<f64>(Ieee::BINARY64);
}

/// Every tie of the subnormal numbers and the two binades above them, and what lies a hair beside it,
/// where rounding first to all bits would find a tie.
#[test]
fn ratios_round_once_gradual_underflow_included() {
    for format in [Ieee::E4M3, Ieee::E5M2, Ieee::BINARY16, Ieee::TF32] {
        let bits = format.bits().cast_signed();
        let quantum = power(format.emin() - bits + 1);
        let hair = Rational::from(&quantum >> 200_u32);
        for m in 0..1_u32 << format.bits() {
            let tie = Rational::from((2 * m + 1, 2)) * &quantum;
            // At and above 2^bits quanta numbers are 2 quanta apart, and this is none of them.
            let even = Rational::from(m + m % 2) * &quantum;
            let (below, above) = (Rational::from(&tie - &hair), Rational::from(&tie + &hair));
            for (q, expected) in [
                (&tie, even),
                (&below, Rational::from(m) * &quantum),
                (&above, Rational::from(m + 1) * &quantum),
            ] {
                assert_eq!(format.ratio(q).to_rational(), Some(expected.clone()), "{q}");
                let negative = format.ratio(&Rational::from(-q));
                assert_eq!(negative.to_rational(), Some(-expected));
                assert!(negative.as_float().is_sign_negative());
            }
        }
    }
}

#[test]
fn fractions_and_integers_are_ratios() {
    let formats = [Ieee::E4M3, Ieee::TF32, Ieee::new(64, -20, 63).unwrap()];
    for format in formats {
        for (a, b) in [
            (1, 3),
            (1, 1 << 20),
            (3, 1 << 20),
            (u64::MAX, 1),
            (u64::MAX, u64::MAX - 1),
            (1, u64::MAX),
            (0, 7),
        ] {
            let ratio = format.ratio(&Rational::from((a, b)));
            let fraction = format.fraction(a, b);
            assert_eq!(fraction.to_rational(), ratio.to_rational(), "{a}/{b}");
        }
        for n in [0, 1, -449, i64::MAX, i64::MIN] {
            let ratio = format.ratio(&n.into()).to_rational();
            assert_eq!(format.int(n).to_rational(), ratio, "{n}");
        }
    }
}

#[test]
fn pi_is_rounded_once() {
    let wide = Float::with_val(300, rug::float::Constant::Pi);
    let exact = wide.to_rational().unwrap();
    let coarse = Ieee::new(8, 0, 1).unwrap();
    for format in [Ieee::E4M3, Ieee::TF32, Ieee::BINARY64, coarse] {
        assert_eq!(format.pi(), format.ratio(&exact));
    }
    // 3.25, 3 and 3.5 are neighbours in E4M3.
    assert_eq!(Ieee::E4M3.pi().as_float().to_f64(), 3.25);
}

#[test]
fn a_number_keeps_its_own_format_when_it_takes_a_value() {
    let mut narrow = Ieee::E5M2.int(0);
    narrow.set(&Ieee::BINARY32.fraction(1, 3));
    assert_eq!(narrow.format(), Ieee::E5M2);
    assert_eq!(narrow, Ieee::E5M2.fraction(1, 3));
    narrow.set(&Ieee::BINARY32.int(100_000));
    assert_eq!(narrow.as_float().to_f64(), f64::INFINITY);
    narrow.set(&Ieee::BINARY64.ratio(&power(-17)));
    assert!(narrow.as_float().is_zero());
}

#[test]
fn logarithms_and_printing() {
    let least = Ieee::BINARY64.ratio(&power(-1074));
    assert_eq!(least.log2_abs(), -1074.0);
    assert_eq!(Ieee::E5M2.int(0).log2_abs(), f64::NEG_INFINITY);
    assert_eq!(Ieee::E5M2.int(-6).to_string(), "-6.0");
    assert_eq!(Ieee::E4M3.int(1000).to_string(), "NaN");
    assert_eq!(Ieee::E4M3.overflow(), Overflow::Nan { largest: 14 });
    assert_eq!((Ieee::TF32.emin(), Ieee::TF32.emax()), (-126, 127));
}

/// Exponentials far beyond the format, and reduction of its largest arguments.
#[test]
fn the_widest_range_stays_inside_mpfrs() {
    let format = Ieee::new(MAX_IEEE_BITS, -MAX_EXPONENT, MAX_EXPONENT).unwrap();
    let largest = format.ratio(&power(MAX_EXPONENT));
    let least = format.ratio(&power(-MAX_EXPONENT - 63));
    assert!(least > format.int(0));
    assert_eq!(largest.clone() * &largest, format.int(1) / &format.int(0));
    assert!((least.clone() * &least).as_float().is_zero());
    assert!(!largest.clone().exp().is_finite());
    assert!((-largest.clone()).exp().as_float().is_zero());
    let (sin, cos) = largest.sin_cos();
    assert!((sin.clone() * &sin + &(cos.clone() * &cos) - &format.int(1)).log2_abs() < -60.0);
}

#[test]
fn what_is_out_of_range_is_refused_with_what_is_allowed() {
    for (bits, emin, emax) in [
        (1, -126, 127),
        (0, -126, 127),
        (65, -126, 127),
        (24, 1, 127),
        (24, -262_144, 127),
        (24, i32::MIN, 127),
        (24, -126, 0),
        (24, -126, 262_144),
        (24, -126, i32::MAX),
    ] {
        let error = Ieee::new(bits, emin, emax).unwrap_err();
        assert_eq!(error, FormatError::IeeeRange { bits, emin, emax });
        assert_eq!(
            error.to_string(),
            format!(
                "format 'ieee:{bits},{emin},{emax}' is out of range (allowed: ieee:BITS,EMIN,EMAX with 2 ≤ BITS ≤ 64, -262143 ≤ EMIN ≤ 0, 1 ≤ EMAX ≤ 262143)"
            )
        );
    }
    assert!(Ieee::new(2, 0, 1).is_ok());
}
