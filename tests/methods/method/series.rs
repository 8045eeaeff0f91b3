//! ∫₀¹ σ exp(−θ) against closed forms with erf, and against mpmath where MPFR has no closed form.

use half::f16;
use quickcheck::QuickCheck;
use rug::float::Constant;
use rug::{Float, Rational};
use volver::inside::method::attenuated_integral;
use volver::method::MethodError;
use volver::real::{Format, Mpfr, Native, Real};

fn polynomial<F: Format>(format: F, coefficients: &[(i64, i64)]) -> Vec<F::Real> {
    let ratio = |&c: &(i64, i64)| format.ratio(&Rational::from(c));
    coefficients.iter().map(ratio).collect()
}

fn integral<F: Format>(format: F, source: &[(i64, i64)], depth: &[(i64, i64)]) -> F::Real {
    attenuated_integral(&polynomial(format, source), &polynomial(format, depth)).unwrap()
}

fn log2_relative(value: &Float, exact: &Float) -> f64 {
    let difference = Float::with_val(exact.prec(), value - exact) / exact;
    volver::real::MpfrReal::from(difference).log2_abs()
}

/// ∫₀¹ exp(−ax − bx²) dx = √(π/4b) exp(a²/4b) (erf(√b + a/2√b) − erf(a/2√b)), b > 0.
#[test]
fn growing_extinction_agrees_with_error_functions() {
    fn check(a: u8, b: u8, thick: bool) -> bool {
        let bits = 200;
        // Depths up to 4, or up to 64 and so cut into pieces.
        let scale = if thick { 8 } else { 128 };
        let (a, b) = ((i64::from(a), scale), (i64::from(b) + 1, scale));
        let ours = Float::from(integral(Mpfr { bits }, &[(1, 1)], &[a, b]));
        // erf near 1 cancels about (a + b)²/4b bits: hold thousands.
        let wide = |q: (i64, i64)| Float::with_val(8000, Rational::from(q));
        let root = wide(b).sqrt();
        let shift = wide(a) / (root.clone() * 2_u32);
        let erf = (root.clone() + &shift).erf() - shift.clone().erf();
        let pi = Float::with_val(8000, Constant::Pi);
        let exact = pi.sqrt() / (root * 2_u32) * shift.square().exp() * erf;
        log2_relative(&ours, &exact) < -185.0
    }
    let mut quickcheck = QuickCheck::new().tests(60);
    quickcheck.quickcheck(check as fn(u8, u8, bool) -> bool);
}

/// ∫₀¹ exp(−ax) dx = (1 − exp(−a))/a, and with σ = x: (1 − (1 + a) exp(−a))/a².
#[test]
fn constant_extinction_agrees_with_the_exponential() {
    for a in [(1, 1000), (1, 2), (1, 1), (3, 2), (17, 1), (900, 1)] {
        let wide = Float::with_val(600, Rational::from(a));
        let fall = (-wide.clone()).exp();
        let first = (1 - fall.clone()) / wide.clone();
        let second = (1 - (1 + wide.clone()) * fall) / wide.square();
        for bits in [24, 53, 300] {
            // Thick segments lose a bit or so for every doubling of the pieces.
            let allowed = 9.0 - f64::from(bits);
            for (source, exact) in [(&[(1, 1)][..], &first), (&[(0, 1), (1, 1)], &second)] {
                let format = Mpfr { bits };
                // The slope as the format holds it is the slope that is integrated.
                if format.ratio(&a.into()).to_rational() != Some(a.into()) && bits < 300 {
                    continue;
                }
                let ours = Float::from(integral(format, source, &[a]));
                assert!(log2_relative(&ours, exact) < allowed, "{a:?}, {bits} bits");
            }
        }
    }
}

type Fixture = (&'static [(i64, i64)], &'static [(i64, i64)], &'static str);

/// σ, θ without its constant term, ∫₀¹ σ exp(−θ): mpmath 1.3, `quad` over [0, 1] cut at 2⁻¹⁴ … ½, with
/// 80 digits and again with 100, which agreed to 80; 62 printed. The first is also exp(−2) √(π/2)
/// (erfi √2 − erfi √½) by mpmath, all digits alike; the last but one is (1 − exp(−500))/600, as θ′ = 600 σ.
const FIXTURES: [Fixture; 10] = [
    (
        &[(1, 1)],
        &[(2, 1), (-1, 2)],
        "0.47826814093502779994638032698073470367936085992914145773931711",
    ),
    (
        &[(1, 1), (1, 1)],
        &[(3, 1), (-3, 2)],
        "0.56039262571452219094298053739874805520111670645900239706000609",
    ),
    (
        &[(1, 1), (-1, 2)],
        &[(1, 3), (1, 4)],
        "0.61115833974254123018017077653882056716390956409319918590326533",
    ),
    (
        &[(0, 1), (1, 1)],
        &[(0, 1), (1, 1)],
        "0.3160602794142788392022381149192695662770944344841160827460816",
    ),
    (
        &[(1, 1), (-1, 2), (1, 3)],
        &[(1, 2), (-1, 3), (1, 5)],
        "0.72064554420553412034675536514588293292268192625432012800161023",
    ),
    (
        &[(1, 1)],
        &[(1, 1_000_000), (1, 10_000_000)],
        "0.99999946666685933328080953529907197609725029861273082143228909",
    ),
    (
        &[(1, 1), (2, 1)],
        &[(30, 1), (20, 1)],
        "0.033992296651198794988600871683536170235639248828169425876693552",
    ),
    (
        &[(1, 1)],
        &[(50, 1)],
        "0.019999999999999999999996142500304072164433965314366945974850494",
    ),
    (
        &[(1, 1), (-1, 3)],
        &[(600, 1), (-100, 1)],
        "0.0016666666666666666666666666666666666666666666666666666666666667",
    ),
    (
        &[(2, 1)],
        &[(300, 1), (150, 1), (50, 1)],
        "0.0066445913663431946562183852795743652070103507704804800529790648",
    ),
];

#[test]
fn falling_and_thick_extinction_agree_with_mpmath() {
    for (source, depth, digits) in FIXTURES {
        let exact = Float::with_val(210, Float::parse(digits).unwrap());
        // 60 digits are 199 bits.
        let ours = Float::from(integral(Mpfr { bits: 230 }, source, depth));
        assert!(log2_relative(&ours, &exact) < -198.0, "{depth:?}");
        // Rounded coefficients alone may cost the depth in units of the last place.
        let native = integral(Native::<f64>::new(), source, depth)
            .to_rational()
            .unwrap();
        let native = Float::with_val(210, native);
        assert!(
            log2_relative(&native, &exact) < -42.0,
            "{depth:?} in binary64"
        );
    }
}

#[test]
fn a_medium_without_extinction_leaves_the_source() {
    let format = Mpfr { bits: 100 };
    let source = polynomial(format, &[(1, 1), (1, 1), (3, 1)]);
    for depth in [&[][..], &[(0, 1), (0, 1)]] {
        let ours = attenuated_integral(&source, &polynomial(format, depth)).unwrap();
        // 1 + ½ + 1.
        assert_eq!(ours.to_rational(), Some((5, 2).into()));
    }
}

#[test]
fn a_segment_of_depth_65536_is_the_thickest() {
    let format = Native::<f64>::new();
    let thickest = integral(format, &[(1, 1)], &[(65536, 1)]);
    assert!((thickest * 65536.0 - 1.0).abs() < 1e-9);
    for depth in [&[(65537, 1)][..], &[(40000, 1), (-30000, 1)]] {
        let error = attenuated_integral(&[1.0], &polynomial(format, depth)).unwrap_err();
        assert!(matches!(error, MethodError::ThickSegment { .. }), "{error}");
    }
    let nan = attenuated_integral(&[1.0], &[f64::NAN]).unwrap_err();
    assert!(matches!(nan, MethodError::ThickSegment { .. }));
}

/// In binary16 neither 65530 pieces nor an odd number of them beyond 2048 is a number; the integral is.
#[test]
fn binary16_reaches_its_own_thick_segments() {
    let format = Native::<f16>::new();
    for depth in [&[(100, 1)][..], &[(3001, 1)], &[(40000, 1), (25530, 1)]] {
        let ours = integral(format, &[(1, 1)], depth).to_f64();
        // 1/θ′(0), as the source is 1 and nothing gets through.
        let exact = 1.0 / depth[0].0 as f64;
        assert!(
            (ours / exact - 1.0).abs() < 0.25,
            "{depth:?}: {ours} for {exact}"
        );
    }
}
