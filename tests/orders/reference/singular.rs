//! Kinks and roots anywhere: what is found and substituted, against closed forms, another library, and the same medium
//! as code, of which nobody knows where its roots are.

use super::{bits, distance};
use quickcheck::{Arbitrary, Gen, QuickCheck};
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use rug::ops::Pow;
use rug::{Float, Rational};
use volver::case::{Case, Formulas, Structure, SymbolicCase, Transfer};
use volver::inside::reference::{Rectangle, range, substituted};
use volver::real::Real;
use volver::reference::{
    NotEnclosed, ReferenceError, enclosed_radiance, estimated_radiance, optical_depth, radiance,
};
use volver::symbolic::{Interval, Program};

/// A medium on [0, D] of whose structure nothing is told.
fn plain(length: &Rational, extinction: &str, emission: &str) -> SymbolicCase {
    let text = |formula: &str| formula.parse().unwrap();
    let formulas = Formulas {
        field: text("lambda"),
        extinction: text(extinction),
        emission: text(emission),
        optical_depth: None,
        radiance: None,
    };
    SymbolicCase::new("a", length.clone(), formulas, Structure::default()).unwrap()
}

/// A medium as code: the reference has its values at points and nothing else.
#[derive(Debug)]
struct Code(SymbolicCase);

impl Case for Code {
    fn name(&self) -> &'static str {
        "code"
    }
    fn length(&self) -> Rational {
        self.0.length()
    }
    fn field<R: Real>(&self, lambda: &R) -> R {
        lambda.clone()
    }
    fn transfer<R: Real>(&self, s: &R) -> Transfer<R> {
        self.0.transfer(s)
    }
    fn optical_depth<R: Real>(&self, _: &R) -> Option<R> {
        None
    }
    fn radiance<R: Real>(&self, _: &R) -> Option<R> {
        None
    }
    fn structure(&self) -> Structure {
        Structure::default()
    }
}

/// w |s − a|^(k/q).
#[derive(Clone, Debug)]
struct Term {
    weight: u32,
    place: Rational,
    power: Rational,
}

/// τ = ½ + Σ w |s − a|^(k/q) on [0, D], C = 1.
#[derive(Clone, Debug)]
struct Kinked {
    length: Rational,
    terms: Vec<Term>,
}

impl Arbitrary for Kinked {
    fn arbitrary(g: &mut Gen) -> Kinked {
        let mut below = |n: u32| u32::arbitrary(g) % n;
        // Binary64 has neither D nor most of the places.
        let length = Rational::from((1 + below(12), 1 + below(7)));
        let count = 1 + below(3);
        let terms = (0..count).map(|_| {
            let part = match below(4) {
                0 => Rational::new(),
                1 => Rational::from(1),
                _ => Rational::from((1 + below(96), 97)),
            };
            let roots = [1, 2, 2, 3, 4];
            let root = roots[below(5) as usize];
            Term {
                weight: 1 + below(3),
                place: part * &length,
                power: Rational::from((1 + below(2 * root), root)),
            }
        });
        Kinked {
            terms: terms.collect(),
            length,
        }
    }

    fn shrink(&self) -> Box<dyn Iterator<Item = Kinked>> {
        let whole = self.clone();
        let fewer = (0..self.terms.len()).map(move |i| {
            let mut less = whole.clone();
            less.terms.remove(i);
            less
        });
        Box::new(fewer)
    }
}

impl Kinked {
    fn case(&self) -> SymbolicCase {
        let terms = self.terms.iter().map(|term| {
            let Term {
                weight,
                place,
                power,
            } = term;
            format!(" + {weight}*abs(s - ({place}))^({power})")
        });
        let extinction: String = std::iter::once("1/2".to_owned()).chain(terms).collect();
        plain(&self.length, &extinction, "1")
    }

    /// 1 − e^(−t), t = D/2 + Σ w (a^(p + 1) + (D − a)^(p + 1))/(p + 1).
    fn radiance(&self) -> Float {
        let number = |q: &Rational| Float::with_val(600, q);
        let mut depth = number(&self.length) / 2_u32;
        for term in &self.terms {
            let power = number(&term.power) + 1_u32;
            let behind = Rational::from(&self.length - &term.place);
            for part in [&term.place, &behind] {
                depth += number(part).pow(&power) / &power * term.weight;
            }
        }
        -(-depth).exp_m1()
    }
}

#[test]
fn placed_kinks_and_roots_are_found_and_cost_a_panel_or_three() {
    #[allow(clippy::needless_pass_by_value)] // As quickcheck has it.
    fn holds(kinked: Kinked) -> bool {
        let (case, exact) = (kinked.case(), kinked.radiance());
        let found = enclosed_radiance(&case, bits(40)).unwrap();
        let estimate = estimated_radiance(&case, bits(40)).unwrap();
        let most = 6 * (kinked.terms.len() as u64 + 1);
        [found, estimate].iter().all(|found| {
            distance(&found.value, &exact) <= found.error
                && found.digits().unwrap() >= 40
                && found.work.panels <= most
        })
    }
    QuickCheck::new()
        .tests(60)
        .rng(Gen::from_size_and_seed(20, 21))
        .quickcheck(holds as fn(_) -> _);
}

#[test]
fn few_bits_of_roots_are_as_certain_as_many() {
    // What series leave out is all of the error here, and none of it is rounding.
    #[allow(clippy::needless_pass_by_value)] // As quickcheck has it.
    fn holds(kinked: Kinked) -> bool {
        let (case, exact) = (kinked.case(), kinked.radiance());
        [12, 20, 31, 48].into_iter().all(|bits| {
            let found = enclosed_radiance(&case, bits).unwrap();
            distance(&found.value, &exact) <= found.error
        })
    }
    QuickCheck::new()
        .tests(40)
        .rng(Gen::from_size_and_seed(20, 22))
        .quickcheck(holds as fn(_) -> _);
}

#[test]
fn roots_and_kinks_are_where_another_library_has_them() {
    let text = include_str!("../../data/roots_and_kinks.tsv");
    let mut rows = 0;
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let fields: Vec<&str> = line.split('\t').collect();
        let [extinction, emission, light, depth] = &fields[..] else {
            panic!("{line}")
        };
        let case = plain(&Rational::from(1), extinction, emission);
        let number = |text: &str| Float::with_val(140, Float::parse(text).unwrap());
        let written = Float::with_val(64, Float::parse("1e-35").unwrap());
        let light = number(light);
        let found = [
            enclosed_radiance(&case, bits(45)).unwrap(),
            estimated_radiance(&case, bits(45)).unwrap(),
        ];
        for found in found {
            let error = distance(&found.value, &light);
            let allowed = Float::with_val(64, &found.error + &written);
            assert!(error <= allowed, "{line}: {error}");
            assert!(found.digits().unwrap() >= 45, "{line}");
            assert!(found.work.panels <= 16, "{line}: {:?}", found.work);
        }
        let found = optical_depth(&case, bits(45)).unwrap();
        let error = distance(&found.value, &number(depth));
        assert!(
            found.is_enclosed() && error <= found.error + &written,
            "{line}"
        );
        rows += 1;
    }
    assert!(rows >= 6, "{rows}");
}

#[test]
fn the_same_medium_as_code_has_the_same_radiance() {
    // Panels that close in on what nobody told of, and no substitution.
    for (extinction, emission) in [
        ("sqrt(1 - s)", "exp(-s)"),
        ("1 + abs(sin(4*s) - 1/3)", "1 + s"),
        ("sqrt(abs(cos(2*s)))", "1"),
        ("s^(2/3)*(1 - s)^(1/4)", "2 - s"),
        ("piecewise(s < 1/3, 1, 3)", "1"),
    ] {
        let case = plain(&Rational::from(1), extinction, emission);
        let found = enclosed_radiance(&case, bits(25)).unwrap();
        let code = estimated_radiance(&Code(case.clone()), bits(25)).unwrap();
        assert!(code.work.panels > 20, "{extinction}: {:?}", code.work);
        let error = distance(&found.value, &code.value);
        assert!(
            error <= Float::with_val(64, &found.error + &code.error),
            "{extinction}: {error}"
        );
        let known = estimated_radiance(&case, bits(25)).unwrap();
        assert!(known.work.panels <= 4, "{extinction}: {:?}", known.work);
    }
}

#[test]
fn ends_without_a_bound_are_enclosed_where_a_root_tells_how_they_rise() {
    // 1 − e^(−t), t = 2√D.
    let length = Rational::from((1, 3));
    let case = plain(&length, "1/sqrt(s)", "1");
    let found = enclosed_radiance(&case, bits(40)).unwrap();
    let depth = Float::with_val(300, &length).sqrt() * 2_u32;
    let error = distance(&found.value, &-(-depth).exp_m1());
    assert!(error <= found.error && found.digits().unwrap() >= 40);
    // The far end, and √π erf 1 = ∫ e^(−s)/√s as it is with C as the one that rises.
    let case = plain(&Rational::from(1), "1/sqrt(1 - s)", "1");
    let found = enclosed_radiance(&case, bits(40)).unwrap();
    let error = distance(&found.value, &-Float::with_val(300, -2).exp_m1());
    assert!(error <= found.error && found.digits().unwrap() >= 40);
    let case = plain(&Rational::from(1), "1", "1/sqrt(s)");
    let found = enclosed_radiance(&case, bits(40)).unwrap();
    let pi = Float::with_val(300, rug::float::Constant::Pi);
    let exact = pi.sqrt() * Float::with_val(300, 1).erf();
    let error = distance(&found.value, &exact);
    assert!(error <= found.error && found.digits().unwrap() >= 40);
    // What is not integrable has no value at all.
    let case = plain(&Rational::from(1), "1/s", "1");
    assert!(enclosed_radiance(&case, 64).is_err());
}

#[test]
fn a_hundred_kinks_are_found_and_a_million_are_refused() {
    // ∫ |sin ω| is 2 a half period; 314 = 99 π + r.
    let case = plain(&Rational::from(1), "abs(sin(314*s))", "1");
    let pi = Float::with_val(300, rug::float::Constant::Pi);
    let rest = Float::with_val(300, 314 - Float::with_val(300, &pi * 99_u32));
    let depth: Float = (199 - rest.cos()) / 314_u32;
    let exact = -(-depth).exp_m1();
    let found = radiance(&case, bits(50)).unwrap();
    assert!(
        found.is_enclosed() && found.work.panels <= 300,
        "{:?}",
        found.work
    );
    assert!(distance(&found.value, &exact) <= found.error);
    let found = estimated_radiance(&case, bits(50)).unwrap();
    assert_eq!(found.work.panels, 100);
    assert!(distance(&found.value, &exact) <= found.error);

    let case = plain(&Rational::from(1), "abs(sin(1000000*s))", "1");
    let error = enclosed_radiance(&case, bits(20)).unwrap_err();
    assert_eq!(
        error,
        ReferenceError::NotEnclosed {
            reason: NotEnclosed::TooManyBranches
        }
    );
}

/// C and τ of λ, the end, the width, the power, whether the end is the far one, and both integrands as formulas of u.
type Row = ([&'static str; 2], u32, u32, u32, bool, [&'static str; 2]);

const SUBSTITUTED: [Row; 8] = [
    (
        ["exp(-s)", "sqrt(s)"],
        0,
        1,
        2,
        false,
        ["2*u^2", "2*u^2*exp(-u^2)"],
    ),
    (
        ["1 + s", "sqrt(1 - s)"],
        1,
        1,
        2,
        true,
        ["2*u^2", "2*u^2*(2 - u^2)"],
    ),
    (
        ["cos(s)", "s^(1/3)"],
        0,
        8,
        3,
        false,
        ["48*u^3", "48*u^3*cos(8*u^3)"],
    ),
    (
        ["1/(1 + s)", "sqrt(s + s^2)"],
        0,
        1,
        2,
        false,
        ["2*u^2*sqrt(1 + u^2)", "2*u^2/sqrt(1 + u^2)"],
    ),
    (["sqrt(s)", "1/sqrt(s)"], 0, 1, 2, false, ["2", "2*u"]),
    (
        ["sqrt(1 + sqrt(s))", "ln(1 + sqrt(s))"],
        0,
        1,
        2,
        false,
        ["2*u*ln(1 + u)", "2*u*ln(1 + u)*sqrt(1 + u)"],
    ),
    (
        ["sinh(s)", "sin(3 - s)^2*sqrt(3 - s)"],
        3,
        1,
        2,
        true,
        ["2*u^2*sin(u^2)^2", "2*u^2*sin(u^2)^2*sinh(3 - u^2)"],
    ),
    (
        ["tanh(s - 1)", "(2 - s)^(1/4)"],
        2,
        1,
        4,
        true,
        ["4*u^4", "4*u^4*tanh(1 - u^4)"],
    ),
];

#[test]
fn rectangles_around_a_root_have_what_a_formula_without_it_has_there() {
    let mut random = Pcg64::seed_from_u64(7);
    let mut between = |low: f64, high: f64| {
        let part = (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        Float::with_val(64, low + part * (high - low))
    };
    let hull = |a: &Float, b: &Float| Interval::exactly(a).union(&Interval::exactly(b));
    let program = |formulas: [&str; 2], input: &str| {
        let formulas = formulas.map(|formula| formula.parse().unwrap());
        Program::new(&formulas, &[input]).unwrap()
    };
    for (medium, end, width, power, is_far, integrands) in SUBSTITUTED {
        let substitute = program(medium, "s");
        let without = program(integrands, "u");
        let (end, width) = (Rational::from(end), Rational::from(width));
        let (mut known, mut left) = (0, 0);
        for _ in 0..200 {
            let (x, y) = (between(-0.3, 0.9), between(0.0, 0.3));
            let wide = Float::with_val(64, &x + between(0.0, 0.4));
            let [from, to] = if is_far {
                [Float::with_val(64, -&wide), Float::with_val(64, -&x)]
            } else {
                [x, wide]
            };
            let zero = Float::new(64);
            let u = Rectangle {
                re: hull(&from, &to),
                im: hull(&zero, &y),
            };
            let Some(found) = substituted(&substitute, [&end, &width], power, is_far, &u) else {
                continue;
            };
            known += 1;
            let is_beyond = if is_far { to > 0 } else { from < 0 };
            left += u32::from(is_beyond);
            for _ in 0..8 {
                let part = |low: &Float, high: &Float, part: &Float| {
                    let way = Float::with_val(64, high - low) * part;
                    Float::with_val(64, low + way)
                };
                let re = part(&from, &to, &between(0.0, 1.0));
                let im = part(&zero, &y, &between(0.0, 1.0));
                let here = Rectangle {
                    re: hull(&re, &re),
                    im: hull(&im, &im),
                };
                for (found, exact) in found.iter().zip(range(&without, &here)) {
                    let exact = exact.unwrap();
                    for (found, exact) in [(&found.re, &exact.re), (&found.im, &exact.im)] {
                        assert!(
                            found.intersection(exact).is_some(),
                            "{medium:?} at {re} + i {im}"
                        );
                    }
                }
            }
        }
        assert!(known > 100 && left > 30, "{medium:?}: {known}, {left}");
    }
}
