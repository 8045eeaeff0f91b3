//! What jumps, kinks and square roots of the medium leave of an order.

use super::{LINEAR, MIDDLE, nested, preintegrated, rules, sub_intervals};
use Expected::Order;
use rug::Rational;
use volver::case::manufacture::manufacture;
use volver::case::{Break, Case, Fresh, Structure, SymbolicCase, catalogue};
use volver::method::{
    Expected, Exponential, Filling, Inner, Method, Part, Scope, expected, expected_on,
};
use volver::quadrature::{Rule, Sampling};
use volver::real::{Format, Mpfr, Native, Real};

const EVEN: [u64; 4] = [16, 32, 64, 128];

fn case(name: &str) -> SymbolicCase {
    let description = catalogue::find(name).unwrap().unwrap();
    manufacture(&description).unwrap().remove(0).case
}

fn pairs(filling: Filling, outer: Rule) -> Method {
    let inner = Inner::SimpsonPairs(filling);
    nested(inner, outer, Exponential::Exact, Scope::Whole)
}

/// The order of the largest errors between levels four times apart.
fn measured(method: &Method, case: &SymbolicCase, coarse: &[u64], fine: &[u64]) -> f64 {
    let format = Mpfr { bits: 200 };
    let nodes = Fresh::new(case, format);
    let exact = case.radiance(&format.ratio(&case.length())).unwrap();
    let largest = |levels: &[u64]| {
        let errors = levels.iter().map(|&n| {
            let error = method.radiance(&nodes, n).unwrap() - &exact;
            error.log2_abs()
        });
        errors.fold(f64::NEG_INFINITY, f64::max)
    };
    let ratio = (fine[0] as f64 / coarse[0] as f64).log2();
    (largest(coarse) - largest(fine)) / ratio
}

#[test]
fn a_break_off_the_nodes_leaves_one_more_than_its_power() {
    let gauss = Rule::GaussLegendre(3);
    for (name, order) in [("jump-moving", 1.0), ("kink-moving", 2.0)] {
        let case = case(name);
        for method in [
            rules(gauss, Rule::Boole),
            rules(gauss, gauss),
            pairs(Filling::Parabola, Rule::Simpson),
            nested(
                Inner::BooleFours,
                Rule::Simpson,
                Exponential::Exact,
                Scope::Whole,
            ),
        ] {
            assert_eq!(expected(&method, &case), Order(order), "{method}");
            assert_eq!(expected_on(&method, &case, &EVEN), Order(order));
        }
        // The rule's own order where that is less.
        let left = rules(Rule::RiemannLeft, Rule::RiemannRight);
        assert_eq!(expected(&left, &case), Order(1.0));
    }
}

#[test]
fn a_break_on_a_node_costs_closed_rules_at_a_jump_and_nobody_at_a_kink() {
    let gauss = Rule::GaussLegendre(3);
    let (jump, kink) = (case("jump-on-node"), case("kink-on-node"));
    for (method, at_jump, at_kink) in [
        (rules(gauss, gauss), 6.0, 6.0),
        (rules(gauss, Rule::Boole), 1.0, 6.0),
        (rules(Rule::Simpson, gauss), 1.0, 4.0),
        (rules(Rule::RiemannLeft, gauss), 1.0, 1.0),
        (pairs(Filling::Parabola, Rule::Simpson), 1.0, 4.0),
        (pairs(Filling::Trapezoid, Rule::Simpson), 1.0, 3.0),
    ] {
        assert_eq!(
            expected_on(&method, &jump, &EVEN),
            Order(at_jump),
            "{method}"
        );
        assert_eq!(
            expected_on(&method, &kink, &EVEN),
            Order(at_kink),
            "{method}"
        );
        assert_eq!(expected(&method, &jump), Order(1.0), "{method}");
    }
    // In the middle of a group it is off the nodes, and one such level is enough.
    let boole = rules(gauss, Rule::Boole);
    assert_eq!(expected_on(&boole, &kink, &[16, 32, 68]), Order(2.0));
    assert_eq!(expected_on(&boole, &kink, &[]), Order(2.0));
    let order = measured(&boole, &kink, &[60, 68], &[240 + 4, 240 + 12]);
    assert!((order - 2.0).abs() < 0.3, "{order}");
}

#[test]
fn where_the_leading_error_vanishes_at_every_level_the_next_one_limits() {
    let kink = case("kink-off-node");
    let thirds = [16, 20, 32, 40];
    let simpson = rules(Rule::Simpson, Rule::Simpson);
    assert_eq!(expected(&simpson, &kink), Order(2.0));
    assert_eq!(expected_on(&simpson, &kink, &thirds), Order(3.0));
    let order = measured(&simpson, &kink, &[64, 80], &[256, 320]);
    assert!((order - 3.0).abs() < 0.1, "{order}");
    // Nor does Boole's rule see a corner at a third: 12/90·1/6 + 32/90·5/12 + 7/90·2/3 = 2/9 too.
    let boole = rules(Rule::Simpson, Rule::Boole);
    assert_eq!(expected_on(&boole, &kink, &thirds), Order(3.0));
    let order = measured(&boole, &kink, &[64, 80], &[256, 320]);
    assert!((order - 3.0).abs() < 0.1, "{order}");
    // Not for other rules, other powers, other places.
    let gauss = rules(Rule::GaussLegendre(3), Rule::Boole);
    assert_eq!(expected_on(&gauss, &kink, &thirds), Order(2.0));
    let jump = case("jump-off-node");
    assert_eq!(expected_on(&simpson, &jump, &thirds), Order(1.0));
    let moving = case("kink-moving");
    assert_eq!(expected_on(&simpson, &moving, &thirds), Order(2.0));
    // A jump in the middle of every segment: the midpoint rule takes the right side's value there, but two
    // Gauss nodes lie on either side and see it evenly. Odd n have D/2 there.
    let jump = case("jump-on-node");
    let odd = [33, 65, 129];
    let midpoint = rules(Rule::Midpoint, Rule::Midpoint);
    assert_eq!(expected_on(&midpoint, &jump, &odd), Order(1.0));
    let gauss = rules(Rule::GaussLegendre(2), Rule::GaussLegendre(2));
    assert_eq!(expected_on(&gauss, &jump, &odd), Order(2.0));
    let order = measured(&gauss, &jump, &[65], &[257]);
    assert!((order - 2.0).abs() < 0.1, "{order}");
}

#[test]
fn a_square_root_at_the_near_end_leaves_three_halves() {
    let edge = case("square-root-edge");
    for method in [
        rules(Rule::Trapezoid, Rule::Trapezoid),
        rules(Rule::GaussLegendre(3), Rule::GaussLegendre(3)),
        rules(Rule::GaussLegendre(3), Rule::Boole),
    ] {
        assert_eq!(expected(&method, &edge), Order(1.5), "{method}");
        assert_eq!(expected_on(&method, &edge, &EVEN), Order(1.5));
        let order = measured(&method, &edge, &[256], &[1024]);
        assert!((order - 1.5).abs() < 0.07, "{method}: {order}");
    }
}

#[test]
fn each_rule_has_its_own_limit() {
    // τ is constant: the inner rules see no break of C.
    let emission = case("emission-jump");
    let method = rules(Rule::GaussLegendre(3), Rule::Boole);
    let parts: Vec<_> = method
        .limits(&emission)
        .iter()
        .map(|l| (l.part, l.order))
        .collect();
    assert!(parts.contains(&(Part::SourceBreak, Some(1.0))), "{parts:?}");
    assert!(parts.iter().all(|(part, _)| *part != Part::ExtinctionBreak));
    // C·τ is constant: the outer rule sees the kink of the transmittance.
    let balanced = case("balanced-jump");
    let parts: Vec<_> = method
        .limits(&balanced)
        .iter()
        .map(|l| (l.part, l.order))
        .collect();
    assert!(parts.contains(&(Part::SourceBreak, Some(2.0))), "{parts:?}");
    assert!(
        parts.contains(&(Part::ExtinctionBreak, Some(1.0))),
        "{parts:?}"
    );
}

#[test]
fn pre_integration_is_a_rule_where_its_field_is_exact_and_unknown_elsewhere() {
    let gauss = sub_intervals(4, Rule::GaussLegendre(2));
    let trapezoid = sub_intervals(4, Rule::Trapezoid);
    let (jump, kink) = (case("jump-on-node"), case("kink-on-node"));
    let by = |integration| preintegrated(LINEAR, MIDDLE, integration);
    assert_eq!(expected_on(&by(gauss), &jump, &EVEN), Order(4.0));
    assert_eq!(expected_on(&by(trapezoid), &jump, &EVEN), Order(1.0));
    assert_eq!(expected_on(&by(trapezoid), &kink, &EVEN), Order(2.0));
    let moving = case("jump-moving");
    assert_eq!(expected(&by(gauss), &moving), Order(1.0));
    // On a boundary of sub-intervals inside a segment nothing is claimed; off it the usual.
    assert_eq!(expected_on(&by(gauss), &kink, &[17, 33]), Expected::Unknown);
    let third = case("kink-off-node");
    assert_eq!(expected_on(&by(gauss), &third, &EVEN), Order(2.0));
    // Gauss nodes all but cancel a corner at a third: the coefficient is small, the next order still seen.
    let order = measured(&by(gauss), &third, &[32, 40], &[128, 160]);
    assert!((order - 2.0).abs() < 0.25, "{order}");
    let order = measured(&by(gauss), &jump, &[16], &[64]);
    assert!((order - 4.0).abs() < 0.05, "{order}");
    // A field that is not a polynomial, with a break of τ along it.
    let mut structure = kink.structure();
    structure.field_degree = None;
    let Method::Preintegrated(method) = by(gauss) else {
        panic!("not pre-integrated")
    };
    let limits = method.limits_on(&structure, &EVEN);
    assert_eq!(Expected::from_limits(&limits), Expected::Unknown);
}

#[test]
fn stratified_samples_scatter_in_the_one_segment_of_a_jump() {
    let format = Native::<f64>::new();
    for (name, order) in [("jump-off-node", 1.0), ("kink-off-node", 1.5)] {
        let case = case(name);
        let nodes = Fresh::new(&case, format);
        let deviation = |n: u64| {
            let radiances: Vec<f64> = (0..300)
                .map(|seed| {
                    let sampling = Sampling::Stratified;
                    let inner = Inner::MonteCarlo { sampling, seed };
                    let method = nested(inner, Rule::Boole, Exponential::Exact, Scope::Whole);
                    assert_eq!(expected(&method, &case), Order(order));
                    method.radiance(&nodes, n).unwrap()
                })
                .collect();
            let mean = radiances.iter().sum::<f64>() / 300.0;
            let squares: f64 = radiances.iter().map(|r| (r - mean).powi(2)).sum();
            squares.sqrt()
        };
        let found = (deviation(32) / deviation(512)).log2() / 4.0;
        assert!((found - order).abs() < 0.1, "{name}: {found}");
    }
}

#[test]
fn an_end_of_the_ray_is_a_node_of_every_ladder() {
    let Method::Nested(simpson) = rules(Rule::Simpson, Rule::Simpson) else {
        panic!("not nested")
    };
    let order = |part: Option<Rational>, power: u32| {
        let structure = Structure {
            breaks: vec![Break {
                part,
                extinction: None,
                source: Some(power.into()),
            }],
            ..Structure::default()
        };
        Expected::from_limits(&simpson.limits(&structure))
    };
    for end in [0, 1] {
        let end = Some(Rational::from(end));
        assert_eq!(order(end.clone(), 1), Order(4.0));
        assert_eq!(order(end, 0), Order(1.0));
    }
    assert_eq!(order(Some((1, 2).into()), 1), Order(2.0));
    // A place that nobody knows.
    assert_eq!(order(None, 1), Order(2.0));
    assert_eq!(order(None, 5), Order(4.0));
}
