//! What limits an order, where it is not simply the rule's.

use rug::Rational;
use volver::case::{Case, PolynomialTransfer, SineSquared, Structure};
use volver::method::{
    Color, Expected, Exponential, Inner, Integration, Interpolant, Nested, Opacity, Outer,
    Preintegrated, Scope,
};
use volver::quadrature::{Rule, Sampling};

#[test]
fn independent_samples_do_not_converge_under_a_linear_exponential_of_each_segment() {
    // The differences of neighbouring estimates scatter by √d: what the linear exponential neglects
    // of n of them is Σq²/2 = O(1).
    let with = |sampling, exponential| {
        Expected::from_limits(
            &Nested {
                inner: Inner::MonteCarlo { sampling, seed: 0 },
                outer: Outer(Rule::Trapezoid),
                exponential,
                scope: Scope::PerSegment,
            }
            .limits(&SineSquared.structure()),
        )
    };
    let linear = Exponential::Linear;
    assert_eq!(with(Sampling::Independent, linear), Expected::Order(0.0));
    assert_eq!(with(Sampling::Shared, linear), Expected::Order(0.5));
    assert_eq!(
        with(Sampling::Independent, Exponential::Quadratic),
        Expected::Order(1.0)
    );
}

#[test]
fn a_source_of_nothing_is_exact_by_every_method() {
    let dark = Structure {
        field_degree: None,
        transfer: Some(PolynomialTransfer {
            extinction: vec![Rational::from(1), Rational::from(2)],
            source: vec![Rational::new(); 2],
        }),
        ..Structure::default()
    };
    let nested = Nested {
        inner: Inner::PerSegment(Rule::Trapezoid),
        outer: Outer(Rule::Simpson),
        exponential: Exponential::Exact,
        scope: Scope::Whole,
    };
    assert_eq!(
        Expected::from_limits(&nested.limits(&dark)),
        Expected::Exact
    );
}

#[test]
fn sub_intervals_that_integrate_a_low_field_exactly_limit_nothing() {
    // s = λ, τ = s: of degree 1 under any interpolant, which the trapezoid rule integrates exactly.
    let structure = Structure {
        field_degree: Some(1),
        transfer: Some(PolynomialTransfer {
            extinction: vec![Rational::new(), Rational::from(1)],
            source: vec![Rational::from(1)],
        }),
        ..Structure::default()
    };
    let opacity = Opacity {
        interpolant: Interpolant::QuadraticMidpoint,
        integration: Integration::SubIntervals {
            count: 4,
            rule: Rule::Trapezoid,
        },
    };
    let color = Color {
        interpolant: Interpolant::QuadraticMidpoint,
        attenuated: true,
        integration: Integration::Closed,
    };
    let method = Preintegrated { color, opacity };
    assert_eq!(
        Expected::from_limits(&method.limits(&structure)),
        Expected::Exact
    );
}
