//! Sharing node values changes no bit of any result, and saves most of the work.

use half::f16;
use rug::Rational;
use volver::case::{AnyNodes, Case, Fresh, Nodes, Reciprocal, Shared, SineSquared};
use volver::method::{
    Color, Exponential, Filling, Inner, Integration, Interpolant, LastSegment, Level, Method,
    Nested, Opacity, Outer, Preintegrated, Scope,
};
use volver::quadrature::{Rule, Sampling};
use volver::real::{Format, Mpfr, Native, Real};
use volver::study::{Run, Silent};

fn nested(inner: Inner, outer: Rule, exponential: Exponential, scope: Scope) -> Method {
    Method::Nested(Nested {
        inner,
        outer: Outer(outer),
        exponential,
        scope,
    })
}

/// Every inner rule under every outer rule, with exponentials of both scopes.
fn nested_methods() -> Vec<Method> {
    let rules = [
        Rule::RiemannLeft,
        Rule::RiemannRight,
        Rule::Midpoint,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::Boole,
        Rule::GaussLegendre(3),
    ];
    let samplings = [
        Sampling::Shared,
        Sampling::Independent,
        Sampling::Stratified,
    ];
    let mut inner: Vec<Inner> = rules.map(Inner::PerSegment).into();
    inner.extend([Filling::Parabola, Filling::Trapezoid].map(Inner::SimpsonPairs));
    inner.push(Inner::BooleFours);
    inner.extend(samplings.map(|sampling| Inner::MonteCarlo { sampling, seed: 9 }));
    let exponentials = [
        (Exponential::Exact, Scope::Whole),
        (Exponential::Exact, Scope::PerSegment),
        (Exponential::Linear, Scope::PerSegment),
        (Exponential::Cubic, Scope::Whole),
    ];
    let mut methods = Vec::new();
    for &inner in &inner {
        for outer in rules {
            for (exponential, scope) in exponentials {
                methods.push(nested(inner, outer, exponential, scope));
            }
        }
    }
    methods
}

fn preintegrated_methods(closed: bool) -> Vec<Method> {
    let interpolants = [
        Interpolant::Linear,
        Interpolant::Quadratic(LastSegment::Beyond),
        Interpolant::Quadratic(LastSegment::Backward),
        Interpolant::QuadraticMidpoint,
    ];
    let sub_intervals = Integration::SubIntervals {
        count: 3,
        rule: Rule::Simpson,
    };
    let mut integrations = vec![sub_intervals];
    integrations.extend(closed.then_some(Integration::Closed));
    let mut methods = Vec::new();
    for color in interpolants {
        for opacity in interpolants {
            for &integration in &integrations {
                for attenuated in [true, false] {
                    methods.push(Method::Preintegrated(Preintegrated {
                        color: Color {
                            interpolant: color,
                            attenuated,
                            integration,
                        },
                        opacity: Opacity {
                            interpolant: opacity,
                            integration,
                        },
                    }));
                }
            }
        }
    }
    methods
}

const LADDER: [u64; 4] = [4, 8, 12, 24];

/// Equal values, and not finite together.
fn assert_same<R: Real>(a: &R, b: &R, what: &dyn std::fmt::Display) {
    assert_eq!(a.to_rational(), b.to_rational(), "{what}");
}

fn sharing_changes_nothing<C: Case, F: Format>(case: &C, format: F, methods: &[Method]) {
    let run = Run::new(case, format, methods, &LADDER, &Silent).unwrap();
    let fresh = Fresh::new(case, format);
    let shared = Shared::new(case, format);
    // Levels in another order than the run's: what is in the cache already must not matter.
    for (column, &n) in LADDER.iter().enumerate() {
        let mut level = Level::new(&shared, n);
        for (method, values) in methods.iter().zip(&run.radiances) {
            let alone = method.radiance(&fresh, n).unwrap();
            let what = format!("{method} on {n} segments in {format}");
            assert_same(&level.radiance(method).unwrap(), &alone, &what);
            assert_same(&method.radiance(&shared, n).unwrap(), &alone, &what);
            let in_one_pass = method.stream(AnyNodes::new(&fresh), n).unwrap();
            assert_same(&in_one_pass, &alone, &what);
            assert_eq!(values[column].to_rational(), alone.to_rational(), "{what}");
        }
    }
    assert_eq!(run.bits, format.bits());
    assert_eq!(run.ladder, LADDER);
}

fn in_every_format<C: Case>(case: &C, methods: &[Method]) {
    sharing_changes_nothing(case, Native::<f32>::new(), methods);
    sharing_changes_nothing(case, Native::<f64>::new(), methods);
    sharing_changes_nothing(case, Native::<f16>::new(), methods);
    sharing_changes_nothing(case, Mpfr { bits: 113 }, methods);
}

#[test]
fn nested_methods_keep_every_bit() {
    in_every_format(&SineSquared, &nested_methods());
}

#[test]
fn preintegrated_methods_keep_every_bit() {
    in_every_format(&Reciprocal, &preintegrated_methods(true));
    in_every_format(&SineSquared, &preintegrated_methods(false));
}

/// Node i/n is the node 2i/2n in every format, so that levels may share it.
#[test]
fn levels_share_the_bits_of_their_common_nodes() {
    fn check<F: Format>(format: F) {
        let nodes = Fresh::new(&SineSquared, format);
        let coarse = nodes.boundaries(12);
        for factor in [2, 3, 50] {
            let fine = nodes.boundaries(12 * factor);
            for (i, s) in (0..)
                .step_by(usize::try_from(factor).unwrap())
                .zip(&coarse.field)
            {
                assert_same(s, &fine.field[i], &factor);
            }
        }
        let middles = nodes.interior(12, &Rational::from((1, 2)));
        let fine = nodes.boundaries(24);
        for (s, same) in middles
            .field
            .iter()
            .zip(fine.field.iter().skip(1).step_by(2))
        {
            assert_same(s, same, &"middle");
        }
    }
    check(Native::<f16>::new());
    check(Native::<f32>::new());
    check(Native::<f64>::new());
    check(Mpfr { bits: 61 });
}

/// Table 1 of Etiene, Kirby and Silva (2013) on n = 8 … 4096: 4 inner rules, 4 outer rules, exact and
/// linear exponential.
fn table_1() -> Vec<Method> {
    let inner = [
        Rule::RiemannLeft,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::GaussLegendre(3),
    ];
    let outer = [
        Rule::RiemannRight,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::Boole,
    ];
    let mut methods = Vec::new();
    for inner in inner.map(Inner::PerSegment) {
        for outer in outer {
            methods.push(nested(inner, outer, Exponential::Exact, Scope::Whole));
            methods.push(nested(inner, outer, Exponential::Linear, Scope::PerSegment));
        }
    }
    methods
}

#[test]
fn table_1_takes_a_fifth_of_the_evaluations_or_less() {
    let case = SineSquared;
    let format = Native::<f64>::new();
    let ladder: Vec<u64> = (3..=12).map(|k| 1 << k).collect();
    let methods = table_1();
    let shared = Run::new(&case, format, &methods, &ladder, &Silent)
        .unwrap()
        .evaluations;
    // The finest level's boundaries and middles hold all coarser ones, 2·4096 + 1; the two irrational
    // nodes of Gauss–Legendre 3 belong to their level, 2·(8 + … + 4096).
    assert_eq!(shared, 8193 + 2 * 8184);

    // One run per entry over fresh nodes.
    let fresh: u64 = methods
        .iter()
        .flat_map(|method| ladder.iter().map(move |&n| (method, n)))
        .map(|(method, n)| {
            let nodes = Fresh::new(&case, format);
            method.radiance(&nodes, n).unwrap();
            nodes.evaluations()
        })
        .sum();
    // And one that looks at each of its own nodes once only: n + 1 boundaries, with n middles for
    // Simpson and n·3 more for Gauss–Legendre; 8 entries of each inner rule.
    let frugal: u64 = ladder
        .iter()
        .map(|n| 8 * (2 * (n + 1) + (2 * n + 1) + (4 * n + 1)))
        .sum();
    println!("evaluations: {shared} shared, {frugal} entry by entry, {fresh} over fresh nodes");
    assert!(frugal <= fresh);
    assert!(
        5 * shared <= frugal,
        "{shared} shared, {frugal} entry by entry"
    );
}

#[test]
fn composited_methods_keep_every_bit() {
    let methods: Vec<Method> = [
        "front-to-back/front/expm1/stop=1:2",
        "front-to-back/middle/subtraction/pairwise",
        "front-to-back/back/relative/depths/neumaier",
        "back-to-front/middle/linear",
        "tree/back/expm1",
    ]
    .map(|name| name.parse().unwrap())
    .into();
    in_every_format(&SineSquared, &methods);
    in_every_format(&Reciprocal, &methods);
}

/// As many nodes as rules look at, each once; a method that streams asks for no column.
#[test]
fn one_pass_looks_at_every_node_once() {
    let n = 60;
    for (name, nodes) in [
        ("riemann-left/riemann-right", n + 1),
        ("trapezoid/boole", n + 1),
        ("simpson/simpson", 2 * n + 1),
        ("boole/trapezoid", 4 * n + 1),
        ("gauss-3/simpson", 4 * n + 1),
        // Middles, and the quarters before them.
        ("midpoint/midpoint", 2 * n),
        // Ends, middles for both rules, and the quarters.
        ("simpson/midpoint", 3 * n + 1),
        ("front-to-back/middle/expm1", n),
        ("layers/middle", 2 * n + 1),
    ] {
        let method: Method = name.parse().unwrap();
        let fresh = Fresh::new(&SineSquared, Native::<f64>::new());
        method.stream(AnyNodes::new(&fresh), n).unwrap();
        assert!(method.streams(), "{name}");
        assert_eq!(fresh.evaluations(), nodes, "{name}");
    }
    for name in [
        "back-to-front/middle/expm1",
        "monte-carlo@1/trapezoid",
        "simpson-pairs-parabola/simpson",
        "preintegrated/linear/linear",
    ] {
        assert!(!name.parse::<Method>().unwrap().streams(), "{name}");
    }
    let fresh = Fresh::new(&SineSquared, Native::<f64>::new());
    let boole: Method = "trapezoid/boole".parse().unwrap();
    let refused = boole.stream(AnyNodes::new(&fresh), 6).unwrap_err();
    assert_eq!(Err(refused), boole.radiance(&fresh, 6));
}
