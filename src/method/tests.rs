//! What theory expects of methods on cases, what measured errors say of it, and what is refused.

use super::{
    Color, Expected, Exponential, Filling, Inner, Integration, Interpolant, LastSegment, Limit,
    Method, MethodError, Nested, Opacity, Outer, Part, Preintegrated, Scope, expected,
};
use crate::case::{Case, Fresh, HomogeneousSlab, Reciprocal, ReciprocalSquare, SineSquared};
use crate::quadrature::{Rule, RuleError, Sampling};
use crate::real::{Format, Mpfr, Real};
use Expected::{Blind, Order};
use rug::{Float, Rational};

fn nested(inner: Inner, outer: Rule, exponential: Exponential, scope: Scope) -> Method {
    Method::Nested(Nested {
        inner,
        outer: Outer(outer),
        exponential,
        scope,
    })
}

fn rules(inner: Rule, outer: Rule) -> Method {
    let inner = Inner::PerSegment(inner);
    nested(inner, outer, Exponential::Exact, Scope::Whole)
}

fn sub_intervals(count: u32, rule: Rule) -> Integration {
    Integration::SubIntervals { count, rule }
}

fn preintegrated(color: Interpolant, opacity: Interpolant, integration: Integration) -> Method {
    Method::Preintegrated(Preintegrated {
        color: Color {
            interpolant: color,
            attenuated: true,
            integration,
        },
        opacity: Opacity {
            interpolant: opacity,
            integration,
        },
    })
}

fn unattenuated(interpolant: Interpolant) -> Method {
    Method::Preintegrated(Preintegrated {
        color: Color {
            interpolant,
            attenuated: false,
            integration: Integration::Closed,
        },
        opacity: Opacity {
            interpolant,
            integration: Integration::Closed,
        },
    })
}

const LINEAR: Interpolant = Interpolant::Linear;
const QUADRATIC: Interpolant = Interpolant::Quadratic(LastSegment::Beyond);
const BACKWARD: Interpolant = Interpolant::Quadratic(LastSegment::Backward);
const MIDDLE: Interpolant = Interpolant::QuadraticMidpoint;
const CLOSED: Integration = Integration::Closed;

fn slab() -> HomogeneousSlab {
    HomogeneousSlab {
        length: (3, 2).into(),
        extinction: (7, 5).into(),
        emission: (4, 5).into(),
    }
}

/// The orders that errors show between consecutive levels, at 400 bits.
fn measured<C: Case>(method: &Method, case: &C, levels: &[u64]) -> Vec<f64> {
    let format = Mpfr { bits: 400 };
    let nodes = Fresh::new(case, format);
    let exact = case.radiance(&format.ratio(&case.length()));
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
            let exact = slab.optical_depth(&format.ratio(&(Rational::from(i) / 4)));
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
        let exact = slab.optical_depth(&format.ratio(&lambda));
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
    let exact = slab.radiance(&format.ratio(&slab.length()));
    assert!((radiance - &exact).log2_abs() < -290.0);
    // Not so without the attenuation inside.
    assert_order(&unattenuated(LINEAR), &slab, 1.0, &[512, 1024, 2048]);
}

#[test]
fn the_least_limit_decides_and_a_vanishing_one_blinds() {
    let limit = |order, vanishes| Limit {
        part: Part::Source,
        order,
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

fn refused(method: &Method, n: u64) -> MethodError {
    let nodes = Fresh::new(&SineSquared, Mpfr { bits: 64 });
    method.radiance(&nodes, n).unwrap_err()
}

#[test]
fn levels_that_do_not_suit_a_rule_are_refused() {
    let pairs = Inner::SimpsonPairs(Filling::Parabola);
    let exact = |inner, outer| nested(inner, outer, Exponential::Exact, Scope::Whole);
    let random = Inner::MonteCarlo {
        sampling: Sampling::Shared,
        seed: 1,
    };
    let segments = |rule: &str, n, multiple| MethodError::Segments {
        rule: rule.into(),
        n,
        multiple,
    };
    for (method, n, error) in [
        (
            rules(Rule::Trapezoid, Rule::Simpson),
            3,
            segments("simpson", 3, 2),
        ),
        (
            rules(Rule::GaussLegendre(3), Rule::Simpson),
            3,
            segments("simpson", 3, 2),
        ),
        (
            rules(Rule::Trapezoid, Rule::Trapezoid),
            0,
            segments("trapezoid", 0, 1),
        ),
        (
            rules(Rule::Simpson, Rule::Boole),
            6,
            segments("boole", 6, 4),
        ),
        (
            exact(pairs, Rule::Trapezoid),
            5,
            segments("simpson-pairs-parabola", 5, 2),
        ),
        (
            exact(pairs, Rule::Midpoint),
            3,
            segments("simpson-pairs-parabola", 3, 2),
        ),
    ] {
        assert_eq!(refused(&method, n), error, "{method}");
    }
    // Which of two rules that refuse 0 is named is no promise.
    let sub_intervals = sub_intervals(1, Rule::Simpson);
    for method in [
        rules(Rule::GaussLegendre(3), Rule::Midpoint),
        rules(Rule::RiemannLeft, Rule::Boole),
        exact(pairs, Rule::Midpoint),
        exact(random, Rule::Midpoint),
        preintegrated(LINEAR, MIDDLE, sub_intervals),
        preintegrated(QUADRATIC, BACKWARD, sub_intervals),
    ] {
        let refusal = refused(&method, 0).to_string();
        assert!(
            refusal.starts_with("n = 0 segments "),
            "{method}: {refusal}"
        );
    }
    assert_eq!(
        refused(&preintegrated(BACKWARD, LINEAR, sub_intervals), 1).to_string(),
        "n = 1 segments are too few for quadratic-backward (allowed: 2 or more)"
    );
    assert_eq!(
        refused(&rules(Rule::Simpson, Rule::Boole), 6).to_string(),
        "n = 6 segments do not suit boole (allowed: positive multiples of 4)"
    );
}

/// Asking first tells the same as running.
#[test]
fn a_level_is_refused_before_it_is_run_just_as_when_it_is() {
    let simpson = sub_intervals(1, Rule::Simpson);
    let random = Inner::MonteCarlo {
        sampling: Sampling::Stratified,
        seed: 1,
    };
    let exact = |inner, outer| nested(inner, outer, Exponential::Exact, Scope::Whole);
    let nodes = Fresh::new(&SineSquared, Mpfr { bits: 64 });
    for method in [
        rules(Rule::RiemannLeft, Rule::Trapezoid),
        rules(Rule::Boole, Rule::Simpson),
        rules(Rule::Trapezoid, Rule::Boole),
        rules(Rule::Simpson, Rule::GaussLegendre(2)),
        exact(Inner::SimpsonPairs(Filling::Parabola), Rule::Midpoint),
        exact(Inner::SimpsonPairs(Filling::Trapezoid), Rule::Boole),
        exact(random, Rule::Simpson),
        preintegrated(LINEAR, LINEAR, simpson),
        preintegrated(QUADRATIC, MIDDLE, simpson),
        preintegrated(BACKWARD, LINEAR, simpson),
        preintegrated(LINEAR, BACKWARD, simpson),
    ] {
        for n in 0..=8 {
            let run = method.radiance(&nodes, n).map(drop);
            assert_eq!(
                method.check_segments(n).is_ok(),
                run.is_ok(),
                "{method}, n = {n}"
            );
        }
    }
}

#[test]
fn what_a_case_cannot_give_is_refused() {
    assert_eq!(
        refused(&preintegrated(LINEAR, LINEAR, CLOSED), 4),
        MethodError::NoClosedForm
    );
    assert_eq!(refused(&unattenuated(LINEAR), 4), MethodError::NoClosedForm);
    let none = preintegrated(LINEAR, LINEAR, sub_intervals(0, Rule::Simpson));
    assert_eq!(refused(&none, 4), MethodError::NoSubIntervals);
    let points = RuleError::Points { points: "0".into() };
    for method in [
        rules(Rule::GaussLegendre(0), Rule::Simpson),
        rules(Rule::Simpson, Rule::GaussLegendre(0)),
        preintegrated(LINEAR, LINEAR, sub_intervals(1, Rule::GaussLegendre(0))),
    ] {
        assert_eq!(refused(&method, 4), MethodError::Rule(points.clone()));
    }
}

/// Depth 70000 in one segment; cut in two it is within reach.
#[test]
fn a_segment_too_thick_for_the_series_is_refused() {
    let slab = HomogeneousSlab {
        length: 1.into(),
        extinction: 70000.into(),
        emission: 1.into(),
    };
    let nodes = Fresh::new(&slab, Mpfr { bits: 64 });
    let method = preintegrated(LINEAR, LINEAR, CLOSED);
    let error = method.radiance(&nodes, 1).unwrap_err();
    let depth = "70000".to_string();
    assert_eq!(error, MethodError::ThickSegment { depth });
    let radiance = Float::from(method.radiance(&nodes, 2).unwrap());
    assert!((radiance - 1_u32).abs() < 1e-12);
}

#[test]
fn methods_print_what_they_are() {
    for (method, text) in [
        (rules(Rule::Simpson, Rule::Boole), "simpson × boole"),
        (
            nested(
                Inner::SimpsonPairs(Filling::Trapezoid),
                Rule::GaussLegendre(3),
                Exponential::Linear,
                Scope::PerSegment,
            ),
            "simpson-pairs-trapezoid × gauss-3, linear exponential",
        ),
        (
            nested(
                Inner::MonteCarlo {
                    sampling: Sampling::Shared,
                    seed: 1,
                },
                Rule::Trapezoid,
                Exponential::Cubic,
                Scope::Whole,
            ),
            "monte-carlo × trapezoid, cubic exponential of the whole depth",
        ),
        (
            preintegrated(LINEAR, BACKWARD, CLOSED),
            "preintegrated linear × quadratic-backward",
        ),
        (
            preintegrated(QUADRATIC, MIDDLE, sub_intervals(10, Rule::Trapezoid)),
            "preintegrated quadratic by 10 × trapezoid × quadratic-midpoint by 10 × trapezoid",
        ),
        (
            unattenuated(LINEAR),
            "preintegrated linear without attenuation × linear",
        ),
    ] {
        assert_eq!(method.to_string(), text);
    }
}
