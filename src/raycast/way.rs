//! Methods that go in lanes.

use crate::method::{
    Accumulation, Compositing, CompositingOrder, Exponential, Inner, Method, Nested,
    OpacityFormula, Outer, Position, Scope, Summation,
};
use crate::quadrature::Rule;

/// A method that goes in lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    /// Front to back, a sample a segment.
    Composited {
        position: Position,
        opacity: OpacityFormula,
        depth: Accumulation,
    },
    /// The trapezoid rule for the depth and for the radiance.
    Trapezoid,
}

impl Way {
    /// The way of a method; `None` where it does not go in lanes.
    pub(super) fn of(method: &Method) -> Option<Way> {
        match *method {
            Method::Nested(Nested {
                inner: Inner::PerSegment(Rule::Trapezoid),
                outer: Outer(Rule::Trapezoid),
                exponential: Exponential::Exact,
                scope: Scope::Whole,
            }) => Some(Way::Trapezoid),
            Method::Composited(Compositing {
                position,
                opacity:
                    opacity @ (OpacityFormula::Subtraction
                    | OpacityFormula::Expm1
                    | OpacityFormula::Linear),
                order:
                    CompositingOrder::FrontToBack {
                        depth,
                        summation: Summation::Naive,
                        stop: None,
                    },
            }) => Some(Way::Composited {
                position,
                opacity,
                depth,
            }),
            _ => None,
        }
    }

    /// Where in its segment a sample lies, in parts of it.
    pub(super) fn offset(self) -> f64 {
        match self {
            Way::Trapezoid => 0.0,
            Way::Composited { position, .. } => match position {
                Position::Front => 0.0,
                Position::Middle => 0.5,
                Position::Back => 1.0,
            },
        }
    }

    /// How many samples rays of at most so many segments have.
    pub(super) fn samples(self, segments: usize) -> usize {
        match self {
            Way::Trapezoid => segments + 1,
            Way::Composited { .. } => segments,
        }
    }
}
