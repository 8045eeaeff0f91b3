//! Enclosures: functions of complex rectangles against another library's values, quadrature of polynomials, and what
//! a sample of points does not see.

use super::{bits, distance, medium, medium_of};
use rug::float::Constant;
use rug::{Float, Rational};
use volver::case::{Case, HomogeneousSlab, Reciprocal, ReciprocalSquare, SineSquared};
use volver::inside::reference::{Points, Rectangle, range};
use volver::real::{Format, Mpfr};
use volver::reference::{NotEnclosed, ReferenceError, enclosed_radiance, optical_depth, radiance};
use volver::symbolic::{Expr, Interval, Program};

fn parsed(text: &str) -> Float {
    Float::with_val(120, Float::parse(text).unwrap())
}

fn hull(a: &Float, b: &Float) -> Interval {
    let exactly = |x: &Float| Interval::exactly(&Float::with_val(64, x));
    exactly(a).union(&exactly(b))
}

/// Within, but for what 25 digits are off by.
fn holds(interval: &Interval, value: &Float) -> bool {
    let off = Float::with_val(120, value.abs_ref()) * parsed("1e-23") + parsed("1e-40");
    Float::with_val(120, interval.lower() - &off) <= *value
        && *value <= Float::with_val(120, interval.upper() + &off)
}

#[test]
fn functions_of_rectangles_have_what_another_library_finds_there() {
    let text = include_str!("../../data/complex_functions.tsv");
    let mut rows = 0;
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let fields: Vec<&str> = line.split('\t').collect();
        let formula = match fields[0] {
            "expm1" => "exp(s) - 1".to_owned(),
            "ln1p" => "ln(1 + s)".to_owned(),
            name => format!("{name}(s)"),
        };
        let formula: Expr = formula.parse().unwrap();
        let program = Program::new(&[formula], &["s"]).unwrap();
        let numbers: Vec<Float> = fields[1..].iter().map(|field| parsed(field)).collect();
        let [x, y, fx, fy, u, v, gx, gy] = &numbers[..] else {
            panic!("{line}")
        };
        for (re, im, values) in [
            (hull(x, x), hull(y, y), vec![(fx, fy)]),
            (hull(x, u), hull(y, v), vec![(fx, fy), (gx, gy)]),
        ] {
            // None is no fault: it may not be known to be analytic.
            let Some(found) = range(&program, &Rectangle { re, im }).pop().unwrap() else {
                continue;
            };
            for (real, imaginary) in values {
                assert!(holds(&found.re, real), "{line}: {}", found.re);
                assert!(holds(&found.im, imaginary), "{line}: {}", found.im);
            }
            rows += 1;
        }
        let here = Rectangle {
            re: hull(x, x),
            im: hull(y, y),
        };
        let found = range(&program, &here).pop().unwrap();
        // The two that are known by their derivative from the real line on only.
        if !matches!(fields[0], "atan" | "erf") {
            let found = found.unwrap();
            let size = Float::with_val(64, fx.abs_ref()) + fy.clone().abs() + parsed("1e-6");
            assert!(
                found.re.width() < Float::with_val(64, &size * parsed("1e-12")),
                "{line}"
            );
        }
    }
    assert!(rows > 900, "{rows}");
}

#[test]
fn what_may_not_be_analytic_has_no_rectangle() {
    let number = |x: f64| Float::with_val(64, x);
    for (formula, re, im) in [
        ("ln(s)", (-1.0, 1.0), (0.0, 1.0)),
        ("sqrt(s)", (0.0, 1.0), (0.0, 1.0)),
        ("1/s", (-1.0, 1.0), (0.0, 1.0)),
        ("1/(1 + s^2)", (-0.5, 0.5), (0.0, 1.5)),
        ("atan(s)", (-0.5, 0.5), (0.0, 1.5)),
        ("tan(s)", (1.0, 2.0), (0.0, 0.5)),
        ("tanh(s)", (-0.5, 0.5), (1.0, 2.0)),
        ("ln(1 + s)", (-2.0, 1.0), (0.0, 1.0)),
    ] {
        let program = Program::new(&[formula.parse().unwrap()], &["s"]).unwrap();
        let rectangle = Rectangle {
            re: hull(&number(re.0), &number(re.1)),
            im: hull(&number(im.0), &number(im.1)),
        };
        assert!(range(&program, &rectangle)[0].is_none(), "{formula}");
    }
}

#[test]
fn polynomials_are_integrated_as_they_are() {
    for n in [8, 32, 128] {
        let points = Points::new(n, 200);
        for power in 0..n {
            let values: Vec<Interval> = points
                .cosines()
                .iter()
                .map(|x| x.pow(&Rational::from(power)))
                .map(|value| value.unwrap_or_else(|_| Interval::point(200, &Rational::from(1))))
                .collect();
            let sign = |k: usize| if k.is_multiple_of(2) { 1 } else { -1 };
            // From −1 to x: (x^(k+1) − (−1)^(k+1))/(k + 1).
            let exact = |x: &Float| {
                let top = Float::with_val(300, rug::ops::Pow::pow(x, power as u32 + 1));
                (top - sign(power + 1)) / (power as u64 + 1)
            };
            let whole = points.integral(&values);
            assert!(
                whole.contains(&exact(&Float::with_val(300, 1))) || power == 0,
                "{n} {power}"
            );
            assert!(whole.width() < Float::with_val(64, 1e-50), "{n} {power}");
            for (place, found) in points.cosines().iter().zip(points.integrals(&values)) {
                let exact = exact(&Float::with_val(300, place.midpoint()));
                let off = distance(&exact, &found.midpoint());
                assert!(off < Float::with_val(64, 1e-50), "{n} {power}: {off}");
            }
        }
    }
}

/// I of C = 1: 1 − e^(−t).
fn opacity(depth: Float) -> Float {
    -(-depth).exp_m1()
}

#[test]
fn layers_that_no_point_sees_are_found() {
    let pi = Float::with_val(400, Constant::Pi);
    for (width, place) in [("1e-3", "0.3717"), ("1e-6", "0.14154"), ("1e-9", "0.7071")] {
        let case = medium(&format!("1 + 1000000*exp(-((s - {place})/{width})^2)"), "1");
        let width = parsed(width);
        // Both ends are thousands of widths away: erf is 1 to all digits.
        let depth =
            Float::with_val(400, pi.sqrt_ref()) * Float::with_val(400, width) * 1_000_000_u32
                + 1_u32;
        let found = radiance(&case, bits(30)).unwrap();
        assert!(found.is_enclosed());
        let error = distance(&found.value, &opacity(depth));
        // The width is a decimal number: 120 bits of it.
        assert!(error < parsed("1e-29"), "{error}");
    }
}

#[test]
fn kinks_and_jumps_that_nobody_told_of_cost_a_few_panels() {
    let plain = |extinction: &str| {
        let text = |t: &str| t.parse().unwrap();
        let formulas = volver::case::Formulas {
            field: text("lambda"),
            extinction: text(extinction),
            emission: text("1"),
            optical_depth: None,
            radiance: None,
        };
        let structure = volver::case::Structure::default();
        volver::case::SymbolicCase::new("a", Rational::from(1), formulas, structure).unwrap()
    };
    let third = Float::with_val(300, 1) / 3_u32;
    for (extinction, depth) in [
        ("piecewise(s < 1/3, 1, 3)", Float::with_val(300, 7) / 3_u32),
        // (1/9 + 4/9)/2.
        ("abs(s - 1/3)", Float::with_val(300, 5) / 18_u32),
        (
            "max(s, 1/3)",
            third.clone() * &third + (1 - third.clone() * &third) / 2_u32,
        ),
        // A value at one place counts for nothing.
        (
            "piecewise(s < 1/3, 1, s <= 1/3, 7, 1)",
            Float::with_val(300, 1),
        ),
        // Two sides of a comparison that touch along half of the ray, and are less on the other.
        (
            "piecewise(min(s, 1/2) - 1/2 < 0, 1, 2)",
            Float::with_val(300, 1.5),
        ),
        (
            "piecewise(-(max(s, 1/2) - 1/2)^2 < 0, 2, 1)",
            Float::with_val(300, 1.5),
        ),
    ] {
        let found = enclosed_radiance(&plain(extinction), bits(50)).unwrap();
        let error = distance(&found.value, &opacity(depth));
        assert!(
            error <= found.error,
            "{extinction}: {error} {}",
            found.error
        );
        assert!(found.digits().unwrap() >= 50, "{extinction}");
        assert!(found.work.panels < 20, "{extinction}: {:?}", found.work);
    }
}

#[test]
fn few_bits_are_as_certain_as_many() {
    // What series leave out is all of the error here, and none of it is rounding.
    for text in [
        "1 + 100*exp(-((s - 0.37)/0.01)^2)",
        "2 + tanh((s - 0.4)/0.001)",
        "1/(1 + ((s - 0.6)/0.01)^2)",
        "sqrt(s)",
    ] {
        let case = medium(text, "1 + cos(5*s)");
        let exact = enclosed_radiance(&case, 300).unwrap();
        for bits in [10, 16, 24, 32, 40, 56] {
            let found = enclosed_radiance(&case, bits).unwrap();
            let error = distance(&found.value, &exact.value);
            assert!(
                error <= Float::with_val(64, &found.error + &exact.error),
                "{text} {bits}"
            );
        }
    }
}

#[test]
fn light_that_cancels_is_a_ball_around_0() {
    // ∫ (s − 1 + 1/(e − 1)) e^(−s) = 0.
    let case = medium("1", "s - 1 + 1/(exp(1) - 1)");
    let found = enclosed_radiance(&case, bits(30)).unwrap();
    assert!(found.value.is_zero());
    assert!(!found.error.is_zero() && found.error < parsed("1e-60"));
    assert_eq!(found.digits(), Some(0));
    // And what is 0 everywhere is 0.
    let dark = enclosed_radiance(&medium("1 + s", "0"), bits(30)).unwrap();
    assert!(dark.error.is_zero() && dark.value.is_zero());
}

#[test]
fn faint_thick_and_long_rays_have_their_digits() {
    // ∫ e^s k(1 + s), k = 1e-300: e·k but for its square.
    let faint = medium("(1 + s)/1000000000000", "exp(s)");
    let found = radiance(&faint, bits(40)).unwrap();
    assert!(found.is_enclosed() && found.digits().unwrap() >= 40);
    // ∫ s K e^(−Ks) = (1 − e^(−K)(1 + K))/K.
    let thick = radiance(&medium("1000000", "s"), bits(40)).unwrap();
    let error = distance(&thick.value, &(Float::with_val(300, 1) / 1_000_000_u32));
    assert!(thick.is_enclosed() && error <= thick.error);
    // t(10³) of 1 + sin = 10³ + 1 − cos 10³.
    let long = medium_of("1000", "1 + sin(s)", "1");
    let found = optical_depth(&long, bits(40)).unwrap();
    let exact = 1001 - Float::with_val(300, 1000).cos();
    assert!(found.is_enclosed() && distance(&found.value, &exact) <= found.error);
}

#[test]
fn what_has_no_bound_is_an_estimate_and_says_why() {
    // The logarithm is integrable, and its range at 0 is not bounded.
    let case = volver::case::SymbolicCase::new(
        "a",
        Rational::from(1),
        volver::case::Formulas {
            field: "lambda".parse().unwrap(),
            extinction: "1".parse().unwrap(),
            emission: "ln(s)".parse().unwrap(),
            optical_depth: None,
            radiance: None,
        },
        volver::case::Structure::default(),
    )
    .unwrap();
    let error = enclosed_radiance(&case, 64).unwrap_err();
    let ReferenceError::NotEnclosed { reason } = error else {
        panic!("{error}")
    };
    let NotEnclosed::NotBounded { lambda } = reason else {
        panic!("{reason}")
    };
    assert!(lambda < 1e-9);
    let sampled = Sampled;
    let found = radiance(&sampled, 64).unwrap();
    assert_eq!(found.not_enclosed, Some(NotEnclosed::NoFormulas));
}

/// The formulas of a case in Rust against its code: the closed forms at the end, the medium within.
fn formulas_are_the_code<C: Case>(case: &C) {
    let format = Mpfr { bits: 400 };
    let name = case.name();
    let end = format.ratio(&case.length());
    let found = radiance(case, 300).unwrap();
    assert!(found.is_enclosed(), "{name}");
    let code: Float = case.radiance(&end).unwrap().into();
    assert!(distance(&found.value, &code) < 1e-85, "{name}");
    let found = optical_depth(case, 300).unwrap();
    let code: Float = case.optical_depth(&end).unwrap().into();
    assert!(
        found.is_enclosed() && distance(&found.value, &code) < 1e-85,
        "{name}"
    );
    let program = case.integrand().unwrap();
    for tenth in 0..=10 {
        let place = format.ratio(&(case.length() * Rational::from((tenth, 10))));
        let code = case.transfer(&case.field(&place));
        let mut outputs = [Vec::new(), Vec::new()];
        program.bind(format).run(&[&[place]], &mut outputs);
        for (output, code) in outputs.iter().zip([code.emission, code.extinction]) {
            let (formula, code): (Float, Float) = (output[0].clone().into(), code.into());
            assert!(distance(&formula, &code) < 1e-110, "{name} at {tenth}/10");
        }
    }
    let enclosed = enclosed_radiance(case, 300).unwrap();
    let code: Float = case.radiance(&end).unwrap().into();
    assert!(distance(&enclosed.value, &code) < 1e-85, "{name}");
}

#[test]
fn cases_in_rust_have_formulas_that_are_their_code() {
    formulas_are_the_code(&SineSquared);
    formulas_are_the_code(&Reciprocal);
    formulas_are_the_code(&ReciprocalSquare);
    formulas_are_the_code(&HomogeneousSlab {
        length: Rational::from((5, 3)),
        extinction: Rational::from((7, 4)),
        emission: Rational::from((2, 9)),
    });
}

/// A medium that is code.
#[derive(Debug)]
struct Sampled;

impl Case for Sampled {
    fn name(&self) -> &'static str {
        "sampled"
    }
    fn length(&self) -> Rational {
        Rational::from(1)
    }
    fn field<R: volver::real::Real>(&self, lambda: &R) -> R {
        lambda.clone()
    }
    fn transfer<R: volver::real::Real>(&self, s: &R) -> volver::case::Transfer<R> {
        volver::case::Transfer {
            emission: s.clone(),
            extinction: s.clone(),
        }
    }
    fn optical_depth<R: volver::real::Real>(&self, _: &R) -> Option<R> {
        None
    }
    fn radiance<R: volver::real::Real>(&self, _: &R) -> Option<R> {
        None
    }
    fn structure(&self) -> volver::case::Structure {
        volver::case::Structure::default()
    }
}
