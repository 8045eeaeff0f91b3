//! Generic methods run in these formats and compute there what they say.

use super::number;
use super::rounding::rounded;
use half::{bf16, f16};
use rug::Rational;
use volver::case::{Case, Fresh, HomogeneousSlab, Reciprocal, ReciprocalSquare, SineSquared};
use volver::method::{Exponential, Inner, Method, Nested, Outer, Scope};
use volver::quadrature::Rule;
use volver::real::{Fixed, Format, FormatName, Ieee, Mpfr, Native, NativeFloat, Real};
use volver::symbolic::{Expr, KeptProgram, Program};

fn nested(inner: Rule, outer: Rule, exponential: Exponential, scope: Scope) -> Method {
    Method::Nested(Nested {
        inner: Inner::PerSegment(inner),
        outer: Outer(outer),
        exponential,
        scope,
    })
}

fn trapezoids(exponential: Exponential) -> Method {
    nested(Rule::Trapezoid, Rule::Trapezoid, exponential, Scope::Whole)
}

fn radiance<F: Format>(method: &Method, case: &impl Case, format: F, n: u64) -> F::Real {
    method.radiance(&Fresh::new(case, format), n).unwrap()
}

/// Where + − × ÷ are all, an emulated format gives the native one's result.
fn equals_native<T: NativeFloat>(format: Ieee) {
    let slab = HomogeneousSlab {
        length: Rational::from((7, 3)),
        extinction: Rational::from((13, 10)),
        emission: Rational::from((3, 7)),
    };
    let rules = [
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::Midpoint,
        Rule::GaussLegendre(3),
    ];
    let polynomials = [
        Exponential::Linear,
        Exponential::Quadratic,
        Exponential::Cubic,
    ];
    for inner in rules {
        for outer in rules {
            for exponential in polynomials {
                for scope in [Scope::PerSegment, Scope::Whole] {
                    let method = nested(inner, outer, exponential, scope);
                    for n in [16, 30] {
                        same::<T>(format, &method, &slab, n);
                        same::<T>(format, &method, &Reciprocal, n);
                        same::<T>(format, &method, &ReciprocalSquare, n);
                    }
                }
            }
        }
    }
}

fn same<T: NativeFloat>(format: Ieee, method: &Method, case: &impl Case, n: u64) {
    let ours = radiance(method, case, format, n);
    let theirs = radiance(method, case, Native::<T>::new(), n);
    assert_eq!(
        ours.to_rational(),
        Real::to_rational(&theirs),
        "{method} on {n} segments of {} in {format}",
        case.name()
    );
    assert!(ours.is_finite());
}

#[test]
fn polynomial_methods_equal_native_ones_bit_for_bit() {
    equals_native::<f32>(named("ieee:24,-126,127"));
    equals_native::<f64>(Ieee::BINARY64);
    equals_native::<f16>(Ieee::BINARY16);
    equals_native::<bf16>(Ieee::BFLOAT16);
}

fn named(name: &str) -> Ieee {
    match name.parse().unwrap() {
        FormatName::Ieee(format) => format,
        other => panic!("{other} is not emulated"),
    }
}

/// The trapezoid rule under the trapezoid rule, written down once more in binary64 with every result
/// rounded on its bits: binary64's sine and exponential decide no case of 11 bits wrongly here.
fn replayed(n: u32, round: impl Fn(f64) -> f64) -> f64 {
    let step = round(1.0 / f64::from(n));
    let medium = |i: u32| {
        let s = round(f64::from(i) / f64::from(n));
        let square = round(s * s);
        let (sin, cos) = (round(square.sin()), round(square.cos()));
        (sin, round(cos * s))
    };
    let (mut depth, mut sum) = (0.0, 0.0);
    let mut front = medium(0).1;
    for i in 0..=n {
        let (emission, extinction) = medium(i);
        if i > 0 {
            let mean = round(round(front * 0.5) + round(extinction * 0.5));
            depth = round(depth + round(mean * step));
        }
        let weight = if i == 0 || i == n { 0.5 } else { 1.0 };
        let transmittance = round(f64::exp(-depth));
        let source = round(emission * extinction);
        sum = round(sum + round(round(source * transmittance) * weight));
        front = extinction;
    }
    round(sum * step)
}

#[test]
fn the_sine_squared_case_equals_a_replay_in_small_formats() {
    for name in ["tf32", "fp8-e5m2"] {
        let format = named(name);
        let round = |x| rounded(x, format.bits(), format.emin(), format.emax());
        for n in [4, 16, 64] {
            let ours = radiance(
                &trapezoids(Exponential::Exact),
                &SineSquared,
                format,
                n.into(),
            );
            let replayed = replayed(n, round);
            assert!(replayed > 0.0);
            assert_eq!(ours, number(format, replayed), "{name}, n = {n}");
        }
    }
}

/// Against the same method in 200 bits. With the error u = 2⁻²⁴ of every operation, the depth, a sum of n
/// terms below 1/2, is wrong by at most (n + 4)·u/2, and so is the transmittance; the source by 8 u; their
/// sum of n positive terms by n·u more: (3n/2 + 16) u of the radiance in all.
#[test]
fn binary32_emulated_is_near_the_method_itself() {
    let n = 16;
    let method = trapezoids(Exponential::Exact);
    let ours = radiance(&method, &SineSquared, Ieee::BINARY32, n);
    let exact = radiance(&method, &SineSquared, Mpfr { bits: 200 }, n);
    let exact = exact.to_rational().unwrap();
    let error = (ours.to_rational().unwrap() - &exact).abs();
    let bound = exact * Rational::from((3 * n / 2 + 16, 1_u64 << 24));
    assert!(error <= bound, "{} > {}", error.to_f64(), bound.to_f64());
}

/// Errors in quanta q = 2⁻¹⁵, each operation's at most q/2. Nodes i/16 and squares i²/256 are exact. C and
/// cos: 1/2; τ: 1; mean τ: 2; of a segment's depth, with the exact step 1/16: 5/8; depth: 16·5/8 = 10; T:
/// 10.5; C·τ, with C < 0.85 and τ < 0.7: 1.7; C·τ·T, with C·τ < 0.6: 8.5; weighted: 9; their sum: 17·9 = 153;
/// times the step: 153/16 + 1/2 < 11.
#[test]
fn fixed_point_is_within_eleven_quanta_of_the_method_itself() {
    let method = trapezoids(Exponential::Exact);
    let ours = radiance(&method, &SineSquared, Fixed::new(16, 15).unwrap(), 16);
    let exact = radiance(&method, &SineSquared, Mpfr { bits: 200 }, 16);
    assert!(ours.is_finite());
    let error = (ours.to_rational().unwrap() - exact.to_rational().unwrap()).abs();
    assert!(error <= Rational::from((11, 1 << 15)), "{}", error.to_f64());
    // Nor is it right by being empty: I(1) = 2 − (sin 1 + 2) e^(−sin 1/2) ≈ 0.1343.
    assert!(ours.to_rational().unwrap() > Rational::from((1, 8)));
}

/// Formats of as many bits differ in range: one does not get the other's constants.
#[test]
fn constants_are_kept_by_format() {
    let sum: Expr = "x + 100000".parse().unwrap();
    let program = KeptProgram::new(Program::new(&[sum], &["x"]).unwrap());
    for _ in 0..2 {
        for (format, finite) in [(Ieee::BINARY16, false), (Ieee::TF32, true)] {
            let sum = program.at(&format.int(1)).swap_remove(0);
            assert_eq!(sum, format.int(100_000) + &format.int(1));
            assert_eq!(sum.is_finite(), finite, "{format}");
        }
        for integer in [8, 16] {
            let format = Fixed::new(integer, 15).unwrap();
            assert_eq!(program.at(&format.int(1)), [format.int(100_001)]);
        }
    }
}
