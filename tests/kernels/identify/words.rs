//! A rule in words, as LaTeX and as JSON.

use super::random::Random;
use rug::Rational;
use serde_json::json;
use std::fs;
use volver::identify::Rule;
use volver::identify::rule::{
    Curve, Depth, End, Formula, Law, Output, Place, Power, Range, Scale, Scheme, Segment, Sequence,
    Series, Shape, Step, Stop, StopBy, Table, Wall, Weight, Whole,
};

fn sampled(place: Place, law: Law) -> Rule {
    Rule {
        scheme: Scheme::Sample { place, law },
        ..Rule::default()
    }
}

fn simpson() -> Rule {
    let three = |parts: [(i32, i32); 3]| parts.map(Rational::from);
    Rule {
        scheme: Scheme::Segments {
            depth: three([(1, 6), (2, 3), (1, 6)]),
            weights: Segment::Quadrature {
                parts: three([(1, 6), (2, 3), (1, 6)]),
                half: three([(5, 24), (1, 3), (-1, 24)]),
            },
            scale: Scale(0.5),
        },
        ..Rule::default()
    }
}

fn stopped() -> Rule {
    let stop = Stop {
        by: StopBy::Transmittance,
        under: 0.01,
        before: false,
        cut: false,
        renormalised: true,
    };
    Rule {
        stop: Some(stop),
        wall: Some(Wall::Opaque),
        background: 0.2,
        output: Output {
            curve: Curve::Gamma(1.0 / 2.2),
            high: Some(1.0),
            quantum: Some(1.0 / 255.0),
            ..Output::default()
        },
        ..sampled(Place::Front, Law::default())
    }
}

fn faulty() -> Rule {
    let law = Law {
        depth: Depth {
            factor: 2.0,
            ray: Power { halves: -2 },
            ..Depth::default()
        },
        shape: Shape::Quadratic,
        weight: Weight::Opacity {
            opacity: Power { halves: 1 },
            passes: Power { halves: -1 },
        },
        eps: 1e-10,
        range: Range {
            skip: Some(1e-5),
            series: Some(Series {
                below: 0.1,
                terms: 2,
            }),
            table: Some(Table {
                step: 0.125,
                top: Some(8.0),
                between: Step::Linear,
            }),
            ..Range::default()
        },
        ..Law::default()
    };
    Rule {
        sequence: Sequence {
            first: End::Missing,
            late: true,
            most: Some(256),
            ..Sequence::default()
        },
        whole: Whole::ByOpacity,
        offset: -0.25,
        ..sampled(Place::Back, law)
    }
}

fn by_power() -> Rule {
    let law = Law {
        formula: Formula::Power,
        weight: Weight::Own {
            depth: Depth::default(),
            shape: Shape::CrankNicolson,
        },
        ..Law::default()
    };
    sampled(Place::Middle, law)
}

fn some() -> [Rule; 5] {
    [Rule::default(), simpson(), stopped(), faulty(), by_power()]
}

#[test]
fn rules_read_as_formulas() {
    let texts = some().map(|rule| format!("{rule}\n\n{}", rule.latex()));
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path("../../../snapshots");
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!("rules_in_words", texts.join("\n\n---\n\n")));
}

/// The rule with one part of another's.
fn with_part(rule: &Rule, other: &Rule, part: usize) -> Rule {
    let mut mixed = rule.clone();
    match part {
        0 => mixed.sequence = other.sequence,
        1 => mixed.stop = other.stop,
        2 => mixed.wall = other.wall,
        3 => mixed.whole = other.whole,
        4 => mixed.emission = other.emission,
        5 => mixed.emission_max = other.emission_max,
        6 => mixed.emission_min = other.emission_min,
        7 => mixed.background = other.background,
        8 => mixed.offset = other.offset,
        9 => mixed.output = other.output,
        10 => mixed.scheme = other.scheme.clone(),
        _ => {
            if let (Scheme::Sample { law, .. }, Scheme::Sample { law: of, .. }) =
                (&mut mixed.scheme, &other.scheme)
            {
                match part {
                    11 => law.depth = of.depth,
                    12 => law.shape = of.shape,
                    13 => law.weight = of.weight,
                    14 => law.scale = of.scale,
                    15 => law.eps = of.eps,
                    16 => law.cover = of.cover,
                    17 => law.formula = of.formula,
                    18 => law.length_bits = of.length_bits,
                    _ => law.range = of.range,
                }
            }
        }
    }
    mixed
}

/// What no line says would read as another rule.
#[test]
fn what_makes_another_program_makes_another_text() {
    let mut different = 0;
    for seed in 0..400 {
        let mut random = Random::new(seed);
        let (rule, other) = (random.rule(), random.rule());
        for part in 0..20 {
            let mixed = with_part(&rule, &other, part);
            if mixed.python() != rule.python() {
                different += 1;
                assert_ne!(mixed.to_string(), rule.to_string(), "{mixed:?}\n{rule:?}");
            }
        }
    }
    assert!(different > 2000, "{different}");
}

/// A formula that LaTeX can read: braces match, and nothing but ASCII is left.
#[test]
fn latex_is_balanced_ascii() {
    for seed in 0..500 {
        let latex = Random::new(seed).rule().latex();
        assert!(latex.is_ascii(), "{latex}");
        let mut depth = 0;
        for c in latex.chars() {
            depth += i32::from(c == '{') - i32::from(c == '}');
            assert!(depth >= 0, "{latex}");
        }
        assert_eq!(depth, 0, "{latex}");
    }
}

#[test]
fn in_json_rationals_are_text_and_exponents_numbers() {
    let simpson = serde_json::to_value(simpson()).unwrap();
    assert_eq!(
        simpson["scheme"]["segments"],
        json!({
            "depth": ["1/6", "2/3", "1/6"],
            "weights": {
                "quadrature": {
                    "parts": ["1/6", "2/3", "1/6"],
                    "half": ["5/24", "1/3", "-1/24"],
                },
            },
            "scale": 0.5,
        })
    );
    let faulty = serde_json::to_value(faulty()).unwrap();
    let law = &faulty["scheme"]["sample"]["law"];
    assert_eq!(law["depth"]["ray"], json!(-1.0));
    assert_eq!(law["weight"]["opacity"]["passes"], json!(-0.5));
    assert_eq!(law["range"]["table"]["between"], json!("linear"));
    assert_eq!(faulty["sequence"]["first"], json!("missing"));
    assert_eq!(faulty["whole"], json!("by-opacity"));
    let stopped = serde_json::to_value(stopped()).unwrap();
    assert_eq!(stopped["stop"]["by"], json!("transmittance"));
    assert_eq!(stopped["wall"], json!("opaque"));
    assert_eq!(stopped["output"]["curve"], json!({ "gamma": 1.0 / 2.2 }));
}

/// The examples of the documentation are what is printed.
#[test]
fn the_documentation_shows_what_is_printed() {
    let page = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/identify.md");
    let page = fs::read_to_string(page).unwrap();
    let rule = Rule {
        stop: stopped().stop,
        ..Rule::default()
    };
    for printed in [rule.to_string(), rule.python(), rule.c()] {
        assert!(page.contains(printed.trim()), "{printed}");
    }
}
