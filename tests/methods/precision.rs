//! Generic means generic: no constant of binary64 hides in any method, so more bits give more digits.

use rug::Float;
use volver::case::{Case, Fresh, HomogeneousSlab, Reciprocal, ReciprocalSquare, SineSquared};
use volver::method::{
    Color, Exponential, Filling, Inner, Integration, Interpolant, LastSegment, Method, Nested,
    Opacity, Outer, Preintegrated, Scope,
};
use volver::quadrature::{Rule, Sampling};
use volver::real::{Format, Mpfr, Native, Real};

/// No number here is one of binary64.
fn slab() -> HomogeneousSlab {
    HomogeneousSlab {
        length: (13, 10).into(),
        extinction: (4, 3).into(),
        emission: (7, 10).into(),
    }
}

const RULES: [Rule; 8] = [
    Rule::RiemannLeft,
    Rule::RiemannRight,
    Rule::Midpoint,
    Rule::Trapezoid,
    Rule::Simpson,
    Rule::Boole,
    Rule::GaussLegendre(3),
    Rule::GaussLegendre(20),
];

fn nested(inner: Inner, outer: Rule, exponential: Exponential, scope: Scope) -> Method {
    Method::Nested(Nested {
        inner,
        outer: Outer(outer),
        exponential,
        scope,
    })
}

fn nested_methods() -> Vec<Method> {
    let samplings = [
        Sampling::Shared,
        Sampling::Independent,
        Sampling::Stratified,
    ];
    let mut inner: Vec<Inner> = RULES.map(Inner::PerSegment).into();
    inner.extend([Filling::Parabola, Filling::Trapezoid].map(Inner::SimpsonPairs));
    inner.push(Inner::BooleFours);
    inner.extend(samplings.map(|sampling| Inner::MonteCarlo { sampling, seed: 1 }));
    let mut methods = Vec::new();
    for &inner in &inner {
        for outer in RULES {
            methods.push(nested(inner, outer, Exponential::Exact, Scope::Whole));
        }
        for exponential in [
            Exponential::Exact,
            Exponential::Linear,
            Exponential::Quadratic,
            Exponential::Cubic,
        ] {
            for outer in [Rule::Boole, Rule::GaussLegendre(3)] {
                methods.push(nested(inner, outer, exponential, Scope::PerSegment));
                methods.push(nested(inner, outer, exponential, Scope::Whole));
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
    let mut integrations: Vec<Integration> = RULES
        .map(|rule| Integration::SubIntervals { count: 3, rule })
        .into();
    integrations.extend(closed.then_some(Integration::Closed));
    let mut methods = Vec::new();
    for interpolant in interpolants {
        for &integration in &integrations {
            for attenuated in [true, false] {
                methods.push(Method::Preintegrated(Preintegrated {
                    color: Color {
                        interpolant,
                        attenuated,
                        integration,
                    },
                    opacity: Opacity {
                        interpolant,
                        integration,
                    },
                }));
            }
        }
    }
    methods
}

fn log2_relative(a: &Float, b: &Float) -> f64 {
    let difference = Float::with_val(1000, a - b) / b;
    let (mantissa, exponent) = difference.to_f64_exp();
    mantissa.abs().log2() + f64::from(exponent)
}

fn more_bits_give_more_digits<C: Case>(case: &C, methods: &[Method]) {
    let n = 4;
    for method in methods {
        let at = |bits| {
            Float::from(
                method
                    .radiance(&Fresh::new(case, Mpfr { bits }), n)
                    .unwrap(),
            )
        };
        let (wide, wider) = (at(400), at(800));
        let off = log2_relative(&wide, &wider);
        assert!(
            off < -380.0,
            "{method} on {case:?}: 400 and 800 bits differ by 2^{off}"
        );
        let native = method
            .radiance(&Fresh::new(case, Native::<f64>::new()), n)
            .unwrap();
        let off = log2_relative(&Float::with_val(53, native), &wider);
        assert!(
            off < -40.0,
            "{method} on {case:?}: binary64 is off by 2^{off}"
        );
    }
}

#[test]
fn nested_methods_have_no_precision_of_their_own() {
    let methods = nested_methods();
    more_bits_give_more_digits(&SineSquared, &methods);
    more_bits_give_more_digits(&Reciprocal, &methods);
    more_bits_give_more_digits(&ReciprocalSquare, &methods);
    more_bits_give_more_digits(&slab(), &methods);
}

#[test]
fn preintegrated_methods_have_no_precision_of_their_own() {
    more_bits_give_more_digits(&SineSquared, &preintegrated_methods(false));
    let methods = preintegrated_methods(true);
    more_bits_give_more_digits(&Reciprocal, &methods);
    more_bits_give_more_digits(&ReciprocalSquare, &methods);
    more_bits_give_more_digits(&slab(), &methods);
}

#[test]
fn composited_methods_have_no_precision_of_their_own() {
    let mut methods: Vec<Method> = Vec::new();
    for position in ["front", "middle", "back"] {
        for opacity in ["subtraction", "expm1", "relative", "linear"] {
            for (order, options) in [
                ("front-to-back", ""),
                ("front-to-back", "/pairwise"),
                ("front-to-back", "/depths/neumaier"),
                ("back-to-front", ""),
                ("tree", ""),
            ] {
                let name = format!("{order}/{position}/{opacity}{options}");
                methods.push(name.parse().unwrap());
            }
        }
    }
    more_bits_give_more_digits(&SineSquared, &methods);
    more_bits_give_more_digits(&Reciprocal, &methods);
    more_bits_give_more_digits(&slab(), &methods);
}

#[test]
fn exact_solutions_have_no_precision_of_their_own() {
    fn check<C: Case>(case: &C) {
        let at = |bits| {
            let format = Mpfr { bits };
            let end = format.ratio(&case.length());
            (
                Float::from(case.radiance(&end).unwrap()),
                Float::from(case.optical_depth(&end).unwrap()),
            )
        };
        let (wide, wider) = (at(400), at(800));
        assert!(log2_relative(&wide.0, &wider.0) < -390.0, "I of {case:?}");
        assert!(log2_relative(&wide.1, &wider.1) < -390.0, "t of {case:?}");
    }
    check(&SineSquared);
    check(&Reciprocal);
    check(&ReciprocalSquare);
    check(&slab());
}

/// log₂ of the errors on n = 1, 2, 4 … in a format.
fn errors<C: Case, F: Format>(case: &C, format: F, method: &Method, levels: u32) -> Vec<f64> {
    let nodes = Fresh::new(case, format);
    let reference = Mpfr { bits: 600 };
    let exact = case.radiance(&reference.ratio(&case.length())).unwrap();
    (0..levels)
        .map(|k| {
            let radiance = method.radiance(&nodes, 1 << k).unwrap();
            let radiance = reference.ratio(&radiance.to_rational().unwrap());
            (radiance - &exact).log2_abs()
        })
        .collect()
}

/// Order 40: the error falls by 2⁴⁰ a level until the format ends, at 53 bits near 2⁻⁵³ and at 400
/// bits far below 10⁻⁶⁰ = 2⁻¹⁹⁹.
#[test]
fn high_orders_go_on_where_binary64_stops() {
    fn check<C: Case>(case: &C, method: &Method) {
        let wide = errors(case, Mpfr { bits: 400 }, method, 5);
        for pair in wide.windows(2) {
            assert!(pair[1] < pair[0] - 30.0, "{method} on {case:?}: {wide:?}");
        }
        assert!(wide[4] < -199.3, "{method} on {case:?}: {wide:?}");
        let native = errors(case, Native::<f64>::new(), method, 5);
        // It is there from n = 2 on, and gets no better.
        for error in &native[1..] {
            assert!(
                (-75.0..-48.0).contains(error) || *error == f64::NEG_INFINITY,
                "{native:?}"
            );
        }
    }
    let gauss = Rule::GaussLegendre(20);
    let method = nested(
        Inner::PerSegment(gauss),
        gauss,
        Exponential::Exact,
        Scope::Whole,
    );
    check(&SineSquared, &method);
    check(&Reciprocal, &method);
    check(&ReciprocalSquare, &method);
}
