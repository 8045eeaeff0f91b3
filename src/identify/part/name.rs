//! The names of parts, which stay, and the probes that show them.

/// A part of a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Part {
    /// Where samples lie.
    Place,
    /// How segments with several values are weighed.
    SegmentWeights,
    /// What makes their depth.
    SegmentDepth,
    /// What the depth is multiplied by.
    DepthFactor,
    /// Powers of τ, d and D in the depth.
    DepthPowers,
    /// What of the depth is let through.
    OpacityLaw,
    /// What the emission is multiplied by.
    Weight,
    /// By what factor weights are too large.
    Scale,
    /// What is added to what is let through.
    Eps,
    /// What opacities are multiplied by.
    Cover,
    /// Lengths in few bits.
    LengthBits,
    /// Depths are clamped.
    DepthClamp,
    /// Extinctions are clamped.
    ExtinctionClamp,
    /// Opacities are clamped.
    OpacityClamp,
    /// Small opacities are skipped.
    Skip,
    /// Small extinctions are skipped.
    SkipExtinction,
    /// Small opacities are not corrected for the step.
    Uncorrected,
    /// A polynomial for small depths.
    Series,
    /// Opacities in steps.
    OpacityQuantum,
    /// Opacities from a table.
    Table,
    /// The first sample.
    First,
    /// The last sample.
    Last,
    /// One sample too many.
    Extra,
    /// The ends of the ray have changed places.
    Swapped,
    /// Transmittances come one sample late.
    Late,
    /// Samples in groups.
    Unrolled,
    /// Samples between blocks of segments.
    Seam,
    /// The most samples.
    MostSamples,
    /// A shorter last segment.
    LastStep,
    /// A ray that ends early.
    EarlyEnd,
    /// The sample at which it ends.
    EarlyEndSample,
    /// A radiance divided by the opacity reached at an early end.
    Renormalised,
    /// What stands at the end.
    Wall,
    /// A factor of the whole ray.
    Whole,
    /// A curve of emissions.
    EmissionCurve,
    /// Large emissions are cut.
    EmissionHigh,
    /// Small emissions are cut.
    EmissionLow,
    /// What shines behind.
    Background,
    /// What is added.
    Offset,
    /// A curve of answers.
    OutputCurve,
    /// Large answers are cut.
    ClipHigh,
    /// Small answers are cut.
    ClipLow,
    /// Answers in steps.
    Quantum,
    /// Channels have changed places.
    Channels,
}

impl Part {
    /// The name by which it is known in reports, baselines and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Part::Place => "place",
            Part::SegmentWeights => "segment-weights",
            Part::SegmentDepth => "segment-depth",
            Part::DepthFactor => "depth-factor",
            Part::DepthPowers => "depth-powers",
            Part::OpacityLaw => "opacity-law",
            Part::Weight => "weight",
            Part::Scale => "scale",
            Part::Eps => "eps",
            Part::Cover => "cover",
            Part::LengthBits => "length-bits",
            Part::DepthClamp => "depth-clamp",
            Part::ExtinctionClamp => "extinction-clamp",
            Part::OpacityClamp => "opacity-clamp",
            Part::Skip => "skip",
            Part::SkipExtinction => "skip-extinction",
            Part::Uncorrected => "uncorrected-opacity",
            Part::Series => "series",
            Part::OpacityQuantum => "opacity-quantum",
            Part::Table => "opacity-table",
            Part::First => "first-sample",
            Part::Last => "last-sample",
            Part::Extra => "extra-sample",
            Part::Swapped => "swapped-ends",
            Part::Late => "late-transmittance",
            Part::Unrolled => "unrolled",
            Part::Seam => "seam",
            Part::MostSamples => "most-samples",
            Part::LastStep => "last-step",
            Part::EarlyEnd => "early-end",
            Part::EarlyEndSample => "early-end-sample",
            Part::Renormalised => "renormalised",
            Part::Wall => "wall",
            Part::Whole => "whole-factor",
            Part::EmissionCurve => "emission-curve",
            Part::EmissionHigh => "emission-high",
            Part::EmissionLow => "emission-low",
            Part::Background => "background",
            Part::Offset => "offset",
            Part::OutputCurve => "output-curve",
            Part::ClipHigh => "clip-high",
            Part::ClipLow => "clip-low",
            Part::Quantum => "quantum",
            Part::Channels => "channels",
        }
    }

    /// Whether its parameter is a count, or an answer as it came: known to the last digit.
    #[must_use]
    pub fn is_exact(self) -> bool {
        matches!(
            self,
            Part::LengthBits
                | Part::OpacityQuantum
                | Part::Unrolled
                | Part::Seam
                | Part::MostSamples
                | Part::ClipHigh
                | Part::ClipLow
                | Part::EmissionLow
                | Part::Quantum
        )
    }

    /// The probe that shows it.
    #[must_use]
    pub fn probe(self) -> &'static str {
        match self {
            Part::Place | Part::Swapped | Part::First | Part::Last | Part::Extra => {
                "emission in one node alone"
            }
            Part::Late => "an extinction raised in one segment alone",
            Part::SegmentWeights | Part::SegmentDepth => "weights of all nodes of a segment",
            Part::DepthFactor
            | Part::DepthPowers
            | Part::OpacityLaw
            | Part::Weight
            | Part::Scale
            | Part::Cover
            | Part::LengthBits
            | Part::DepthClamp
            | Part::ExtinctionClamp
            | Part::OpacityClamp
            | Part::Skip
            | Part::SkipExtinction
            | Part::Uncorrected
            | Part::Series
            | Part::OpacityQuantum
            | Part::Table => "segments between references",
            Part::Eps => "empty segments between references",
            Part::Unrolled => "rays of 1 to 17 segments, lit one by one",
            Part::Seam => "rays of 1 to 263 segments, lit one by one",
            Part::MostSamples => "light from segment m on",
            Part::LastStep => "rays with a shorter last segment",
            Part::EarlyEnd | Part::EarlyEndSample | Part::Renormalised => {
                "light behind segments of growing depth"
            }
            Part::Wall => "a last segment that holds next to nothing",
            Part::Whole => "an even ray lit in one node alone",
            Part::EmissionCurve
            | Part::EmissionHigh
            | Part::EmissionLow
            | Part::OutputCurve
            | Part::ClipHigh
            | Part::ClipLow
            | Part::Quantum => "rays of constant emission",
            Part::Background | Part::Offset => "rays without emission",
            Part::Channels => "channels of different emission",
        }
    }
}
