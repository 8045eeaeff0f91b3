//! The catalogue's closed forms against quadrature by another program, and methods that converge to them.

use rug::{Float, Rational};
use std::collections::HashMap;
use volver::case::manufacture::{Manufactured, manufacture};
use volver::case::{Case, Fresh, catalogue};
use volver::method::{Exponential, Inner, Method, Nested, Outer, Scope};
use volver::quadrature::Rule;
use volver::real::{Format, Mpfr, Native};

fn all() -> Vec<Manufactured> {
    catalogue::names()
        .flat_map(|name| manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap())
        .collect()
}

/// name → depth and radiance at D, 40 digits, from nested quadrature (mpmath; see the file's head).
fn fixture() -> HashMap<String, (Float, Float)> {
    let number = |text: &str| Float::with_val(400, Float::parse(text).unwrap());
    include_str!("catalogue_values.txt")
        .lines()
        .filter(|line| !line.starts_with('#'))
        .map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            let [name, depth, radiance] = words[..] else {
                panic!("{line}")
            };
            (name.to_string(), (number(depth), number(radiance)))
        })
        .collect()
}

fn at_far_end(case: &Manufactured, bits: u32) -> (Float, Float) {
    let format = Mpfr { bits };
    let length = format.ratio(&case.case.length());
    let depth = case.case.optical_depth(&length).unwrap().into();
    (depth, case.case.radiance(&length).unwrap().into())
}

#[test]
fn closed_forms_equal_quadrature() {
    let fixture = fixture();
    let cases = all();
    assert_eq!(cases.len(), fixture.len());
    for case in &cases {
        let (depth, radiance) = at_far_end(case, 400);
        let (expected_depth, expected_radiance) = &fixture[case.case.name()];
        for (value, expected) in [(depth, expected_depth), (radiance, expected_radiance)] {
            let scale = Float::with_val(400, expected.abs_ref());
            let error = Float::with_val(400, &value - expected).abs();
            // 40 digits, the last one rounded.
            assert!(
                error <= scale * Float::with_val(400, Float::parse("1e-39").unwrap()),
                "{}: {value} against {expected}",
                case.case.name()
            );
        }
    }
}

#[test]
fn precision_is_the_format_s_own() {
    // With a constant of 53 bits anywhere on the way, 400 bits would be no better than 53.
    for case in &all() {
        let (_, exact) = at_far_end(case, 1000);
        for bits in [53, 400] {
            let (_, radiance) = at_far_end(case, bits);
            let error = Float::with_val(1000, &radiance - &exact).abs();
            // Terms of the closed forms are up to some hundreds in size, and are evaluated in a few steps.
            let scale = Float::with_val(1000, 1) >> (bits - 14);
            assert!(
                error <= scale,
                "{}: {error} at {bits} bits",
                case.case.name()
            );
        }
    }
}

/// The catalogue is not to be learnt by heart with lengths of 1 and moderate depths.
#[test]
fn half_of_the_channels_have_another_length_than_1() {
    let cases = all();
    let others = cases.iter().filter(|case| case.case.length() != 1).count();
    assert!(2 * others >= cases.len(), "{others} of {}", cases.len());
}

/// Figures are compared on it over time: it is never another one.
#[test]
fn the_first_58_channels_keep_their_tag() {
    let tagged = catalogue::names().filter(|name| has_tag(name, "first"));
    let names: Vec<&str> = tagged.collect();
    assert_eq!(names.len(), 50);
    let channels: usize = names.iter().map(|name| made(name).len()).sum();
    assert_eq!(channels, 58);
}

#[test]
fn tags_on_depth_and_emission_are_true_both_ways() {
    let (mut deep, mut even) = (0, 0);
    for name in catalogue::names() {
        let cases = made(name);
        let is_deep = cases.iter().all(|case| at_far_end(case, 64).0 >= 100);
        assert_eq!(is_deep, has_tag(name, "deep"), "{name}");
        deep += usize::from(is_deep);
        let is_even = has_tag(name, "constant-emission");
        for case in cases.iter().filter(|_| is_even) {
            // I = C (1 − e^(−t)): what a projector is given.
            let (depth, radiance) = at_far_end(case, 400);
            let emission = Float::from(case.case.transfer(&Mpfr { bits: 400 }.int(0)).emission);
            let off = radiance + (emission * Float::exp_m1(-depth));
            assert!(off.abs() < 1e-100, "{name}");
            even += 1;
        }
    }
    assert!(deep >= 4 && even >= 3, "{deep} deep, {even} even");
}

fn made(name: &str) -> Vec<Manufactured> {
    manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap()
}

fn has_tag(name: &str, tag: &str) -> bool {
    let description = catalogue::find(name).unwrap().unwrap();
    description.tags.iter().any(|own| own == tag)
}

/// Gauss–Legendre inside and outside converges exponentially on what is analytic.
#[test]
fn errors_fall_below_1e_60_on_smooth_cases() {
    let method = Method::Nested(Nested {
        inner: Inner::PerSegment(Rule::GaussLegendre(24)),
        outer: Outer(Rule::GaussLegendre(24)),
        exponential: Exponential::Exact,
        scope: Scope::Whole,
    });
    for name in [
        "sine-squared",
        "atmosphere",
        "rgb-transfer",
        "decaying-field",
    ] {
        for case in manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap() {
            let error = |bits: u32, n: u64| -> Float {
                let format = Mpfr { bits };
                let radiance: Float = method
                    .radiance(&Fresh::new(&case.case, format), n)
                    .unwrap()
                    .into();
                let (_, exact) = at_far_end(&case, 500);
                Float::with_val(500, radiance - exact).abs()
            };
            let bound = Float::with_val(64, Float::parse("1e-60").unwrap());
            assert!(
                error(400, 64) < bound,
                "{}: {}",
                case.case.name(),
                error(400, 64)
            );
            assert!(error(53, 64) > bound, "{}", case.case.name());
        }
    }
}

#[test]
fn the_same_medium_by_formula_and_by_hand() {
    let text = catalogue::find("sine-squared").unwrap().unwrap();
    let formula = &manufacture(&text).unwrap()[0].case;
    let format = Native::<f64>::new();
    for i in 0..=100 {
        let lambda = format.fraction(i, 100);
        let (ours, theirs) = (
            formula.transfer(&lambda),
            volver::case::SineSquared.transfer(&lambda),
        );
        assert_eq!(ours.emission.to_bits(), theirs.emission.to_bits());
        assert_eq!(ours.extinction.to_bits(), theirs.extinction.to_bits());
    }
    assert_eq!(formula.length(), Rational::from(1));
}
