//! Every nested method, and compositing, computes what its definition says, to the last digit: in exact rational
//! arithmetic, against a second and plainer implementation written from the formulas.
//!
//! Polynomial exponentials leave + − × alone, so nothing is rounded on either side and the results
//! are equal, not close.

mod compositing;
mod exact;
mod plain;

use exact::Exact;
use plain::{Plain, Ramp, q};
use rug::Rational;
use volver::case::Fresh;
use volver::method::{Exponential, Filling, Inner, Method, Nested, Outer, Scope};
use volver::quadrature::{Rule, Sampling};

fn by_method(nested: Nested, ramp: &Ramp, n: u64) -> Rational {
    let nodes = Fresh::new(ramp, Exact);
    Method::Nested(nested).radiance(&nodes, n).unwrap().0
}

const RULES: [Rule; 8] = [
    Rule::RiemannLeft,
    Rule::RiemannRight,
    Rule::Midpoint,
    Rule::Trapezoid,
    Rule::Simpson,
    Rule::Boole,
    Rule::GaussLegendre(2),
    Rule::GaussLegendre(3),
];

const SAMPLINGS: [Sampling; 3] = [
    Sampling::Shared,
    Sampling::Independent,
    Sampling::Stratified,
];

const POLYNOMIALS: [Exponential; 3] = [
    Exponential::Linear,
    Exponential::Quadratic,
    Exponential::Cubic,
];

fn compare(inner: Inner, levels: &[u64]) {
    // A bent extinction, since every rule but Riemann's is exact for a straight one.
    let ramp = Ramp {
        length: q(3, 2),
        extinction: [q(4, 3), q(1, 1), q(2, 5)],
    };
    for &n in levels {
        for outer in RULES {
            if !n.is_multiple_of(Outer(outer).segments_multiple()) {
                continue;
            }
            for exponential in POLYNOMIALS {
                for scope in [Scope::PerSegment, Scope::Whole] {
                    let plain = Plain {
                        ramp: ramp.clone(),
                        n,
                        inner,
                        exponential,
                        scope,
                    };
                    let nested = Nested {
                        inner,
                        outer: Outer(outer),
                        exponential,
                        scope,
                    };
                    let (ours, theirs) = (by_method(nested, &ramp, n), plain.radiance(outer));
                    assert!(ours == theirs, "{nested} on {n} segments");
                }
            }
        }
    }
}

#[test]
fn rules_on_every_segment() {
    for rule in RULES {
        let open = matches!(rule, Rule::GaussLegendre(_));
        compare(
            Inner::PerSegment(rule),
            if open { &[1, 4] } else { &[1, 2, 4, 8] },
        );
    }
}

#[test]
fn simpson_over_pairs_with_both_fillings() {
    for filling in [Filling::Parabola, Filling::Trapezoid] {
        compare(Inner::SimpsonPairs(filling), &[2, 4, 8]);
    }
}

#[test]
fn boole_over_fours() {
    compare(Inner::BooleFours, &[4, 8]);
}

#[test]
fn monte_carlo_with_each_sampling() {
    for sampling in SAMPLINGS {
        for seed in [0, 12345] {
            compare(Inner::MonteCarlo { sampling, seed }, &[1, 2, 4]);
        }
    }
}

/// Worked by hand on [0, 1], where C τ is 2, 9/4, 2 and τ is 1, 3/2, 2 at 0, ½, 1.
#[test]
fn values_worked_by_hand() {
    use Exponential::{Cubic, Linear, Quadratic};
    use Scope::{PerSegment, Whole};
    let cases = [
        // T(1) = 1 − 1 = 0, and the right end is all that is looked at.
        (
            Rule::RiemannLeft,
            Rule::RiemannRight,
            Linear,
            PerSegment,
            1,
            q(0, 1),
        ),
        // T(½) = 1 − ½, T(1) = ½ (1 − ¾): ½ (9/4 · ½ + 2 · ⅛).
        (
            Rule::RiemannLeft,
            Rule::RiemannRight,
            Linear,
            PerSegment,
            2,
            q(11, 16),
        ),
        // The whole depth: T(1) = 1 − 5/4: ½ (9/4 · ½ − 2 · ¼).
        (
            Rule::RiemannLeft,
            Rule::RiemannRight,
            Linear,
            Whole,
            2,
            q(5, 16),
        ),
        // Depth 3/2: T(1) = −½, ½ (2 − 1).
        (
            Rule::Trapezoid,
            Rule::Trapezoid,
            Linear,
            PerSegment,
            1,
            q(1, 2),
        ),
        // T(1) = 1 − 3/2 + 9/8 = 5/8, ½ (2 + 5/4).
        (
            Rule::Trapezoid,
            Rule::Trapezoid,
            Quadratic,
            PerSegment,
            1,
            q(13, 8),
        ),
        // T(1) = 5/8 − 27/48 = 1/16, ½ (2 + ⅛).
        (Rule::Simpson, Rule::Trapezoid, Cubic, Whole, 1, q(17, 16)),
        // Depths 5/8 and 7/8: T = 1, ⅜, 3/64; (2 + 4 · 9/4 · ⅜ + 2 · 3/64)/6.
        (
            Rule::Trapezoid,
            Rule::Simpson,
            Linear,
            PerSegment,
            2,
            q(175, 192),
        ),
        // Depth ½ τ(¼) = ⅝ at the middle: 9/4 · ⅜.
        (
            Rule::Midpoint,
            Rule::Midpoint,
            Linear,
            PerSegment,
            1,
            q(27, 32),
        ),
    ];
    let ramp = Ramp {
        length: q(1, 1),
        extinction: [q(1, 1), q(1, 1), q(0, 1)],
    };
    for (inner, outer, exponential, scope, n, expected) in cases {
        let nested = Nested {
            inner: Inner::PerSegment(inner),
            outer: Outer(outer),
            exponential,
            scope,
        };
        assert_eq!(by_method(nested, &ramp, n), expected, "{nested}, n = {n}");
    }
}
