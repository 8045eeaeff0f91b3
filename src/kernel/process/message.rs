//! The messages, as `docs/protocol.md` has them. What is said of a field here stands in the schema.

use super::number::Number;
use super::written::{Array, Numbers, Written};
use crate::kernel::{DepthWeights, GradientAt, InnerProduct, Quantity, Sampling, Source};
#[cfg(feature = "studies")]
use schemars::JsonSchema;
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer, Serialize};
use serde_json::Value;

/// What a greeting says that it is.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum HelloTag {
    Hello,
}

/// What a request says that it is.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum RenderTag {
    Render,
}

/// What an answer says that it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum AnswerTag {
    /// Of version 1.
    Radiance,
    /// Of version 2.
    Answer,
}

/// The first message of all, from volver.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema))]
pub(super) struct VolverHello {
    #[serde(rename = "type")]
    pub(super) tag: HelloTag,
    /// The version of the protocol.
    #[cfg_attr(feature = "studies", schemars(extend("const" = super::VERSION)))]
    pub(super) protocol: u64,
    /// The versions that a kernel may answer with.
    pub(super) protocols: [u64; 2],
    /// Who asks, for logs.
    pub(super) program: &'static str,
}

/// The kernel's answer to it: what it says of itself.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct KernelHello {
    #[serde(rename = "type")]
    #[expect(dead_code, reason = "there is no other value")]
    tag: HelloTag,
    /// The version of the protocol that it keeps to.
    #[cfg_attr(feature = "studies", schemars(extend("enum" = super::VERSIONS)))]
    #[expect(dead_code, reason = "checked before the other keys are looked at")]
    protocol: u64,
    /// Its name, for reports.
    #[cfg_attr(feature = "studies", schemars(length(min = 1, max = 100)))]
    pub(super) name: String,
    /// What it is to be given.
    pub(super) form: Form,
    /// The language of the source code it is to be given; with the form `formula`, and only there.
    pub(super) language: Option<WireLanguage>,
    /// The method of volver that it means to be, by its name, such as front-to-back/front/subtraction.
    pub(super) method: Option<String>,
    /// The order of accuracy that it claims on smooth cases; a method says more.
    pub(super) order: Option<Number>,
    /// The format that it computes in, by volver's name: f32, f64, mpfr:128 …; f64 unless given.
    pub(super) format: Option<String>,
    /// The format that its answers are rounded to at the end, where that is another one. Of version 2.
    pub(super) output: Option<String>,
    /// What its answers are multiples of, in the units of the radiance, where that is coarser than the format; in version 2
    /// also as a part of the largest |C| of the ray.
    pub(super) quantum: Option<NumberOr<WireRelative>>,
    /// By how many units in the last place e^x may be off, where that is more than rounding. Of version 2.
    pub(super) exp_ulp: Option<NumberOr<WireUlp>>,
    /// The same of e^x − 1. Of version 2.
    pub(super) expm1_ulp: Option<NumberOr<WireUlp>>,
    /// The same of powers b^d, x being d log₂ b. Of version 2.
    pub(super) pow_ulp: Option<NumberOr<WireUlp>>,
    /// `lost`: numbers below the smallest normal one of the format may be 0. Kept unless given. Of version 2.
    pub(super) subnormals: Option<WireSubnormals>,
    /// By so much its answers may be off by chance, in the units of the answer. Of version 2.
    pub(super) noise: Option<Number>,
    /// How many channels every task has to have; any unless given. Of version 2.
    #[cfg_attr(feature = "studies", schemars(range(min = 1)))]
    pub(super) channels: Option<u64>,
    /// `positive`: it takes no emission below 0. Any unless given. Of version 2.
    pub(super) emission: Option<WireEmission>,
    /// What its tasks have for emission: C, per `depth`, or C·τ, per `length`; with the form `segments`. C unless given. Of
    /// version 2.
    pub(super) source: Option<WireSource>,
    /// Monte Carlo: the answer depends on the seed, and scatters.
    #[serde(default)]
    pub(super) stochastic: bool,
    /// Where it samples a segment, where the method does not say.
    pub(super) sampling: Option<WireSampling>,
    /// Which numbers of segments it works on; any unless given.
    pub(super) segments: Option<WireSegments>,
    /// `divides`: it works where the step divides the ray alone. Any step unless given.
    pub(super) step: Option<WireStep>,
    /// It takes the last segment to be opaque: a wall of the last sample's emission stands at the end of the ray.
    #[serde(default)]
    pub(super) far_wall: bool,
    /// It takes a background, and is given one with every task. Of version 2.
    pub(super) background: Option<bool>,
    /// What it answers of every ray, at least one; the radiance unless given. Of version 2.
    #[cfg_attr(feature = "studies", schemars(length(min = 1)))]
    pub(super) answers: Option<Vec<WireQuantity>>,
    /// What its expected depth is divided by, where that is among the answers: by nothing unless given. Of version 2.
    pub(super) expected_depth: Option<WireDepthWeights>,
    /// It answers gradients too, by the values there; of segments alone. Of version 2.
    pub(super) gradient: Option<WireGradientAt>,
    /// A projector: its gradients are those of y times the optical depth, which is the adjoint in that inner product of the
    /// values. Of version 2.
    pub(super) adjoint: Option<WireInnerProduct>,
    /// So many rays at once it takes, as frames and not as text; of segments alone. Of version 2.
    #[cfg_attr(feature = "studies", schemars(range(min = 1, max = 1_000_000)))]
    pub(super) batch: Option<u64>,
    /// How volver is to write numbers.
    #[serde(default)]
    pub(super) numbers: Numbers,
    /// Where volver is to put arrays: into the message, or into files as numpy.save writes them.
    #[serde(default)]
    pub(super) arrays: Arrays,
}

/// The form in which a kernel wants its ray.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum Form {
    Segments,
    Volume,
    Formula,
}

/// The language of source code.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum WireLanguage {
    Python,
    C,
    Rust,
}

/// Where a kernel samples its segments.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum WireSampling {
    Front,
    Middle,
    Back,
    Ends,
    Jittered,
}

/// Which numbers of segments a kernel works on.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(deny_unknown_fields, expecting = "an object with the key multiple_of")]
pub(super) struct WireSegments {
    /// Multiples of this.
    #[cfg_attr(feature = "studies", schemars(range(min = 1)))]
    pub(super) multiple_of: u64,
}

/// Which steps a kernel works with.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum WireStep {
    Divides,
}

/// A part of the largest |C| of a ray.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(deny_unknown_fields)]
pub(super) struct WireRelative {
    /// The part.
    pub(super) relative: Number,
}

/// A bound a + b |x|, in units in the last place.
#[derive(Clone, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(deny_unknown_fields)]
pub(super) struct WireUlp {
    /// a.
    pub(super) a: Number,
    /// b; 0 unless given.
    pub(super) b: Option<Number>,
}

/// A number, or an object that says more.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(untagged, inline))]
pub(super) enum NumberOr<T> {
    Number(Number),
    Object(T),
}

// Derived, it would say of what is neither no more than that it is neither.
impl<'de, T: DeserializeOwned> Deserialize<'de> for NumberOr<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Value::deserialize(deserializer)?;
        match value {
            Value::Object(_) => serde_json::from_value(value).map(NumberOr::Object),
            _ => serde_json::from_value(value).map(NumberOr::Number),
        }
        .map_err(D::Error::custom)
    }
}

/// What becomes of numbers below the smallest normal one.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum WireSubnormals {
    Lost,
}

/// Which emissions a kernel takes.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum WireEmission {
    Positive,
}

/// Per what an emission is.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum WireSource {
    Depth,
    Length,
}

impl From<WireSource> for Source {
    fn from(source: WireSource) -> Self {
        match source {
            WireSource::Depth => Source::Depth,
            WireSource::Length => Source::Length,
        }
    }
}

/// What a kernel may answer of a ray.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "snake_case")]
pub(super) enum WireQuantity {
    Radiance,
    Opacity,
    OpticalDepth,
    ExpectedDepth,
}

/// What an expected depth is divided by.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "kebab-case")]
pub(super) enum WireDepthWeights {
    Plain,
    ByOpacity,
}

/// Where the values lie by which a kernel differentiates.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum WireGradientAt {
    Middles,
    Edges,
}

impl From<WireGradientAt> for GradientAt {
    fn from(at: WireGradientAt) -> Self {
        match at {
            WireGradientAt::Middles => GradientAt::Middles,
            WireGradientAt::Edges => GradientAt::Edges,
        }
    }
}

/// The inner product of values.
#[derive(Clone, Copy, Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum WireInnerProduct {
    Plain,
    Lengths,
}

impl From<WireInnerProduct> for InnerProduct {
    fn from(product: WireInnerProduct) -> Self {
        match product {
            WireInnerProduct::Plain => InnerProduct::Plain,
            WireInnerProduct::Lengths => InnerProduct::Lengths,
        }
    }
}

/// The derivatives of Σₖ aₖ Iₖ, aₖ being the task's cotangents, by its numbers.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(rename = "Gradient"))]
#[serde(deny_unknown_fields)]
pub(super) struct WireGradient {
    /// By τ at the places declared.
    pub(super) extinction: Vec<Number>,
    /// By C of every channel there; of a projector none.
    #[serde(default)]
    pub(super) emission: Vec<Vec<Number>>,
}

/// Where arrays stand.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(super) enum Arrays {
    #[default]
    Json,
    Npy,
}

impl From<WireQuantity> for Quantity {
    fn from(quantity: WireQuantity) -> Self {
        match quantity {
            WireQuantity::Radiance => Quantity::Radiance,
            WireQuantity::Opacity => Quantity::Opacity,
            WireQuantity::OpticalDepth => Quantity::OpticalDepth,
            WireQuantity::ExpectedDepth => Quantity::ExpectedDepth,
        }
    }
}

impl From<WireDepthWeights> for DepthWeights {
    fn from(weights: WireDepthWeights) -> Self {
        match weights {
            WireDepthWeights::Plain => DepthWeights::Plain,
            WireDepthWeights::ByOpacity => DepthWeights::ByOpacity,
        }
    }
}

impl From<WireSampling> for Sampling {
    fn from(sampling: WireSampling) -> Self {
        match sampling {
            WireSampling::Front => Sampling::Front,
            WireSampling::Middle => Sampling::Middle,
            WireSampling::Back => Sampling::Back,
            WireSampling::Ends => Sampling::Ends,
            WireSampling::Jittered => Sampling::Jittered,
        }
    }
}

/// A request: rays to render.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema))]
pub(super) struct Render<'a> {
    #[serde(rename = "type")]
    pub(super) tag: RenderTag,
    /// To be repeated in the answer; another one in every request.
    pub(super) id: u64,
    /// At least one.
    pub(super) tasks: Vec<WireTask<'a>>,
}

/// One ray.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(rename = "Task"))]
pub(super) struct WireTask<'a> {
    /// The name of the case.
    pub(super) case: &'a str,
    /// The names of its channels, at least one: a radiance is wanted of each.
    pub(super) channels: &'a [String],
    /// The length D of the ray.
    pub(super) length: Written,
    /// The step d that is asked for, in the units of the length.
    pub(super) step: Written,
    /// How many segments that makes; the last is shorter where d does not divide D.
    pub(super) segments: u64,
    /// For kernels that draw random numbers: the same seed, the same answer.
    pub(super) seed: u64,
    /// What comes from behind the end of the ray, a radiance of every channel; for kernels that take one. Of version 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) background: Option<Vec<Written>>,
    /// One a channel: where they are there the gradient of Σₖ aₖ Iₖ is wanted, too. Of version 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) cotangents: Option<Vec<Written>>,
    /// The ray, in the form that the kernel asked for.
    pub(super) data: WireData<'a>,
}

/// A ray in one of the forms.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(rename = "Data"))]
#[serde(tag = "form", rename_all = "lowercase")]
pub(super) enum WireData<'a> {
    /// Values at the ends and in the middles of n segments.
    Segments {
        /// At the n + 1 ends, from 0 to D.
        edges: WireSamples<'a>,
        /// In the n middles.
        middles: WireSamples<'a>,
    },
    /// Field values on a grid along the ray, linear between, and tables of the transfer functions.
    Volume {
        /// s at the m + 1 places D·i/m.
        field: Array<'a>,
        /// The transfer functions.
        table: WireTable<'a>,
    },
    /// Source code.
    Formula {
        /// The language declared.
        language: String,
        /// Defines LENGTH, field(lambda), extinction(s), and for every channel `emission_CHANNEL(s)`.
        code: &'a str,
    },
}

/// Values at a row of places.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(rename = "Samples"))]
pub(super) struct WireSamples<'a> {
    /// The distance λ from the eye.
    pub(super) lambda: Array<'a>,
    /// The extinction τ per unit of length.
    pub(super) extinction: Array<'a>,
    /// The emission C of every channel, per unit of optical depth: the source term is C·τ. The source term itself, for
    /// kernels that take it per length.
    pub(super) emission: Vec<Array<'a>>,
}

/// Transfer functions at evenly spaced field values, linear between.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(rename = "Table"))]
pub(super) struct WireTable<'a> {
    /// The field value of the first entry.
    pub(super) first: Written,
    /// The field value of the last entry.
    pub(super) last: Written,
    /// The extinction τ, by entry.
    pub(super) extinction: Array<'a>,
    /// The emission C, by channel and entry.
    pub(super) emission: Vec<Array<'a>>,
}

/// The answer to a request.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema))]
#[serde(deny_unknown_fields)]
pub(super) struct Answer {
    #[serde(rename = "type")]
    pub(super) tag: AnswerTag,
    /// That of the request.
    #[cfg_attr(feature = "studies", schemars(with = "u64"))]
    pub(super) id: Value,
    /// Of every task, in the order of the tasks.
    pub(super) results: Vec<Outcome>,
}

/// What came of a task: what is answered of it, or `error` alone.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(extend("oneOf" = [
    { "anyOf": [{ "required": ["radiance"] }, { "required": ["opacity"] }, { "required": ["optical_depth"] }, { "required": ["expected_depth"] }] },
    { "required": ["error"] },
])))]
#[serde(deny_unknown_fields)]
pub(super) struct Outcome {
    /// Of every channel, in the task's order.
    pub(super) radiance: Option<Vec<Number>>,
    /// 1 − T of the whole ray.
    pub(super) opacity: Option<Number>,
    /// The integral of τ over the whole ray. Of version 2.
    pub(super) optical_depth: Option<Number>,
    /// The mean of λ with the weights of the samples, divided as the greeting says. Of version 2.
    pub(super) expected_depth: Option<Number>,
    /// The step d really used, where it is not the one asked for; above 0.
    pub(super) step: Option<Number>,
    /// The number of segments really used, where it is not the one asked for; above 0.
    pub(super) segments: Option<Number>,
    /// The ends of the segments really used, ascending from 0 to D, where they are not those asked for. Of version 2.
    pub(super) edges: Option<Vec<Number>>,
    /// Of every channel's radiance, where the kernel estimates it.
    pub(super) standard_error: Option<Vec<Number>>,
    /// Of a task with cotangents, and of no other. Of version 2.
    pub(super) gradient: Option<WireGradient>,
    /// Why there is no answer, in the kernel's own words.
    pub(super) error: Option<String>,
}
