//! Methods by name, as on a command line: `gauss-3/boole`, `front-to-back/middle/expm1`.

mod compositing;
mod error;
mod nested;
mod parts;
mod preintegrated;

pub use error::MethodNameError;

use super::{Layers, Method};
use parts::Parts;
use std::str::FromStr;

/// What a name may begin with that is no inner rule.
const KINDS: &str = "preintegrated, front-to-back, back-to-front, tree, layers";

impl Method {
    /// The method's name, which [`Method::from_str`] reads back.
    ///
    /// - Nested rules: `INNER/OUTER[/EXPONENTIAL]` with the rules' names for both, for INNER also
    ///   `simpson-pairs-parabola`, `simpson-pairs-trapezoid`, `boole-fours`, `monte-carlo@SEED`,
    ///   `monte-carlo-independent@SEED` and `monte-carlo-stratified@SEED`. EXPONENTIAL is `exact` (left out) or
    ///   `exact-per-segment`; `linear`, `quadratic` and `cubic` are those of each segment, `linear-whole` and so
    ///   on those of the whole depth.
    /// - Compositing: `front-to-back/POSITION/OPACITY[/depths|/remainder][/pairwise|/neumaier][/stop=1:255]`,
    ///   `back-to-front/POSITION/OPACITY`, `tree/POSITION/OPACITY` with POSITION `front`, `middle` or `back` and
    ///   OPACITY `subtraction`, `expm1`, `relative` or `linear`.
    /// - Pre-integration: `preintegrated/COLOR/OPACITY[/unattenuated]`; both are
    ///   `INTERPOLANT[-by-COUNT-RULE]`, in closed form where no rule is named:
    ///   `preintegrated/quadratic-by-10-trapezoid/linear`.
    /// - Layers: `layers/RULE` with the names of [`Layers::ALL`](super::Layers::ALL): `layers/half-own`.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Method::Nested(nested) => nested::name(nested),
            // Its name is how it prints.
            Method::Composited(compositing) => compositing.to_string(),
            Method::Preintegrated(preintegrated) => preintegrated::name(preintegrated),
            Method::Layered(layers) => format!("layers/{layers}"),
        }
    }
}

impl FromStr for Method {
    type Err = MethodNameError;

    fn from_str(name: &str) -> Result<Self, MethodNameError> {
        let mut parts = Parts::new(name);
        let kind = parts.next("inner rule or kind of method", || {
            format!("{}, {KINDS}", nested::inner_names())
        })?;
        let method = match kind {
            "preintegrated" => Method::Preintegrated(preintegrated::parse(&mut parts)?),
            "front-to-back" | "back-to-front" | "tree" => {
                Method::Composited(compositing::parse(kind, &mut parts)?)
            }
            "layers" => Method::Layered(parts.one_of("rule of layers", &Layers::ALL)?),
            inner => Method::Nested(nested::parse(inner, &mut parts)?),
        };
        parts.end()?;
        Ok(method)
    }
}
