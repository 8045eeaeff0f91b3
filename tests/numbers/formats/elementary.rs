//! Elementary functions of emulated formats are correctly rounded: MPFR at four times the precision,
//! rounded by the definition of the format.

use super::number;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rug::{Float, Rational};
use volver::real::{Format, Ieee, Overflow, Real};

pub(crate) type Function<R> = (&'static str, fn(R) -> R, fn(Float) -> Float);

pub(crate) fn functions<R: Real>() -> [Function<R>; 13] {
    [
        ("√", R::sqrt, Float::sqrt),
        ("exp", R::exp, Float::exp),
        ("exp_m1", R::exp_m1, Float::exp_m1),
        ("ln", R::ln, Float::ln),
        ("ln_1p", R::ln_1p, Float::ln_1p),
        ("sin", |x| x.sin_cos().0, Float::sin),
        ("cos", |x| x.sin_cos().1, Float::cos),
        ("tan", R::tan, Float::tan),
        ("sinh", R::sinh, Float::sinh),
        ("cosh", R::cosh, Float::cosh),
        ("tanh", R::tanh, Float::tanh),
        ("atan", R::atan, Float::atan),
        ("erf", R::erf, Float::erf),
    ]
}

/// y to the nearest multiple of the quantum of its binade, ties to even, and beyond the largest number to
/// what the format has there.
fn by_definition(format: Ieee, y: &Float) -> Float {
    let Some(exponent) = y.get_exp() else {
        let no_infinity = y.is_infinite() && format.overflow() != Overflow::Infinity;
        return if no_infinity { nan() } else { y.clone() };
    };
    let bits = format.bits().cast_signed();
    let quantum = (exponent - 1).max(format.emin()) - bits + 1;
    let value = Float::with_val(y.prec(), y >> quantum).round_even() << quantum;
    let top = format.emax() - bits + 1;
    let all_ones = Float::with_val(128, 1) << format.bits();
    let largest = match format.overflow() {
        Overflow::Infinity => (all_ones - 1_u32) << top,
        Overflow::Nan { largest } => Float::with_val(64, largest) << top,
    };
    match (value.clone().abs() > largest, format.overflow()) {
        (false, _) => value,
        (true, Overflow::Infinity) => value / 0_u32,
        (true, Overflow::Nan { .. }) => nan(),
    }
}

fn nan() -> Float {
    Float::with_val(53, f64::NAN)
}

#[derive(Debug, Default)]
struct Seen {
    subnormal: u32,
    beyond: u32,
}

fn check(format: Ieee, x: &<Ieee as Format>::Real, seen: &mut Seen) {
    let smallest = Float::with_val(64, 1) << format.emin();
    for (name, ours, theirs) in functions() {
        let y = ours(x.clone());
        let wide = Float::with_val(4 * format.bits() + 64, x.as_float());
        let expected = by_definition(format, &theirs(wide));
        let value = y.as_float();
        let same = (value.is_nan() && expected.is_nan())
            || (*value == expected && value.is_sign_negative() == expected.is_sign_negative());
        assert!(same, "{name}({x}) in {format} gave {y}, not {expected}");
        seen.subnormal += u32::from(!expected.is_zero() && expected.clone().abs() < smallest);
        seen.beyond += u32::from(!expected.is_finite());
    }
}

/// ±m·2^e, |x| < 2^top.
fn argument(draw: &mut Pcg64, least: i32, top: i32) -> Rational {
    let significand = Rational::from(draw.next_u64()) >> 64_u32;
    let span = u64::try_from(top - least).unwrap();
    let exponent = least + i32::try_from(draw.next_u64() % span).unwrap() + 1;
    let size = significand << exponent;
    if draw.next_u64().is_multiple_of(2) {
        size
    } else {
        -size
    }
}

#[test]
fn elementary_functions_are_correctly_rounded() {
    let formats = [
        (Ieee::TF32, 2000),
        (Ieee::BFLOAT16, 2000),
        (Ieee::BINARY16, 4000),
        (Ieee::BINARY32, 4000),
        (Ieee::BINARY64, 500),
        (Ieee::new(64, -30, 31).unwrap(), 1000),
        (Ieee::new(5, -3, 4).unwrap(), 1000),
        (Ieee::new(2, 0, 1).unwrap(), 500),
    ];
    let mut draw = Pcg64::seed_from_u64(1);
    for (format, count) in formats {
        let mut seen = Seen::default();
        let least = format.emin() - format.bits().cast_signed();
        for i in 0..count {
            // From everywhere, from where functions neither vanish nor overflow, and from the subnormal
            // numbers and their neighbours.
            let (least, top) = match i % 3 {
                0 => (least, format.emax() + 1),
                1 => (-12, 5),
                _ => (least, format.emin() + 3),
            };
            let x = format.ratio(&argument(&mut draw, least, top));
            check(format, &x, &mut seen);
        }
        println!("{format}: {seen:?}");
        assert!(
            seen.subnormal > count / 5 && seen.beyond > count / 5,
            "{seen:?}"
        );
    }
}

#[test]
fn elementary_functions_of_every_8_bit_number_are_correctly_rounded() {
    for format in [Ieee::E4M3, Ieee::E5M2] {
        let mut seen = Seen::default();
        let unit = format.emin() - format.bits().cast_signed() + 1;
        for exponent in unit..=format.emax() {
            for significand in 0..1_u32 << format.bits() {
                for sign in [1.0, -1.0] {
                    let x = f64::from(significand) * 2.0_f64.powi(exponent) * sign;
                    check(format, &number(format, x), &mut seen);
                }
            }
        }
        for special in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            check(format, &number(format, special), &mut seen);
        }
        assert!(seen.subnormal > 50 && seen.beyond > 100, "{seen:?}");
    }
}

/// Within half an ulp, as the test above has it; the platform's library promises less. How much less is
/// shown by `--nocapture`.
#[test]
fn the_platforms_binary32_library_is_not_correctly_rounded_everywhere() {
    let mut draw = Pcg64::seed_from_u64(2);
    let count = 20_000;
    let format = Ieee::BINARY32;
    let mut differ = [0; 13];
    for _ in 0..count {
        let x = format.ratio(&argument(&mut draw, -12, 5));
        let native = x.as_float().to_f32();
        let pairs = functions().into_iter().zip(functions::<f32>());
        for (((_, ours, by_mpfr), (_, theirs, _)), differ) in pairs.zip(&mut differ) {
            let (ours, theirs) = (ours(x.clone()), theirs(native));
            let exact = by_mpfr(Float::with_val(160, x.as_float()));
            if exact.is_finite() && ours.is_finite() {
                let ulp = exact.get_exp().unwrap_or(0).max(-125) - 24;
                let error = Float::with_val(160, &exact - ours.as_float()).abs();
                assert!(error <= Float::with_val(53, 1) << (ulp - 1), "{x}");
            }
            let alike = ours.as_float().to_f32().to_bits() == theirs.to_bits();
            *differ += u32::from(!alike && !theirs.is_nan());
        }
    }
    for ((name, ..), differ) in functions::<f32>().iter().zip(differ) {
        println!("{name}: {differ} of {count} differ from the platform's");
    }
    // IEEE 754 asks for correct rounding of the root alone.
    assert_eq!(differ[0], 0);
}
