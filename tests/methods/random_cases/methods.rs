//! Random methods for quickcheck.

use quickcheck::{Arbitrary, Gen};
use volver::case::Case;
use volver::method::{
    Accumulation, Color, Compositing, CompositingOrder, Exponential, Filling, Inner, Integration,
    Interpolant, LastSegment, Method, Nested, Opacity, OpacityFormula, Outer, Position,
    Preintegrated, Scope, Summation,
};
use volver::quadrature::Rule;

/// A method, as far as it does not depend on the case.
#[derive(Clone, Debug)]
pub(super) enum Choice {
    Nested(Nested),
    Composited(Compositing),
    /// Its integrals are closed where the case allows that, otherwise by the rules given.
    Preintegrated {
        method: Preintegrated,
        closed: bool,
    },
}

impl Choice {
    pub(super) fn method<C: Case>(&self, case: &C) -> Method {
        match self {
            Choice::Nested(nested) => Method::Nested(*nested),
            Choice::Composited(compositing) => Method::Composited(*compositing),
            Choice::Preintegrated { method, closed } => {
                let mut method = *method;
                if *closed && case.structure().transfer.is_some() {
                    method.color.integration = Integration::Closed;
                    method.opacity.integration = Integration::Closed;
                }
                Method::Preintegrated(method)
            }
        }
    }
}

impl Arbitrary for Choice {
    fn arbitrary(g: &mut Gen) -> Choice {
        match u8::arbitrary(g) % 16 {
            0..4 => {
                return Choice::Preintegrated {
                    method: preintegrated(g),
                    closed: bool::arbitrary(g),
                };
            }
            4..7 => return Choice::Composited(compositing(g)),
            _ => {}
        }
        let exponentials = [
            Exponential::Exact,
            Exponential::Exact,
            Exponential::Exact,
            Exponential::Linear,
            Exponential::Quadratic,
            Exponential::Cubic,
        ];
        let exponential = of(g, &exponentials);
        let scope = match exponential {
            Exponential::Exact => of(g, &[Scope::Whole, Scope::PerSegment]),
            // Of the whole depth it converges to something else.
            _ => Scope::PerSegment,
        };
        Choice::Nested(Nested {
            inner: inner(g),
            outer: Outer(outer(g)),
            exponential,
            scope,
        })
    }

    /// Exact parts do not come into it.
    fn shrink(&self) -> Box<dyn Iterator<Item = Choice>> {
        match self {
            Choice::Nested(nested) if nested.exponential != Exponential::Exact => {
                let exponential = Exponential::Exact;
                Box::new(std::iter::once(Choice::Nested(Nested {
                    exponential,
                    ..*nested
                })))
            }
            _ => Box::new(std::iter::empty()),
        }
    }
}

fn of<T: Clone>(g: &mut Gen, all: &[T]) -> T {
    g.choose(all).unwrap().clone()
}

fn inner(g: &mut Gen) -> Inner {
    let rules = [
        Rule::RiemannLeft,
        Rule::RiemannRight,
        Rule::Midpoint,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::GaussLegendre(2),
        Rule::GaussLegendre(3),
        Rule::GaussLegendre(4),
    ];
    match u8::arbitrary(g) % 10 {
        0 => Inner::SimpsonPairs(Filling::Parabola),
        1 => Inner::SimpsonPairs(Filling::Trapezoid),
        2 => Inner::BooleFours,
        _ => Inner::PerSegment(of(g, &rules)),
    }
}

fn outer(g: &mut Gen) -> Rule {
    let rules = [
        Rule::RiemannLeft,
        Rule::RiemannRight,
        Rule::Midpoint,
        Rule::Trapezoid,
        Rule::Simpson,
        Rule::Boole,
        Rule::GaussLegendre(2),
        Rule::GaussLegendre(3),
    ];
    of(g, &rules)
}

fn compositing(g: &mut Gen) -> Compositing {
    let orders = [
        CompositingOrder::BackToFront,
        CompositingOrder::Tree,
        CompositingOrder::FrontToBack {
            depth: of(
                g,
                &[
                    Accumulation::Transmittances,
                    Accumulation::Depths,
                    Accumulation::Remainder,
                ],
            ),
            summation: Summation::Naive,
            stop: None,
        },
    ];
    let opacities = [
        OpacityFormula::Subtraction,
        OpacityFormula::Expm1,
        OpacityFormula::Relative,
        OpacityFormula::Linear,
    ];
    Compositing {
        position: of(g, &[Position::Front, Position::Middle, Position::Back]),
        opacity: of(g, &opacities),
        order: of(g, &orders),
    }
}

fn preintegrated(g: &mut Gen) -> Preintegrated {
    let mut interpolant = || {
        let all = [
            Interpolant::Linear,
            Interpolant::Quadratic(LastSegment::Beyond),
            Interpolant::Quadratic(LastSegment::Backward),
            Interpolant::QuadraticMidpoint,
        ];
        of(g, &all)
    };
    let (source, opacity) = (interpolant(), interpolant());
    let mut integration = || Integration::SubIntervals {
        count: of(g, &[1, 2, 3]),
        rule: outer(g),
    };
    let integrations = (integration(), integration());
    Preintegrated {
        color: Color {
            interpolant: source,
            attenuated: u8::arbitrary(g) % 8 != 0,
            integration: integrations.0,
        },
        opacity: Opacity {
            interpolant: opacity,
            integration: integrations.1,
        },
    }
}
