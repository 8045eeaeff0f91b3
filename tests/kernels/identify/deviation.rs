//! What a rule deviates in: each faulty part once, by its name, and nothing else.

use rug::Rational;
use volver::identify::rule::{
    At, Blocks, Channels, Curve, Depth, Effect, End, Extra, LastStep, Law, Output, Place, Power,
    Range, Rule, Scale, Scheme, Seam, Segment, Sequence, Shape, Stop, StopBy, Wall, Weight, Which,
    Whole,
};
use volver::identify::{Bracket, Parameter, deviations, differences, right_of};

fn sampled(place: Place, law: Law) -> Rule {
    Rule {
        scheme: Scheme::Sample { place, law },
        ..Rule::default()
    }
}

fn law(law: Law) -> Rule {
    sampled(Place::Front, law)
}

fn range(range: Range) -> Rule {
    law(Law {
        range,
        ..Law::default()
    })
}

fn sequence(sequence: Sequence) -> Rule {
    Rule {
        sequence,
        ..Rule::default()
    }
}

/// Rules with one fault each, under the name of that.
#[allow(clippy::too_many_lines)] // A list.
fn faulty() -> Vec<(&'static str, Rule)> {
    let plain = Sequence::default;
    let output = |output| Rule {
        output,
        ..Rule::default()
    };
    let stop = Stop {
        by: StopBy::Transmittance,
        under: 0.0039,
        before: false,
        cut: false,
        renormalised: false,
    };
    vec![
        (
            "opacity-law",
            law(Law {
                shape: Shape::Linear,
                ..Law::default()
            }),
        ),
        (
            "scale",
            law(Law {
                scale: Scale(1.001),
                ..Law::default()
            }),
        ),
        (
            "eps",
            law(Law {
                eps: 1e-10,
                ..Law::default()
            }),
        ),
        (
            "cover",
            law(Law {
                cover: Scale(0.5),
                ..Law::default()
            }),
        ),
        (
            "depth-factor",
            law(Law {
                depth: Depth {
                    factor: 0.01,
                    ..Depth::default()
                },
                ..Law::default()
            }),
        ),
        (
            "depth-powers",
            law(Law {
                depth: Depth {
                    length: Power::ZERO,
                    ..Depth::default()
                },
                ..Law::default()
            }),
        ),
        (
            "weight",
            law(Law {
                weight: Weight::Depth {
                    depth: Depth::default(),
                    passes: Power::ZERO,
                },
                ..Law::default()
            }),
        ),
        (
            "skip",
            range(Range {
                skip: Some(1e-3),
                ..Range::default()
            }),
        ),
        (
            "opacity-clamp",
            range(Range {
                opacity_max: Some(0.99),
                ..Range::default()
            }),
        ),
        (
            "depth-clamp",
            range(Range {
                depth_max: Some(2.0),
                ..Range::default()
            }),
        ),
        (
            "opacity-quantum",
            range(Range {
                quantum: Some(1.0 / 255.0),
                ..Range::default()
            }),
        ),
        (
            "first-sample",
            sequence(Sequence {
                first: End::Missing,
                ..plain()
            }),
        ),
        (
            "last-sample",
            sequence(Sequence {
                last: End::Twice,
                ..plain()
            }),
        ),
        (
            "extra-sample",
            sequence(Sequence {
                extra: Some(Extra::Step),
                ..plain()
            }),
        ),
        (
            "swapped-ends",
            sequence(Sequence {
                swapped: true,
                ..plain()
            }),
        ),
        (
            "late-transmittance",
            sequence(Sequence {
                late: true,
                ..plain()
            }),
        ),
        (
            "unrolled",
            sequence(Sequence {
                unrolled: 8,
                ..plain()
            }),
        ),
        (
            "seam",
            sequence(Sequence {
                seam: Some(Seam {
                    blocks: Blocks::Segments(16),
                    at: At::Last,
                    effect: Effect::Missing,
                    of: Which::Whole,
                    fewest: 1,
                }),
                ..plain()
            }),
        ),
        (
            "most-samples",
            sequence(Sequence {
                most: Some(256),
                ..plain()
            }),
        ),
        (
            "last-step",
            sequence(Sequence {
                last_step: LastStep::Dropped,
                ..plain()
            }),
        ),
        (
            "early-end",
            Rule {
                stop: Some(stop),
                ..Rule::default()
            },
        ),
        (
            "wall",
            Rule {
                wall: Some(Wall::Opaque),
                ..Rule::default()
            },
        ),
        (
            "whole-factor",
            Rule {
                whole: Whole::ByOpacity,
                ..Rule::default()
            },
        ),
        (
            "emission-high",
            Rule {
                emission_max: Some(5.0),
                ..Rule::default()
            },
        ),
        (
            "background",
            Rule {
                background: 0.25,
                ..Rule::default()
            },
        ),
        (
            "offset",
            Rule {
                offset: 1e-5,
                ..Rule::default()
            },
        ),
        (
            "output-curve",
            output(Output {
                curve: Curve::Gamma(2.2),
                ..Output::default()
            }),
        ),
        (
            "clip-high",
            output(Output {
                high: Some(1.0),
                ..Output::default()
            }),
        ),
        (
            "quantum",
            output(Output {
                quantum: Some(1.0 / 255.0),
                ..Output::default()
            }),
        ),
        (
            "channels",
            Rule {
                channels: Channels::Reversed,
                ..Rule::default()
            },
        ),
    ]
}

#[test]
fn each_faulty_part_is_named_once_and_nothing_else() {
    for (name, rule) in faulty() {
        let found = deviations(&rule, &right_of(&rule), &[]);
        let names: Vec<&str> = found.iter().map(|deviation| deviation.name).collect();
        assert_eq!(names, [name]);
        assert!(!found[0].does.is_empty());
        // The right rule of the right rule is itself.
        let right = right_of(&rule);
        assert_eq!(right_of(&right), right, "{name}");
        assert!(deviations(&right, &right, &[]).is_empty(), "{name}");
    }
}

#[test]
fn right_rules_keep_their_places_and_deviate_in_nothing() {
    for place in [Place::Front, Place::Middle, Place::Back] {
        let rule = sampled(place, Law::default());
        assert_eq!(right_of(&rule), rule);
    }
    let half = || Rational::from((1, 2));
    let rules = [
        Segment::Quadrature {
            parts: [half(), 0.into(), half()],
            half: [0.into(), 0.into(), 0.into()],
        },
        Segment::Opacity {
            parts: [half(), 0.into(), half()],
        },
        Segment::LinearInDepth { swapped: false },
        Segment::Linear,
        Segment::Halves,
    ];
    for weights in rules {
        let rule = Rule {
            scheme: Scheme::Segments {
                depth: [half(), 0.into(), half()],
                weights,
                scale: Scale(1.0),
            },
            ..Rule::default()
        };
        assert!(
            deviations(&rule, &right_of(&rule), &[]).is_empty(),
            "{rule:?}"
        );
    }
}

#[test]
fn parts_that_do_not_sum_to_one_are_made_consistent() {
    let parts = |a: i32, b: i32, c: i32, over: i32| [a, b, c].map(|x| Rational::from((x, over)));
    let rule = Rule {
        scheme: Scheme::Segments {
            depth: parts(1, 0, 1, 1),
            weights: Segment::Opacity {
                parts: parts(1, 0, 2, 2),
            },
            scale: Scale(1.0),
        },
        ..Rule::default()
    };
    let Scheme::Segments { depth, weights, .. } = right_of(&rule).scheme else {
        panic!("another scheme");
    };
    assert_eq!(depth, parts(1, 0, 1, 2));
    assert_eq!(
        weights,
        Segment::Opacity {
            parts: parts(1, 0, 2, 3)
        }
    );
    let names: Vec<&str> = deviations(&rule, &right_of(&rule), &[])
        .iter()
        .map(|d| d.name)
        .collect();
    assert_eq!(names, ["segment-depth", "segment-weights"]);
}

#[test]
fn what_is_cut_below_nothing_is_no_deviation() {
    let rule = Rule {
        emission_min: Some(0.0),
        output: Output {
            low: Some(0.0),
            ..Output::default()
        },
        ..Rule::default()
    };
    assert!(deviations(&rule, &right_of(&rule), &[]).is_empty());
    let rule = Rule {
        emission_min: Some(0.1),
        ..Rule::default()
    };
    assert_eq!(
        deviations(&rule, &right_of(&rule), &[])[0].name,
        "emission-low"
    );
}

#[test]
fn a_bracket_stands_with_its_parameter() {
    let rule = Rule {
        background: 0.25,
        offset: 1e-5,
        ..Rule::default()
    };
    let bracket = Bracket {
        parameter: Parameter::Offset,
        low: 0.9e-5,
        high: 1.1e-5,
    };
    let found = deviations(&rule, &right_of(&rule), &[bracket]);
    let of = |name| found.iter().find(|d| d.name == name).unwrap();
    assert_eq!(of("offset").bracket, Some((0.9e-5, 1.1e-5)));
    assert_eq!(
        (of("background").value, of("background").bracket),
        (Some(0.25), None)
    );
}

#[test]
fn two_rules_differ_in_exactly_the_parts_that_were_changed() {
    let all = faulty();
    for (name, rule) in &all {
        assert!(differences(rule, rule).is_empty());
        let found = differences(rule, &right_of(rule));
        assert_eq!(found.len(), 1, "{name}");
        assert_eq!(
            (found[0].part, found[0].one.is_some(), &found[0].other),
            (*name, true, &None)
        );
        let back = differences(&right_of(rule), rule);
        assert_eq!(
            (&back[0].one, &back[0].other),
            (&found[0].other, &found[0].one)
        );
    }
}

#[test]
fn curves_are_those_of_the_formulas() {
    let plain = sampled(Place::Middle, Law::default());
    // In the middle of the k-th segment of depth ¼ the light in front has passed k of them.
    for (k, (at, through)) in plain.transmittances_along(3.0).into_iter().enumerate() {
        assert!((at - (k as f64 + 0.5) / 4.0).abs() < 1e-12);
        assert!((through - (-(k as f64) / 4.0).exp()).abs() < 1e-12);
    }
    let weights = plain.weights_along(3.0);
    let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
    assert!((sum - (1.0 - (-3.0_f64).exp())).abs() < 1e-12);
    assert_eq!(plain.ends_at(3.0), None);
    let ends = Rule {
        stop: Some(Stop {
            by: StopBy::Transmittance,
            under: 0.3,
            before: false,
            cut: false,
            renormalised: false,
        }),
        ..plain.clone()
    };
    // e^(−5/4) < 0.3 < e^(−1): the fifth sample is the last one.
    assert_eq!(ends.ends_at(3.0), Some(4.5 / 4.0));
    let weights = ends.weights_along(3.0);
    assert_eq!(weights.len(), 12);
    assert!(weights[5..].iter().all(|(_, weight)| *weight == 0.0));
    for [x, opacity, right] in plain.opacities() {
        assert_eq!(opacity.to_bits(), right.to_bits(), "{x}");
    }
}
