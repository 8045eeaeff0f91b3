//! Methods have names that read back, and names that are none say why.

use quickcheck::{Arbitrary, Gen, QuickCheck};
use volver::method::{
    Accumulation, Color, Compositing, CompositingOrder, Exponential, Filling, Inner, Integration,
    Interpolant, LastSegment, Layers, Method, Nested, Opacity, OpacityFormula, Outer, Position,
    Preintegrated, Scope, Summation, Threshold,
};
use volver::quadrature::{Rule, Sampling};

/// Any method that can run.
#[derive(Clone, Debug)]
struct Any(Method);

fn of<T: Copy>(g: &mut Gen, all: &[T]) -> T {
    *g.choose(all).unwrap()
}

fn rule(g: &mut Gen) -> Rule {
    let points = u32::arbitrary(g) % 1000 + 1;
    let all = [
        Rule::RiemannLeft,
        Rule::RiemannRight,
        Rule::Midpoint,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::Boole,
        Rule::GaussLegendre(points),
    ];
    of(g, &all)
}

fn nested(g: &mut Gen) -> Nested {
    let samplings = [
        Sampling::Shared,
        Sampling::Independent,
        Sampling::Stratified,
    ];
    let inner = [
        Inner::PerSegment(rule(g)),
        Inner::SimpsonPairs(of(g, &[Filling::Parabola, Filling::Trapezoid])),
        Inner::BooleFours,
        Inner::MonteCarlo {
            sampling: of(g, &samplings),
            seed: u64::arbitrary(g),
        },
    ];
    let exponentials = [
        Exponential::Exact,
        Exponential::Linear,
        Exponential::Quadratic,
        Exponential::Cubic,
    ];
    Nested {
        inner: of(g, &inner),
        outer: Outer(rule(g)),
        exponential: of(g, &exponentials),
        scope: of(g, &[Scope::Whole, Scope::PerSegment]),
    }
}

fn compositing(g: &mut Gen) -> Compositing {
    let opacities = [
        OpacityFormula::Subtraction,
        OpacityFormula::Expm1,
        OpacityFormula::Relative,
        OpacityFormula::Linear,
    ];
    let summations = [Summation::Naive, Summation::Pairwise, Summation::Neumaier];
    let orders = [
        CompositingOrder::FrontToBack {
            depth: of(
                g,
                &[
                    Accumulation::Transmittances,
                    Accumulation::Depths,
                    Accumulation::Remainder,
                ],
            ),
            summation: of(g, &summations),
            stop: Threshold::new(u32::arbitrary(g), u32::arbitrary(g)),
        },
        CompositingOrder::BackToFront,
        CompositingOrder::Tree,
    ];
    Compositing {
        position: of(g, &[Position::Front, Position::Middle, Position::Back]),
        opacity: of(g, &opacities),
        order: of(g, &orders),
    }
}

fn integral(g: &mut Gen) -> (Interpolant, Integration) {
    let interpolants = [
        Interpolant::Linear,
        Interpolant::Quadratic(LastSegment::Beyond),
        Interpolant::Quadratic(LastSegment::Backward),
        Interpolant::QuadraticMidpoint,
    ];
    let by_rule = Integration::SubIntervals {
        count: u32::arbitrary(g).max(1),
        rule: rule(g),
    };
    (of(g, &interpolants), of(g, &[Integration::Closed, by_rule]))
}

impl Arbitrary for Any {
    fn arbitrary(g: &mut Gen) -> Any {
        let (color, opacity) = (integral(g), integral(g));
        let preintegrated = Preintegrated {
            color: Color {
                interpolant: color.0,
                attenuated: bool::arbitrary(g),
                integration: color.1,
            },
            opacity: Opacity {
                interpolant: opacity.0,
                integration: opacity.1,
            },
        };
        let kinds = [
            Method::Nested(nested(g)),
            Method::Composited(compositing(g)),
            Method::Preintegrated(preintegrated),
            Method::Layered(of(g, &Layers::ALL)),
        ];
        Any(of(g, &kinds))
    }
}

#[test]
fn names_read_back() {
    let reads_back = |Any(method): Any| method.name().parse() == Ok(method);
    QuickCheck::new()
        .tests(5000)
        .quickcheck(reads_back as fn(Any) -> bool);
}

#[test]
fn different_methods_have_different_names() {
    let differ = |Any(a): Any, Any(b): Any| (a == b) == (a.name() == b.name());
    QuickCheck::new()
        .tests(2000)
        .quickcheck(differ as fn(Any, Any) -> bool);
}

#[test]
fn names_are_these() {
    for name in [
        "trapezoid/riemann-right",
        "gauss-3/boole/exact-per-segment",
        "simpson-pairs-parabola/simpson/linear",
        "monte-carlo@7/trapezoid/quadratic-whole",
        "monte-carlo-stratified@18446744073709551615/gauss-1000",
        "front-to-back/middle/expm1",
        "front-to-back/front/subtraction/depths/neumaier/stop=1:255",
        "front-to-back/back/linear/pairwise",
        "back-to-front/front/subtraction",
        "tree/middle/relative",
        "preintegrated/linear/quadratic-backward",
        "layers/linear",
        "layers/whole-own",
        "preintegrated/quadratic-by-10-trapezoid/quadratic-midpoint-by-3-gauss-2/unattenuated",
    ] {
        let method: Method = name.parse().unwrap();
        assert_eq!(method.name(), name);
        if let Method::Composited(compositing) = method {
            assert_eq!(compositing.to_string(), name);
        }
    }
    // Defaults may be said, options come in any order, fractions in any terms.
    for (name, canonical) in [
        ("boole/boole/exact", "boole/boole"),
        ("tree/front/expm1", "tree/front/expm1"),
        (
            "front-to-back/back/linear/stop=2:510/naive/depths",
            "front-to-back/back/linear/depths/stop=1:255",
        ),
        (
            "front-to-back/back/linear/transmittances",
            "front-to-back/back/linear",
        ),
    ] {
        assert_eq!(name.parse::<Method>().unwrap().name(), canonical);
    }
}

/// Name, what the error says of it, something that is allowed in its place.
const NEAR_MISSES: &[(&str, &str, &str)] = &[
    ("", "''", "front-to-back"),
    ("simpsons/boole", "'simpsons'", "gauss-1 … gauss-1000"),
    ("Trapezoid/boole", "'Trapezoid'", "trapezoid"),
    ("simpson", "outer rule missing", "riemann-left"),
    ("simpson/", "outer rule ''", "riemann-left"),
    ("gauss-0/boole", "'gauss-0'", "gauss-1 …"),
    (
        "gauss-3/simpson-pairs-parabola",
        "'simpson-pairs-parabola'",
        "midpoint",
    ),
    ("monte-carlo/boole", "'monte-carlo'", "monte-carlo@SEED"),
    (
        "monte-carlo@-1/boole",
        "'monte-carlo@-1'",
        "monte-carlo@SEED",
    ),
    (
        "monte-carlo@+1/boole",
        "'monte-carlo@+1'",
        "monte-carlo@SEED",
    ),
    ("monte-carlo@/boole", "'monte-carlo@'", "monte-carlo@SEED"),
    ("monte-carlo@18446744073709551616/boole", "551616'", "SEED"),
    (
        "boole/boole/quartic",
        "exponential 'quartic'",
        "cubic-whole",
    ),
    ("boole/boole/linear/whole", "'whole'", "nothing"),
    ("front-to-back", "position missing", "front, middle, back"),
    (
        "front-to-back/centre/expm1",
        "position 'centre'",
        "front, middle, back",
    ),
    ("tree/middle", "opacity missing", "subtraction"),
    (
        "tree/middle/exp",
        "opacity 'exp'",
        "subtraction, expm1, relative, linear",
    ),
    ("tree/middle/expm1/pairwise", "'pairwise'", "nothing"),
    (
        "front-to-back/middle/expm1/kahan",
        "option 'kahan'",
        "neumaier",
    ),
    (
        "front-to-back/middle/expm1/stop=2:1",
        "'stop=2:1'",
        "between 0 and 1",
    ),
    (
        "front-to-back/middle/expm1/stop=1/255",
        "'stop=1'",
        "between 0 and 1",
    ),
    (
        "front-to-back/middle/expm1/stop=1:4294967296",
        "'stop=1:4294967296'",
        "below 2³²",
    ),
    (
        "front-to-back/middle/expm1/naive/pairwise",
        "'pairwise'",
        "one of a kind",
    ),
    (
        "front-to-back/middle/expm1/stop=1:2/stop=1:3",
        "'stop=1:3'",
        "one of a kind",
    ),
    ("preintegrated", "color missing", "quadratic-backward"),
    (
        "preintegrated/linear",
        "opacity missing",
        "quadratic-midpoint",
    ),
    (
        "preintegrated/cubic/linear",
        "color 'cubic'",
        "linear, quadratic",
    ),
    (
        "preintegrated/linear/linear-by-0-boole",
        "'linear-by-0-boole'",
        "1 …",
    ),
    (
        "preintegrated/linear/linear-by-boole",
        "'linear-by-boole'",
        "COUNT-RULE",
    ),
    (
        "preintegrated/linear-by-2-booles/linear",
        "'linear-by-2-booles'",
        "boole",
    ),
    (
        "preintegrated/linear/linear/attenuated",
        "option 'attenuated'",
        "unattenuated",
    ),
    (" tree/middle/expm1", "' tree'", "tree"),
];

#[test]
fn near_misses_say_what_is_wrong_and_what_is_allowed() {
    for (name, part, allowed) in NEAR_MISSES {
        let error = name.parse::<Method>().unwrap_err().to_string();
        let (said, listed) = error.split_once("(allowed: ").unwrap();
        assert!(said.contains(part), "{error}");
        assert!(said.starts_with(&format!("method '{name}': ")), "{error}");
        assert!(listed.contains(allowed), "{error}");
        assert!(!error.contains('\n'));
    }
}
