//! Rays or channels side by side, in the format of [lanes](crate::real::lanes): the same numbers as each ray by itself.

// What takes lanes must be inlined into the function that has the instructions.
#![allow(clippy::inline_always)]

mod drawn;
mod given;
mod march;

pub use drawn::drawn_radiances;
pub use given::composite_given;

use super::{
    Accumulation, Compositing, CompositingOrder, Exponential, Inner, Method, MethodError, Nested,
    OpacityFormula, Outer, Position, Scope, Summation,
};
use crate::case::Transfer;
use crate::quadrature::Rule;
use crate::real::lanes::{LaneFloat, Lanes, Width};
use rug::Rational;

/// C and τ along many rays of one length.
pub trait RayMedium<T> {
    /// C and τ at λ of as many rays as there are lanes, from that one on. It must be `#[inline(always)]`, as all that takes
    /// lanes.
    fn transfer<L: Lanes<Element = T>>(&self, ray: usize, lambda: L) -> Transfer<L>;
}

/// Why rays do not go side by side.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum RayError {
    /// A method that chooses or keeps what lanes do not.
    #[error(
        "method {method} does not go in lanes (allowed: trapezoid/trapezoid, midpoint/trapezoid, front-to-back/POSITION/OPACITY[/depths|/remainder] with subtraction, expm1 or linear)"
    )]
    Method {
        /// Its name.
        method: String,
    },
    /// A method that draws no samples, or goes on with them in a way of its own.
    #[error(
        "method {method} does not draw in lanes (allowed: SAMPLING@SEED/RULE with monte-carlo, monte-carlo-independent or monte-carlo-stratified, by riemann-left, riemann-right, trapezoid, simpson or boole)"
    )]
    Undrawn {
        /// Its name.
        method: String,
    },
    /// A number of segments that the method does not take.
    #[error(transparent)]
    Segments(#[from] MethodError),
    /// Samples that are none of so many rays.
    #[error(
        "{colors} colours and {opacities} opacities of {rays} rays (allowed: as many of each, a multiple of {rays})"
    )]
    Samples {
        /// How many colours there are.
        colors: usize,
        /// How many opacities.
        opacities: usize,
        /// Of how many rays.
        rays: usize,
    },
}

/// A method that goes in lanes.
#[derive(Clone, Copy)]
enum Way {
    /// The trapezoid rule in a rule of one segment's ends or its middle.
    Nested { middle: bool },
    /// Front to back.
    Composited {
        position: Position,
        opacity: OpacityFormula,
        depth: Accumulation,
    },
}

/// The radiance of each of `rays` rays of that length on n segments, as many side by side as [`Width::current`] says: bit for
/// bit that of [`Method::radiance`] in the lanes' format.
///
/// # Errors
/// [`RayError`] where the method does not go in lanes, or not on n segments.
pub fn radiances<T: LaneFloat, M: RayMedium<T>>(
    method: &Method,
    medium: &M,
    length: &Rational,
    n: u64,
    rays: usize,
) -> Result<Vec<T>, RayError> {
    let way = way(method).ok_or_else(|| RayError::Method {
        method: method.name(),
    })?;
    method.check_segments(n)?;
    let ray = march::Ray::new(way, length, n);
    let mut radiances = vec![T::ZERO; rays];
    side_by_side(rays, |width, from, to| {
        width.with(march::March {
            ray: &ray,
            medium,
            first: from,
            radiances: &mut radiances[from..to],
        });
    });
    Ok(radiances)
}

/// The way of a method; `None` where it does not go in lanes.
fn way(method: &Method) -> Option<Way> {
    match *method {
        Method::Nested(Nested {
            inner: Inner::PerSegment(inner @ (Rule::Trapezoid | Rule::Midpoint)),
            outer: Outer(Rule::Trapezoid),
            exponential: Exponential::Exact,
            scope: Scope::Whole,
        }) => Some(Way::Nested {
            middle: inner == Rule::Midpoint,
        }),
        Method::Composited(Compositing {
            position,
            opacity:
                opacity @ (OpacityFormula::Subtraction | OpacityFormula::Expm1 | OpacityFormula::Linear),
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

/// Calls `work` with a width and a row of rays, of which there are a multiple of that width: the widest first.
fn side_by_side(rays: usize, mut work: impl FnMut(Width, usize, usize)) {
    let current = Width::current();
    let mut from = 0;
    for width in Width::ALL.into_iter().rev() {
        let to = rays - (rays - from) % usize::from(width.lanes());
        if width <= current && width.is_there() && to > from {
            work(width, from, to);
            from = to;
        }
    }
}
