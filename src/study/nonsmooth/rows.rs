//! The rules and the cases of the table.

use crate::method::{Exponential, Inner, Method, Nested, Outer, Scope};
use crate::quadrature::Rule;
use serde::Serialize;

/// What breaks at one place of the ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The extinction jumps.
    Jump,
    /// The extinction has a corner.
    Kink,
}

/// Where it breaks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// At D/2: on a node of every level.
    OnNode,
    /// At D/3: on no node of any level, a third or two thirds into its segment.
    OffNodes,
    /// At √⅓·D: in another place of its segment at every level.
    Moving,
}

impl Kind {
    /// Both.
    pub const ALL: [Kind; 2] = [Kind::Jump, Kind::Kink];

    /// The heading of a report.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Kind::Jump => "Jump of the extinction",
            Kind::Kink => "Kink of the extinction",
        }
    }
}

impl Place {
    /// All of them.
    pub const ALL: [Place; 3] = [Place::OnNode, Place::OffNodes, Place::Moving];

    /// Its name in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Place::OnNode => "on-node",
            Place::OffNodes => "off-nodes",
            Place::Moving => "moving",
        }
    }

    /// The heading of a report.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Place::OnNode => "on a node (D/2)",
            Place::OffNodes => "off the nodes (D/3)",
            Place::Moving => "moving (√⅓ D)",
        }
    }
}

/// The case of the catalogue that breaks so and there.
#[must_use]
pub(super) fn case_name(kind: Kind, place: Place) -> &'static str {
    match (kind, place) {
        (Kind::Jump, Place::OnNode) => "jump-on-node",
        (Kind::Jump, Place::OffNodes) => "jump-off-node",
        (Kind::Jump, Place::Moving) => "jump-moving",
        (Kind::Kink, Place::OnNode) => "kink-on-node",
        (Kind::Kink, Place::OffNodes) => "kink-off-node",
        (Kind::Kink, Place::Moving) => "kink-moving",
    }
}

/// The rows: name, inner rule, outer rule. One rule inside and outside, but for Boole's, which stands over
/// Gauss–Legendre as in the paper's Table 1, and Riemann's, which looks ahead outside as there.
const ROWS: [(&str, Rule, Rule); 6] = [
    ("riemann", Rule::RiemannLeft, Rule::RiemannRight),
    ("midpoint", Rule::Midpoint, Rule::Midpoint),
    ("trapezoid", Rule::Trapezoid, Rule::Trapezoid),
    ("simpson", Rule::Simpson, Rule::Simpson),
    ("boole", Rule::GaussLegendre(3), Rule::Boole),
    ("gauss-3", Rule::GaussLegendre(3), Rule::GaussLegendre(3)),
];

/// The methods of the rows, by name.
pub(super) fn rows() -> [(&'static str, Method); 6] {
    ROWS.map(|(name, inner, outer)| {
        let method = Method::Nested(Nested {
            inner: Inner::PerSegment(inner),
            outer: Outer(outer),
            exponential: Exponential::Exact,
            scope: Scope::Whole,
        });
        (name, method)
    })
}
