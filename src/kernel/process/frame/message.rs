//! The lines of frames, as `docs/protocol.md` has them. What is said of a field here stands in the schema.

#[cfg(feature = "studies")]
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// What a request of many rays, and its answer, say that they are.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "lowercase")]
pub(in crate::kernel::process) enum FrameTag {
    Frame,
}

/// Many rays at once, for kernels that say so: this line, and behind its end the blocks, one after the other. Of version 2.
#[derive(Debug, Serialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(rename = "Frame"))]
pub(in crate::kernel::process) struct WireFrame<'a> {
    #[serde(rename = "type")]
    pub(in crate::kernel::process) tag: FrameTag,
    /// To be repeated in the answer; another one in every request.
    pub(in crate::kernel::process) id: u64,
    /// How many, R.
    pub(in crate::kernel::process) rays: u64,
    /// The names of the channels, which are those of all rays: a radiance is wanted of each of these K.
    pub(in crate::kernel::process) channels: &'a [String],
    /// The names of cases, each once.
    pub(in crate::kernel::process) cases: Vec<&'a str>,
    /// How many bytes come behind the end of the line.
    pub(in crate::kernel::process) bytes: u64,
    /// In the order in which they come.
    pub(in crate::kernel::process) blocks: Vec<WireBlock<AskedBlock>>,
}

/// An array: its numbers of 8 bytes, the last index running fastest, without anything between or behind.
#[derive(Debug, Serialize, Deserialize)]
#[cfg_attr(
    feature = "studies",
    derive(JsonSchema),
    schemars(rename = "Block_of_{N}")
)]
#[serde(deny_unknown_fields)]
pub(in crate::kernel::process) struct WireBlock<N> {
    /// Of what.
    pub(in crate::kernel::process) name: N,
    /// Of what type, as `NumPy` calls it.
    #[serde(rename = "type")]
    pub(in crate::kernel::process) kind: BlockType,
    /// How many there are along each axis.
    pub(in crate::kernel::process) shape: Vec<u64>,
}

/// The types of numbers in blocks, all little-endian.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
pub(in crate::kernel::process) enum BlockType {
    /// Binary64.
    #[serde(rename = "<f8")]
    Real,
    /// 64 bits with a sign.
    #[serde(rename = "<i8")]
    Integer,
    /// 64 bits without one.
    #[serde(rename = "<u8")]
    Natural,
}

impl BlockType {
    /// Its name in messages.
    pub(in crate::kernel::process) fn name(self) -> &'static str {
        match self {
            BlockType::Real => "<f8",
            BlockType::Integer => "<i8",
            BlockType::Natural => "<u8",
        }
    }
}

/// The blocks of a request. With S segments of all R rays there are S + R ends of segments.
#[derive(Clone, Copy, Debug, Serialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "snake_case")]
pub(in crate::kernel::process) enum AskedBlock {
    /// R + 1 integers: ray r has the segments from the r-th to the one before the next.
    Offsets,
    /// Of R: the place of its case's name.
    Case,
    /// Of R, without a sign.
    Seed,
    /// Of R: D.
    Length,
    /// Of R: d.
    Step,
    /// Of R and K: what comes from behind; for kernels that take a background, and no others.
    Background,
    /// Of S + R.
    EdgesLambda,
    /// Of S + R.
    EdgesExtinction,
    /// Of K and S + R.
    EdgesEmission,
    /// Of S.
    MiddlesLambda,
    /// Of S.
    MiddlesExtinction,
    /// Of K and S.
    MiddlesEmission,
}

/// The answer to many rays: this line, and behind its end the blocks; or why there is none.
#[derive(Debug, Deserialize)]
#[cfg_attr(
    feature = "studies",
    derive(JsonSchema),
    schemars(rename = "FrameAnswer")
)]
#[serde(deny_unknown_fields)]
pub(in crate::kernel::process) struct WireFrameAnswer {
    #[serde(rename = "type")]
    #[expect(dead_code, reason = "there is no other value")]
    tag: FrameTag,
    /// That of the request.
    #[cfg_attr(feature = "studies", schemars(with = "u64"))]
    pub(in crate::kernel::process) id: Value,
    /// How many bytes come behind the end of the line; none unless given.
    #[serde(default)]
    pub(in crate::kernel::process) bytes: u64,
    /// In the order in which they come, each once: what is declared, and what else a result may have.
    #[serde(default)]
    pub(in crate::kernel::process) blocks: Vec<WireBlock<AnswerBlock>>,
    /// Rays that have no answer, in their order; what blocks hold of these is not looked at.
    #[serde(default)]
    pub(in crate::kernel::process) errors: Vec<WireRefused>,
    /// Why no ray has an answer, in the kernel's own words; without blocks.
    pub(in crate::kernel::process) error: Option<String>,
}

/// The blocks of an answer, to R rays of K channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(inline))]
#[serde(rename_all = "snake_case")]
pub(in crate::kernel::process) enum AnswerBlock {
    /// Of R and K.
    Radiance,
    /// Of R.
    Opacity,
    /// Of R.
    OpticalDepth,
    /// Of R.
    ExpectedDepth,
    /// Of R: the step d really used.
    Step,
    /// Of R, integers: the number of segments really used.
    Segments,
    /// Of R and K.
    StandardError,
}

impl AnswerBlock {
    /// Its name in messages.
    pub(in crate::kernel::process) fn name(self) -> &'static str {
        match self {
            AnswerBlock::Radiance => "radiance",
            AnswerBlock::Opacity => "opacity",
            AnswerBlock::OpticalDepth => "optical_depth",
            AnswerBlock::ExpectedDepth => "expected_depth",
            AnswerBlock::Step => "step",
            AnswerBlock::Segments => "segments",
            AnswerBlock::StandardError => "standard_error",
        }
    }
}

/// A ray without an answer.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "studies", derive(JsonSchema), schemars(rename = "Refused"))]
#[serde(deny_unknown_fields)]
pub(in crate::kernel::process) struct WireRefused {
    /// Its place, from 0.
    pub(in crate::kernel::process) ray: u64,
    /// Why, in the kernel's own words.
    pub(in crate::kernel::process) error: String,
}
