//! What was found out about a kernel, and how well it is known.

use super::rule::{self, Place, Rule};
use super::scattered::Scattered;
use super::{
    Accumulation, Exponential, HoldOut, NotIdentified, Optics, Spent, State, Transmittance,
};
use crate::method::Method;

/// What was found out about a kernel.
#[derive(Clone, Debug, Default)]
pub struct Identification {
    /// What answers depend on beside the question; `None` where that could not be seen.
    pub state: Option<State>,
    /// Parts that hold by themselves.
    pub parts: Parts,
    /// The whole rule.
    pub rule: Option<Rule>,
    /// The method that states no rule and has all the answers.
    pub method: Option<Method>,
    /// What a kernel that draws random numbers does.
    pub scattered: Option<Scattered>,
    /// What a kernel reads of a volume, to which the rule is applied as to middles of segments.
    pub optics: Option<Optics>,
    /// Between what its parameters lie.
    pub brackets: Vec<Bracket>,
    /// The rule against rays that it was not found with.
    pub hold_out: HoldOut,
    /// What could not be read off.
    pub not_identified: Vec<NotIdentified>,
    /// In what order contributions are added.
    pub accumulation: Option<Accumulation>,
    /// How transmittances are kept, where answers tell that.
    pub transmittance: Option<Transmittance>,
    /// By how much exponentials are off, where that was seen.
    pub exponential: Option<Exponential>,
    /// What it cost.
    pub spent: Spent,
}

impl Identification {
    /// The rule, where it holds on rays of every kind.
    #[must_use]
    pub fn named(&self) -> Option<&Rule> {
        self.rule.as_ref().filter(|_| self.hold_out.is_whole())
    }
}

/// What was seen of a kernel whether or not the whole rule was.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Parts {
    /// From radiance to answer.
    pub output: Option<rule::Output>,
    /// Whose answer stands where.
    pub channels: Option<rule::Channels>,
    /// The largest part of an answer that rounding takes, by the fewest digits that hold all of them.
    pub unit: Option<f64>,
    /// By what answers to the same question differ.
    pub noise: f64,
    /// The relative precision of what one segment lets through, where it is coarser than that of the answers.
    pub grain: f64,
    /// Transmittances are 1 less the opacity so far, and rounded to a unit of 1.
    pub subtracts: bool,
    /// Where one sample a segment lies.
    pub place: Option<Place>,
    /// Rays, or segments, that hold nothing have no finite answer.
    pub vacuum_fails: Option<VacuumFails>,
}

/// Where nothing absorbs there is no answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VacuumFails {
    /// To a ray that holds nothing.
    Ray,
    /// To a ray with an empty segment.
    Segment,
}

/// A parameter, and between what it lies.
#[derive(Clone, Debug, PartialEq)]
pub struct Bracket {
    /// Which.
    pub parameter: Parameter,
    /// At least.
    pub low: f64,
    /// At most.
    pub high: f64,
}

impl Bracket {
    pub(super) fn of(parameter: Parameter, (low, high): (f64, f64)) -> Self {
        Bracket {
            parameter,
            low,
            high,
        }
    }
}

/// A parameter of a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parameter {
    /// κ.
    Factor,
    /// The weights' scale.
    Scale,
    /// The early end's threshold.
    Stop,
    /// What is added to what is let through.
    Eps,
    /// The emission behind the ray.
    Background,
    /// What is added.
    Offset,
    /// The wall's length.
    Wall,
    /// The factor of the weight's own depth.
    Weight,
    /// The opacity under which a sample counts for nothing.
    Skip,
    /// The extinction under which it does.
    SkipExtinction,
    /// The largest opacity.
    OpacityClamp,
    /// The largest depth of a segment.
    DepthClamp,
    /// The largest extinction.
    ExtinctionClamp,
    /// The largest opacity that is not corrected for the step.
    Uncorrected,
    /// The depth below which a series is taken.
    Series,
    /// The step of a table of opacities.
    TableStep,
    /// The exponent of the answers.
    Gamma,
    /// The largest emission that counts as it is.
    EmissionHigh,
}
