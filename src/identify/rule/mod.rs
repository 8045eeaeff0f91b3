//! The discrete rule that a kernel computes: an explicit formula that answers any ray in any format.
//!
//! y = G(b + β T + F Σₖ Tₖ wₖ Cₖ), Tₖ = Π_{j<k} pⱼ, over the samples k in the order in which they are taken;
//! wₖ and pₖ come from the [`Scheme`], which samples are taken from the [`Sequence`], F from [`Whole`], G from
//! [`Output`].

mod c;
mod composed;
mod depth;
mod json;
mod kernel;
mod latex;
mod lattice;
mod law;
mod linear;
mod output;
mod program;
mod python;
mod range;
mod scheme;
mod seam;
mod sequence;
mod text;

pub use composed::{Composed, Node};
pub use depth::{Depth, Power};
pub use kernel::RuleKernel;
pub(super) use lattice::plus;
pub use lattice::{Along, Count, Lattice};
pub use law::{Formula, Law, Scale, Shape, Weight};
pub use linear::LinearSegments;
pub use output::{Channels, Curve, Output};
pub use range::{Quantised, Range, Series, Step, Table};
pub(super) use scheme::Three;
pub use scheme::{Place, Scheme, Segment};
pub use seam::{At, Blocks, Effect, Seam, Which};
pub use sequence::{End, Extra, LastStep, Sequence};
use serde::{Deserialize, Serialize};

/// What a kernel computes of a ray.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rule {
    /// What one segment adds and lets through.
    pub scheme: Scheme,
    /// Where samples lie, where they lie at no ends or middles of segments: the rule is that of the middles of segments
    /// between which such a kernel's samples lie.
    pub lattice: Option<Lattice>,
    /// Which segments are taken, in what order.
    pub sequence: Sequence,
    /// Where the ray ends before its end.
    pub stop: Option<Stop>,
    /// What stands behind the last sample.
    pub wall: Option<Wall>,
    /// What the whole radiance is multiplied by.
    pub whole: Whole,
    /// From the emission given to the one that counts.
    pub emission: Curve,
    /// The largest emission that counts as it is.
    pub emission_max: Option<f64>,
    /// The smallest one.
    pub emission_min: Option<f64>,
    /// The emission behind the ray, seen through it.
    pub background: f64,
    /// What is added whatever the ray.
    pub offset: f64,
    /// From radiance to answer.
    pub output: Output,
    /// Whose answer stands where.
    pub channels: Channels,
}

/// A ray that ends before its end.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stop {
    /// What is compared.
    pub by: StopBy,
    /// Under what the ray ends; from what on, where that is a sum.
    pub under: f64,
    /// The sample that takes it under is left out.
    pub before: bool,
    /// The sample that takes the transmittance under the threshold takes it to the threshold only, and weighs as much
    /// less: the optical depth of the ray is cut off.
    pub cut: bool,
    /// The radiance is divided by the opacity that was reached.
    pub renormalised: bool,
}

/// What decides that a ray ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StopBy {
    /// The transmittance behind the sample.
    Transmittance,
    /// The sample's weight.
    Weight,
    /// The sum of what samples weigh by themselves, as if nothing were in front of them.
    Sum,
}

/// What takes the place of the last segment.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Wall {
    /// The last segment is opaque where it absorbs anything.
    Opaque,
    /// The last sample's emission shines behind the ray.
    LastEmission,
    /// The last segment counts as so long.
    Length(f64),
}

/// A factor of the radiance that depends on the whole ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Whole {
    /// 1.
    #[default]
    One,
    /// 1/(1 − T), T the ray's transmittance.
    ByOpacity,
    /// 1 − T.
    TimesOpacity,
}
