//! Ways to approximate the volume rendering integral; each states its orders and their source.

mod attenuation;
mod breaks;
mod compositing;
mod error;
mod expected;
mod exponential;
mod inner;
mod layers;
mod level;
mod limit;
mod march;
mod name;
mod nested;
mod outer;
pub(crate) mod preintegrated;
mod rays;
mod stream;
mod theorem;

pub use attenuation::Attenuation;
pub use compositing::{
    Accumulation, Composite, Compositing, CompositingOrder, OpacityFormula, Position, Stop,
    Summation, Threshold,
};
pub use error::MethodError;
pub use expected::Expected;
#[cfg(feature = "studies")]
pub(crate) use exponential::{Alone, Depths, Exponentials, Row};
pub use exponential::{Exponential, Scope};
pub use inner::{Filling, Inner, OpticalDepth};
pub use layers::{Bezier, Degree, Layers, Limiter};
pub use level::Level;
pub use limit::{Limit, Part};
pub use name::MethodNameError;
pub use nested::Nested;
#[cfg(feature = "studies")]
pub(crate) use outer::GroupSums;
pub use outer::{Outer, Transmittances};
#[cfg(feature = "studies")]
pub(crate) use preintegrated::attenuated_integral;
pub use preintegrated::{
    Color, Integration, Interpolant, LastSegment, Opacity, Preintegrated, composite,
};
pub use rays::{RayError, RayMedium, composite_given, drawn_radiances, radiances};
pub use theorem::Theorem;

use crate::case::{AnyNodes, Case, Nodes, Number, Structure};
use crate::real::Format;
use std::fmt;

/// A way to approximate the volume rendering integral.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
    /// An inner rule under an outer rule.
    Nested(Nested),
    /// One sample a segment, and the over operator.
    Composited(Compositing),
    /// Segments integrated along an interpolated field.
    Preintegrated(Preintegrated),
    /// Layers between places where C and τ are known.
    Layered(Layers),
}

impl Method {
    /// The radiance on n segments of length D/n.
    ///
    /// # Errors
    /// [`MethodError`] where n does not suit the method, or the case lacks what the method needs.
    pub fn radiance<N: Nodes>(&self, nodes: &N, n: u64) -> Result<Number<N>, MethodError> {
        self.radiance_of_any(AnyNodes::new(nodes), n)
    }

    /// The same of nodes whose kind is not known: every method is compiled once a format, though cases and kinds of
    /// nodes are many. Where their loop is to be one with the evaluation of the case, a family's own
    /// `radiance` is there, such as [`Nested::radiance`].
    ///
    /// # Errors
    /// As [`Method::radiance`].
    pub fn radiance_of_any<F: Format>(
        &self,
        nodes: AnyNodes<'_, F>,
        n: u64,
    ) -> Result<F::Real, MethodError> {
        match self {
            Method::Nested(nested) => nested.radiance(&nodes, n),
            Method::Composited(compositing) => compositing.radiance(&nodes, n),
            Method::Preintegrated(preintegrated) => preintegrated.radiance(&nodes, n),
            Method::Layered(layers) => layers.radiance(&nodes, n),
        }
    }

    /// The radiance in one pass over the ray, with the same bits as [`Method::radiance`]: in memory that does not grow
    /// with n, where the method [streams](Method::streams) and `nodes` keep nothing, as those of
    /// [`Fresh`](crate::case::Fresh) do.
    ///
    /// # Errors
    /// As [`Method::radiance`].
    pub fn stream<F: Format>(
        &self,
        nodes: AnyNodes<'_, F>,
        n: u64,
    ) -> Result<F::Real, MethodError> {
        let in_one_pass = match self {
            Method::Nested(nested) => stream::radiance(nested, nodes, n),
            _ => None,
        };
        in_one_pass.unwrap_or_else(|| self.radiance_of_any(nodes, n))
    }

    /// Whether [`Method::stream`] keeps no ray: not where samples are composited from the far end, depths come of pairs
    /// of segments or of random places, or segments are pre-integrated.
    #[must_use]
    pub fn streams(&self) -> bool {
        match self {
            Method::Nested(nested) => stream::knows(nested),
            Method::Composited(compositing) => compositing.order != CompositingOrder::BackToFront,
            Method::Preintegrated(_) => false,
            Method::Layered(_) => true,
        }
    }

    /// Whether n segments suit the method's rules and interpolants.
    ///
    /// # Errors
    /// [`MethodError::Segments`] or [`MethodError::TooFewSegments`] where they do not.
    pub fn check_segments(&self, n: u64) -> Result<(), MethodError> {
        match self {
            Method::Nested(nested) => {
                let outer = nested.outer;
                error::require_multiple(&outer, n, outer.segments_multiple())?;
                let inner = nested.inner;
                error::require_multiple(&inner, n, inner.segments_multiple())
            }
            Method::Composited(compositing) => error::require_multiple(compositing, n, 1),
            Method::Layered(layers) => error::require_multiple(layers, n, 1),
            Method::Preintegrated(preintegrated) => {
                for interpolant in [
                    preintegrated.color.interpolant,
                    preintegrated.opacity.interpolant,
                ] {
                    interpolant.check_segments(n)?;
                }
                Ok(())
            }
        }
    }

    /// The order on smooth rays of which nothing else is known.
    #[must_use]
    pub fn order(&self) -> Expected {
        Expected::from_limits(&self.limits_of(&Structure::default()))
    }

    /// What limits the method's order on `case`, part by part, on whatever ladder: breaks of the medium are
    /// taken to lie off the nodes.
    #[must_use]
    pub fn limits<C: Case>(&self, case: &C) -> Vec<Limit> {
        self.limits_of(&case.structure())
    }

    fn limits_of(&self, structure: &Structure) -> Vec<Limit> {
        match self {
            Method::Nested(nested) => nested.limits(structure),
            Method::Composited(compositing) => compositing.limits(structure),
            Method::Preintegrated(preintegrated) => preintegrated.limits(structure),
            Method::Layered(layers) => layers.limits(structure),
        }
    }

    /// What limits the method's order on `case` on these numbers of segments, where breaks may lie on nodes
    /// or in other places that do no harm, at every level.
    #[must_use]
    pub fn limits_on<C: Case>(&self, case: &C, ladder: &[u64]) -> Vec<Limit> {
        let structure = case.structure();
        match self {
            Method::Nested(nested) => nested.limits_on(&structure, ladder),
            Method::Composited(compositing) => compositing.limits_on(&structure, ladder),
            Method::Preintegrated(preintegrated) => preintegrated.limits_on(&structure, ladder),
            Method::Layered(layers) => layers.limits_on(&structure, ladder),
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Method::Nested(nested) => nested.fmt(f),
            Method::Composited(compositing) => compositing.fmt(f),
            Method::Preintegrated(preintegrated) => preintegrated.fmt(f),
            Method::Layered(layers) => write!(f, "layers, {layers}"),
        }
    }
}

/// The order that theory gives `method` on `case`: min(p, q, what else the method approximates), less
/// what the case makes exact or blind. Where it is proved, [`Method::theorem`] names the proof. Breaks of the medium are
/// taken to lie off the nodes: see [`expected_on`].
#[must_use]
pub fn expected<C: Case>(method: &Method, case: &C) -> Expected {
    Expected::from_limits(&method.limits(case))
}

/// The order that theory gives `method` on `case` over these numbers of segments: that of [`expected`], or
/// a higher one where all levels have the case's breaks in places that do no harm. It is the order of the
/// largest errors: where a break moves within its segment from level to level, errors scatter below.
#[must_use]
pub fn expected_on<C: Case>(method: &Method, case: &C, ladder: &[u64]) -> Expected {
    Expected::from_limits(&method.limits_on(case, ladder))
}
