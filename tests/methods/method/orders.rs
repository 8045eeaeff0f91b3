//! What theory expects of methods on cases, and the orders that errors measure there.

use super::{
    BACKWARD, CLOSED, LINEAR, MIDDLE, QUADRATIC, nested, preintegrated, rules, slab, sub_intervals,
    unattenuated,
};
use Expected::{Blind, Order};
use rug::Rational;
use volver::case::{Case, Fresh, Reciprocal, ReciprocalSquare, SineSquared};
use volver::method::{Expected, Exponential, Filling, Inner, Limit, Method, Part, Scope, expected};
use volver::quadrature::{Rule, Sampling};
use volver::real::{Format, Mpfr, Real};

/// The orders that errors show between consecutive levels, at 400 bits.
fn measured<C: Case>(method: &Method, case: &C, levels: &[u64]) -> Vec<f64> {
    let format = Mpfr { bits: 400 };
    let nodes = Fresh::new(case, format);
    let exact = case.radiance(&format.ratio(&case.length())).unwrap();
    let errors: Vec<f64> = levels
        .iter()
        .map(|&n| (method.radiance(&nodes, n).unwrap() - &exact).log2_abs())
        .collect();
    let pairs = errors.windows(2).zip(levels.windows(2));
    pairs
        .map(|(e, n)| (e[0] - e[1]) / (n[1] as f64 / n[0] as f64).log2())
        .collect()
}

/// The last measured order is the expected one.
fn assert_order<C: Case>(method: &Method, case: &C, order: f64, levels: &[u64]) {
    let expected = match expected(method, case) {
        Blind { here, .. } => Order(here),
        other => other,
    };
    assert_eq!(expected, Order(order), "{method} on {case:?}");
    let orders = measured(method, case, levels);
    let last = orders.last().unwrap();
    assert!(
        (last - order).abs() < 0.05,
        "{method} on {case:?}: {orders:?}"
    );
}

const LEVELS: [u64; 3] = [64, 128, 256];

/// min(p, q) with p, q the orders of the composite rules (Etiene, Kirby and Silva 2013, equation 22).
#[test]
fn nested_rules_have_the_lesser_of_their_orders() {
    use Rule::{Boole, GaussLegendre, Midpoint, RiemannLeft, RiemannRight, Simpson, Trapezoid};
    let case = SineSquared;
    for (inner, outer, order) in [
        (RiemannLeft, RiemannRight, 1.0),
        (RiemannLeft, Boole, 1.0),
        (Boole, RiemannRight, 1.0),
        (Trapezoid, Trapezoid, 2.0),
        (Trapezoid, Simpson, 2.0),
        (Simpson, Trapezoid, 2.0),
        (Midpoint, Boole, 2.0),
        (Boole, Midpoint, 2.0),
        (Simpson, Simpson, 4.0),
        (GaussLegendre(3), Simpson, 4.0),
        (GaussLegendre(2), GaussLegendre(3), 4.0),
        (GaussLegendre(3), Boole, 6.0),
        (Boole, GaussLegendre(3), 6.0),
        (GaussLegendre(4), GaussLegendre(5), 8.0),
    ] {
        assert_order(&rules(inner, outer), &case, order, &LEVELS);
    }
    // Long pre-asymptotic: its pairwise orders start near 6.7 (the paper printed 4.80).
    assert_order(&rules(Simpson, Boole), &case, 4.0, &[1024, 2048, 4096]);
}

#[test]
fn a_pair_of_segments_filled_by_a_trapezoid_loses_an_order() {
    for (filling, order) in [(Filling::Parabola, 4.0), (Filling::Trapezoid, 3.0)] {
        // Over the boundaries themselves, and looking inside segments.
        for outer in [Rule::Boole, Rule::GaussLegendre(3)] {
            let inner = Inner::SimpsonPairs(filling);
            let method = nested(inner, outer, Exponential::Exact, Scope::Whole);
            assert_order(&method, &SineSquared, order, &[128, 256, 512]);
        }
    }
}

#[test]
fn four_segments_filled_by_their_polynomial_keep_booles_order() {
    for outer in [Rule::Boole, Rule::GaussLegendre(3)] {
        let method = nested(Inner::BooleFours, outer, Exponential::Exact, Scope::Whole);
        assert_order(&method, &SineSquared, 6.0, &[128, 256, 512]);
    }
}

/// A Taylor polynomial of degree k leaves O(d^(k+1)) in each of D/d segments; of the whole depth it
/// leaves a constant.
#[test]
fn polynomial_exponentials_limit_the_order() {
    let inner = Inner::PerSegment(Rule::GaussLegendre(3));
    for (exponential, order) in [
        (Exponential::Linear, 1.0),
        (Exponential::Quadratic, 2.0),
        (Exponential::Cubic, 3.0),
    ] {
        for outer in [Rule::Boole, Rule::GaussLegendre(3)] {
            let method = nested(inner, outer, exponential, Scope::PerSegment);
            assert_order(&method, &SineSquared, order, &[128, 256, 512]);
        }
        let whole = nested(inner, Rule::Boole, exponential, Scope::Whole);
        assert_eq!(expected(&whole, &SineSquared), Order(0.0));
        let orders = measured(&whole, &SineSquared, &LEVELS);
        assert!(
            orders[1].abs() < 0.01,
            "{exponential} of the whole: {orders:?}"
        );
    }
    let cubic = nested(
        Inner::PerSegment(Rule::Trapezoid),
        Rule::Trapezoid,
        Exponential::Cubic,
        Scope::PerSegment,
    );
    assert_order(&cubic, &SineSquared, 2.0, &LEVELS);
}

/// Every rule integrates a constant: only the outer rule is left, whatever the inner one.
#[test]
fn on_a_homogeneous_slab_inner_rules_are_exact() {
    let slab = slab();
    let per_segment = [
        Rule::RiemannLeft,
        Rule::RiemannRight,
        Rule::Midpoint,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::Boole,
        Rule::GaussLegendre(2),
    ];
    let random = [Sampling::Independent, Sampling::Stratified];
    let inner_rules = per_segment
        .map(Inner::PerSegment)
        .into_iter()
        .chain([Filling::Parabola, Filling::Trapezoid].map(Inner::SimpsonPairs))
        .chain(random.map(|sampling| Inner::MonteCarlo { sampling, seed: 5 }));
    for inner in inner_rules {
        for (outer, order) in [
            (Rule::RiemannRight, 1.0),
            (Rule::Midpoint, 2.0),
            (Rule::Simpson, 4.0),
            (Rule::Boole, 6.0),
            (Rule::GaussLegendre(4), 8.0),
        ] {
            let method = nested(inner, outer, Exponential::Exact, Scope::PerSegment);
            assert_order(&method, &slab, order, &LEVELS);
        }
        // And the depth itself is κλ, to the last bits.
        let format = Mpfr { bits: 200 };
        let nodes = Fresh::new(&slab, format);
        let depth = inner.depth(&nodes, 6).unwrap();
        for (i, t) in (0..).zip(&depth.boundaries) {
            let exact = slab
                .optical_depth(&format.ratio(&(Rational::from(i) / 4)))
                .unwrap();
            assert!(
                (t.clone() - &exact).log2_abs() < -190.0,
                "{inner}, boundary {i}"
            );
        }
    }
}

/// How many of a shared set of samples lie before a node is random even there.
#[test]
fn shared_samples_are_not_exact_even_on_a_homogeneous_slab() {
    let inner = Inner::MonteCarlo {
        sampling: Sampling::Shared,
        seed: 5,
    };
    let method = nested(inner, Rule::Boole, Exponential::Exact, Scope::Whole);
    assert_eq!(expected(&method, &slab()), Order(0.5));
    let format = Mpfr { bits: 100 };
    let slab = slab();
    let nodes = Fresh::new(&slab, format);
    let depth = inner.depth(&nodes, 16).unwrap();
    let missed = (0..).zip(&depth.boundaries).any(|(i, t)| {
        let lambda = slab.length() * Rational::from((i, 16));
        let exact = slab.optical_depth(&format.ratio(&lambda)).unwrap();
        (t.clone() - &exact).log2_abs() > -20.0
    });
    assert!(missed);
}

#[test]
fn random_depths_have_the_order_of_their_sampling() {
    for (sampling, order) in [
        (Sampling::Shared, 0.5),
        (Sampling::Independent, 1.0),
        (Sampling::Stratified, 1.5),
    ] {
        let inner = Inner::MonteCarlo { sampling, seed: 0 };
        let method = |outer| nested(inner, outer, Exponential::Exact, Scope::Whole);
        assert_eq!(expected(&method(Rule::Boole), &SineSquared), Order(order));
        assert_eq!(
            expected(&method(Rule::RiemannRight), &SineSquared),
            Order(order.min(1.0))
        );
    }
}

/// A polynomial extinction of degree k is exact under an inner rule of degree k or more.
#[test]
fn inner_rules_are_exact_up_to_their_degree() {
    for (inner, degree, order) in [
        (Inner::PerSegment(Rule::RiemannLeft), 0, 1.0),
        (Inner::PerSegment(Rule::Midpoint), 1, 2.0),
        (Inner::PerSegment(Rule::Simpson), 3, 4.0),
        (Inner::PerSegment(Rule::Boole), 5, 6.0),
        (Inner::PerSegment(Rule::GaussLegendre(3)), 5, 6.0),
        (Inner::SimpsonPairs(Filling::Parabola), 2, 4.0),
        (Inner::SimpsonPairs(Filling::Trapezoid), 1, 3.0),
        (Inner::BooleFours, 4, 6.0),
    ] {
        assert_eq!(inner.order(Some(degree)), None, "{inner}");
        assert_eq!(inner.order(Some(degree + 1)), Some(order), "{inner}");
        assert_eq!(inner.order(None), Some(order), "{inner}");
    }
}

/// An interpolant of order m leaves O(dᵐ), the field's error in the attenuation inside a segment is
/// one order higher, C τ = 1 hides the source's (Etiene, Kirby and Silva 2013, section 4).
#[test]
fn preintegration_has_the_order_of_its_interpolants() {
    let square = ReciprocalSquare;
    for (color, opacity, order) in [
        (LINEAR, LINEAR, 2.0),
        (LINEAR, QUADRATIC, 2.0),
        (QUADRATIC, LINEAR, 2.0),
        (QUADRATIC, QUADRATIC, 3.0),
        (QUADRATIC, BACKWARD, 3.0),
        (BACKWARD, BACKWARD, 3.0),
        (MIDDLE, MIDDLE, 4.0),
        (MIDDLE, QUADRATIC, 3.0),
    ] {
        assert_order(
            &preintegrated(color, opacity, CLOSED),
            &square,
            order,
            &[128, 256, 512],
        );
    }
    assert_order(&unattenuated(LINEAR), &square, 1.0, &[512, 1024, 2048]);
    assert_order(
        &unattenuated(QUADRATIC),
        &Reciprocal,
        1.0,
        &[512, 1024, 2048],
    );
}

#[test]
fn a_constant_source_blinds_where_the_source_would_limit() {
    let method = preintegrated(LINEAR, QUADRATIC, CLOSED);
    let blind = Blind {
        general: 2.0,
        here: 3.0,
    };
    assert_eq!(expected(&method, &Reciprocal), blind);
    assert_order(&method, &Reciprocal, 3.0, &[128, 256, 512]);
    // The opacity limits as well: nothing is hidden.
    let linear = preintegrated(LINEAR, LINEAR, CLOSED);
    assert_eq!(expected(&linear, &Reciprocal), Order(2.0));
    assert_order(&linear, &Reciprocal, 2.0, &[128, 256, 512]);
}

/// N fixed sub-intervals of a rule of order r leave O(dʳ).
#[test]
fn sub_intervals_have_the_order_of_their_rule() {
    let sine = SineSquared;
    for (rule, order) in [
        (Rule::RiemannLeft, 1.0),
        (Rule::Midpoint, 2.0),
        (Rule::Trapezoid, 2.0),
        (Rule::Simpson, 4.0),
        (Rule::GaussLegendre(3), 6.0),
    ] {
        // Its field is linear, so interpolation is exact there.
        let method = preintegrated(LINEAR, MIDDLE, sub_intervals(2, rule));
        assert_order(&method, &sine, order, &LEVELS);
    }
    let method = preintegrated(QUADRATIC, QUADRATIC, sub_intervals(1, Rule::Trapezoid));
    assert_order(&method, &ReciprocalSquare, 2.0, &[256, 512, 1024]);
    let method = preintegrated(QUADRATIC, QUADRATIC, sub_intervals(2, Rule::Simpson));
    assert_order(&method, &ReciprocalSquare, 3.0, &[256, 512, 1024]);
}

#[test]
fn a_closed_form_on_an_interpolated_exact_field_is_exact() {
    let slab = slab();
    let method = preintegrated(LINEAR, LINEAR, CLOSED);
    assert_eq!(expected(&method, &slab), Expected::Exact);
    let format = Mpfr { bits: 300 };
    let radiance = method.radiance(&Fresh::new(&slab, format), 7).unwrap();
    let exact = slab.radiance(&format.ratio(&slab.length())).unwrap();
    assert!((radiance - &exact).log2_abs() < -290.0);
    // Not so without the attenuation inside.
    assert_order(&unattenuated(LINEAR), &slab, 1.0, &[512, 1024, 2048]);
}

#[test]
fn the_least_limit_decides_and_a_vanishing_one_blinds() {
    let limit = |order, vanishes| Limit {
        part: Part::Source,
        order: Some(order),
        vanishes,
    };
    let of = |limits: &[Limit]| Expected::from_limits(limits);
    assert_eq!(of(&[]), Expected::Exact);
    assert_eq!(of(&[limit(3.0, false), limit(2.0, false)]), Order(2.0));
    assert_eq!(of(&[limit(2.0, true), limit(2.0, false)]), Order(2.0));
    assert_eq!(of(&[limit(3.0, true), limit(2.0, false)]), Order(2.0));
    let blind = |general, here| Blind { general, here };
    assert_eq!(of(&[limit(2.0, true), limit(3.0, false)]), blind(2.0, 3.0));
    assert_eq!(of(&[limit(2.0, true)]), blind(2.0, f64::INFINITY));
}
