//! The methods that are put to the test: those whose roundoff is bounded beforehand.

use super::StressError;
use crate::method::{
    Color, Compositing, CompositingOrder, Exponential, Inner, Integration, Interpolant, Method,
    Nested, Opacity, Outer, Preintegrated, Scope,
};
use crate::quadrature::Rule;

/// The methods of the default grid.
pub const METHODS: [&str; 11] = [
    "trapezoid/trapezoid",
    "simpson/simpson",
    "front-to-back/middle/subtraction",
    "front-to-back/middle/expm1",
    "front-to-back/middle/expm1/depths",
    "front-to-back/middle/expm1/depths/neumaier",
    "front-to-back/middle/linear",
    "back-to-front/middle/expm1",
    "tree/middle/expm1",
    "preintegrated/linear/linear",
    "preintegrated/linear-by-8-trapezoid/linear-by-8-trapezoid",
];

/// What a bound has to know of a method.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The trapezoid rule in the trapezoid rule.
    Trapezoid,
    /// Simpson's rule in Simpson's rule.
    Simpson,
    /// Compositing without a threshold.
    Composited(Compositing),
    /// Pre-integration of a linear field in closed form.
    ClosedSegments,
    /// Pre-integration of a linear field by so many trapezoids a segment.
    SubIntervals(u32),
}

impl Kind {
    /// The kind of a method.
    ///
    /// # Errors
    /// [`StressError::Method`] where no bound is known for it.
    pub fn of(method: &Method) -> Result<Kind, StressError> {
        known(method).ok_or_else(|| StressError::Method {
            name: method.name(),
        })
    }
}

fn known(method: &Method) -> Option<Kind> {
    match *method {
        Method::Nested(Nested {
            inner: Inner::PerSegment(inner),
            outer: Outer(outer),
            exponential: Exponential::Exact,
            scope: Scope::Whole,
        }) => match (inner, outer) {
            (Rule::Trapezoid, Rule::Trapezoid) => Some(Kind::Trapezoid),
            (Rule::Simpson, Rule::Simpson) => Some(Kind::Simpson),
            _ => None,
        },
        Method::Composited(compositing) => {
            let stops = matches!(
                compositing.order,
                CompositingOrder::FrontToBack { stop: Some(_), .. }
            );
            (!stops).then_some(Kind::Composited(compositing))
        }
        Method::Preintegrated(Preintegrated {
            color:
                Color {
                    interpolant: Interpolant::Linear,
                    attenuated: true,
                    integration: color,
                },
            opacity:
                Opacity {
                    interpolant: Interpolant::Linear,
                    integration: opacity,
                },
        }) if color == opacity => match color {
            Integration::Closed => Some(Kind::ClosedSegments),
            Integration::SubIntervals {
                count: count @ 1..=256,
                rule: Rule::Trapezoid,
            } => Some(Kind::SubIntervals(count)),
            Integration::SubIntervals { .. } => None,
        },
        Method::Nested(_) | Method::Preintegrated(_) | Method::Layered(_) => None,
    }
}
