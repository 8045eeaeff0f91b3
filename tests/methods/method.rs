//! Methods as a whole: their orders, their refusals and their names.

mod breaks;
mod limits;
mod orders;
mod preintegrated;
mod refusals;
mod series;
mod theorem;

use volver::case::HomogeneousSlab;
use volver::method::{
    Color, Exponential, Filling, Inner, Integration, Interpolant, LastSegment, Method, Nested,
    Opacity, Outer, Preintegrated, Scope,
};
use volver::quadrature::{Rule, Sampling};

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
