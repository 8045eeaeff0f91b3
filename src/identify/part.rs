//! A rule taken apart: every part that is not the plain one, by a name that stays, with its value, in words.

use super::rule::{
    Channels, Curve, Depth, End, Extra, LastStep, Law, Place, Power, Range, Rule, Scheme, Segment,
    Sequence, Shape, Step, StopBy, Wall, Weight, Whole,
};
use rug::Rational;

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

/// What a rule says of a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Stated {
    /// Of which.
    pub part: Part,
    /// Its parameter, where it has one.
    pub value: Option<f64>,
    /// In words.
    pub words: String,
}

/// Collects what is said.
#[derive(Default)]
struct Said(Vec<Stated>);

impl Said {
    fn words(&mut self, part: Part, words: impl Into<String>) {
        self.0.push(Stated {
            part,
            value: None,
            words: words.into(),
        });
    }

    fn value(&mut self, part: Part, value: f64, words: impl FnOnce(&str) -> String) {
        self.0.push(Stated {
            part,
            value: Some(value),
            words: words(&short(value)),
        });
    }

    fn bound(&mut self, part: Part, value: Option<f64>, words: impl FnOnce(&str) -> String) {
        if let Some(value) = value {
            self.value(part, value, words);
        }
    }
}

/// Where one sample a segment lies.
fn of_place(place: Place) -> &'static str {
    match place {
        Place::Front => "samples lie at the front of segments",
        Place::Middle => "samples lie in the middle of segments",
        Place::Back => "samples lie at the back of segments",
    }
}

/// Every part of a rule that is not the plain one, in the order in which a ray meets them.
#[must_use]
pub fn parts(rule: &Rule) -> Vec<Stated> {
    let mut said = Said::default();
    match &rule.scheme {
        Scheme::Sample { place, law } => {
            said.words(Part::Place, of_place(*place));
            of_law(&mut said, law);
        }
        Scheme::Segments {
            depth,
            weights,
            scale,
        } => {
            said.words(
                Part::SegmentDepth,
                format!("a segment's depth is d ({})", sum(depth, "τ")),
            );
            said.words(Part::SegmentWeights, of_segment(weights));
            if is_other(scale.0, 1.0) {
                said.value(Part::Scale, scale.0, |x| {
                    format!("the emission is multiplied by {x}")
                });
            }
        }
    }
    of_sequence(&mut said, &rule.sequence);
    of_ends(&mut said, rule);
    of_answers(&mut said, rule);
    said.0
}

fn of_law(said: &mut Said, law: &Law) {
    if is_other(law.depth.factor, 1.0) {
        said.value(Part::DepthFactor, law.depth.factor, |x| {
            format!("the optical depth is multiplied by {x}")
        });
    }
    let powers = Depth {
        factor: 1.0,
        ..law.depth
    };
    if !powers.is_plain() {
        said.words(
            Part::DepthPowers,
            format!("the optical depth is {}", of_depth(&powers)),
        );
    }
    if law.shape != Shape::Exponential {
        said.words(
            Part::OpacityLaw,
            format!("of the depth x a segment lets {} through", shape(law.shape)),
        );
    }
    if law.weight != Weight::default() {
        said.0.push(Stated {
            part: Part::Weight,
            value: match law.weight {
                Weight::Own { depth, .. } if is_other(depth.factor, 1.0) => Some(depth.factor),
                _ => None,
            },
            words: format!("the emission is multiplied by {}", weight(law.weight)),
        });
    }
    if is_other(law.scale.0, 1.0) {
        said.value(Part::Scale, law.scale.0, |x| {
            format!("the weight of the emission is multiplied by {x}")
        });
    }
    if is_other(law.eps, 0.0) {
        said.value(Part::Eps, law.eps, |x| {
            format!("{x} is added to what every segment lets through")
        });
    }
    if is_other(law.cover.0, 1.0) {
        said.value(Part::Cover, law.cover.0, |x| {
            format!("the opacity is multiplied by {x}")
        });
    }
    if let Some(bits) = law.length_bits {
        said.value(Part::LengthBits, bits.into(), |x| {
            format!("lengths have {x} bits")
        });
    }
    of_range(said, &law.range);
}

fn of_range(said: &mut Said, range: &Range) {
    said.bound(Part::DepthClamp, range.depth_max, |x| {
        format!("depths above {x} count as {x}")
    });
    said.bound(Part::ExtinctionClamp, range.extinction_max, |x| {
        format!("extinctions above {x} count as {x}")
    });
    said.bound(Part::Skip, range.skip, |x| {
        format!("opacities under {x} count as none")
    });
    said.bound(Part::SkipExtinction, range.skip_extinction, |x| {
        format!("extinctions under {x} count as none")
    });
    said.bound(Part::OpacityClamp, range.opacity_max, |x| {
        format!("opacities above {x} count as {x}")
    });
    let unit = short(range.uncorrected_length);
    said.bound(Part::Uncorrected, range.uncorrected_under, |x| {
        format!("opacities up to {x} of a length of {unit} are taken whatever the step")
    });
    if let Some(series) = range.series {
        said.value(Part::Series, series.below, |x| {
            let terms = series.terms;
            format!("below a depth of {x} the opacity is a series of {terms} terms")
        });
    }
    said.bound(Part::OpacityQuantum, range.quantum, |x| {
        format!("opacities are multiples of {x}")
    });
    if let Some(table) = range.table {
        said.value(Part::Table, table.step, |x| {
            let top = table.top.map(short);
            let top = top.map_or_else(String::new, |top| format!(" up to {top}"));
            match table.between {
                Step::Nearest => {
                    format!("opacities are the nearest of a table of depths, {x} apart{top}")
                }
                Step::Below => {
                    format!("opacities are those before in a table of depths, {x} apart{top}")
                }
                Step::Linear => format!("opacities are linear between depths {x} apart{top}"),
                Step::NearestExtinction => {
                    format!("extinctions are rounded to multiples of {x}{top}")
                }
                Step::PowersOfTwo => {
                    format!("e^(−x) is linear between powers of two, which it meets at x = {x}")
                }
            }
        });
    }
}

fn of_sequence(said: &mut Said, sequence: &Sequence) {
    for (part, end, which) in [
        (Part::First, sequence.first, "first"),
        (Part::Last, sequence.last, "last"),
    ] {
        match end {
            End::Once => {}
            End::Missing => said.words(part, format!("the {which} sample is missing")),
            End::Twice => said.words(part, format!("the {which} sample counts twice")),
        }
    }
    match sequence.extra {
        None => {}
        Some(Extra::Step) => said.words(Part::Extra, "one sample too many, for a whole step"),
        Some(Extra::Last) => said.words(
            Part::Extra,
            "one sample too many, for the length of the last segment",
        ),
    }
    if sequence.swapped {
        said.words(Part::Swapped, "the back of the ray is taken for its front");
    }
    if sequence.late {
        said.words(
            Part::Late,
            "the transmittance of a sample is that of the one before",
        );
    }
    if sequence.unrolled > 1 {
        said.value(Part::Unrolled, sequence.unrolled as f64, |x| {
            format!("samples come in groups of {x}, and what is left over is missing")
        });
    }
    said.bound(
        Part::MostSamples,
        sequence.most.map(|most| most as f64),
        |x| format!("no more than {x} samples are taken"),
    );
    match sequence.last_step {
        LastStep::Own => {}
        LastStep::Whole => said.words(
            Part::LastStep,
            "a shorter last segment counts as a whole one",
        ),
        LastStep::Dropped => said.words(Part::LastStep, "a shorter last segment is left out"),
        LastStep::Even => said.words(
            Part::LastStep,
            "all segments count as D/n long where the last is shorter",
        ),
    }
}

fn of_ends(said: &mut Said, rule: &Rule) {
    if let Some(stop) = rule.stop {
        said.value(Part::EarlyEnd, stop.under, |x| match stop.by {
            StopBy::Transmittance => format!("the ray ends where the transmittance is under {x}"),
            StopBy::Weight => format!("the ray ends where a sample's weight is under {x}"),
        });
        if stop.before {
            said.words(
                Part::EarlyEndSample,
                "the sample at which the ray ends early is left out",
            );
        } else if stop.cut {
            said.words(
                Part::EarlyEndSample,
                "the sample at which the ray ends early counts up to the threshold",
            );
        }
        if stop.renormalised {
            said.words(
                Part::Renormalised,
                "a radiance of a ray that ends early is divided by the opacity reached",
            );
        }
    }
    match rule.wall {
        None => {}
        Some(Wall::Opaque) => said.words(
            Part::Wall,
            "the last segment is opaque where it absorbs anything",
        ),
        Some(Wall::LastEmission) => said.words(
            Part::Wall,
            "the last sample's emission shines behind the ray",
        ),
        Some(Wall::Length(length)) => said.value(Part::Wall, length, |x| {
            format!("the last segment counts as {x} long")
        }),
    }
    match rule.whole {
        Whole::One => {}
        Whole::ByOpacity => said.words(
            Part::Whole,
            "the radiance is divided by the opacity of the ray",
        ),
        Whole::TimesOpacity => said.words(
            Part::Whole,
            "the radiance is multiplied by the opacity of the ray",
        ),
    }
    if is_other(rule.background, 0.0) {
        said.value(Part::Background, rule.background, |x| {
            format!("{x} shines behind the ray")
        });
    }
}

fn of_answers(said: &mut Said, rule: &Rule) {
    if let Some(of) = curve(rule.emission) {
        said.words(
            Part::EmissionCurve,
            format!("an emission of x counts as {of}"),
        );
    }
    said.bound(Part::EmissionHigh, rule.emission_max, |x| {
        format!("emissions above {x} count as {x}")
    });
    said.bound(Part::EmissionLow, rule.emission_min, |x| {
        format!("emissions under {x} count as {x}")
    });
    if is_other(rule.offset, 0.0) {
        said.value(Part::Offset, rule.offset, |x| {
            format!("{x} is added to every radiance")
        });
    }
    if let Some(of) = curve(rule.output.curve) {
        said.0.push(Stated {
            part: Part::OutputCurve,
            value: match rule.output.curve {
                Curve::Gamma(power) => Some(power),
                _ => None,
            },
            words: format!("the answer to a radiance of x is {of}"),
        });
    }
    said.bound(Part::ClipLow, rule.output.low, |x| {
        format!("no answer is under {x}")
    });
    said.bound(Part::ClipHigh, rule.output.high, |x| {
        format!("no answer is above {x}")
    });
    said.bound(Part::Quantum, rule.output.quantum, |x| {
        format!("answers are multiples of {x}")
    });
    match rule.channels {
        Channels::Straight => {}
        Channels::ReversedByThrees => said.words(
            Part::Channels,
            "the first and the last of every three channels have changed places",
        ),
        Channels::Reversed => said.words(Part::Channels, "channels are in the opposite order"),
    }
}

fn of_segment(weights: &Segment) -> String {
    let opacity = "the opacity of a segment is multiplied by";
    match weights {
        Segment::Opacity { parts } => format!("{opacity} {}", sum(parts, "C")),
        Segment::LinearInDepth { swapped: false } => "emission is linear in optical depth".into(),
        Segment::LinearInDepth { swapped: true } => {
            "emission is linear in optical depth, front and back changed places".into()
        }
        Segment::Linear => "C and τ are linear along segments, integrated exactly".into(),
        Segment::Quadrature { parts, half } => format!(
            "τ C T is summed, d ({}), with a depth of d ({}) to the middle",
            sum(parts, "τCT"),
            sum(half, "τ")
        ),
        Segment::Sum { parts } => format!(
            "τ C is summed, d ({}), as though segments absorbed nothing",
            sum(parts, "τC")
        ),
        Segment::Halves => "each half of a segment has the values at its end".into(),
    }
}

/// "1/2 front + 1/2 back", of what there is.
fn sum(parts: &[Rational; 3], what: &str) -> String {
    let names = ["in front", "in the middle", "at the back"];
    let terms = parts.iter().zip(names).filter(|(part, _)| !part.is_zero());
    let terms: Vec<String> = terms
        .map(|(part, name)| {
            if *part == 1 {
                format!("{what} {name}")
            } else {
                format!("{part} {what} {name}")
            }
        })
        .collect();
    if terms.is_empty() {
        "0".into()
    } else {
        terms.join(" + ")
    }
}

fn of_depth(depth: &Depth) -> String {
    let mut factors = Vec::new();
    if is_other(depth.factor, 1.0) {
        factors.push(short(depth.factor));
    }
    let all = [
        ("τ", depth.extinction),
        ("d", depth.length),
        ("D", depth.ray),
    ];
    for (name, power) in all {
        factors.extend(raised(name, power));
    }
    if factors.is_empty() {
        "1".into()
    } else {
        factors.join(" ")
    }
}

fn raised(name: &str, power: Power) -> Option<String> {
    match power.halves {
        0 => None,
        2 => Some(name.into()),
        halves if halves % 2 == 0 => Some(format!("{name}^{}", halves / 2)),
        halves => Some(format!("{name}^({halves}/2)")),
    }
}

fn shape(shape: Shape) -> &'static str {
    match shape {
        Shape::Exponential => "e^(−x)",
        Shape::Linear => "1 − x",
        Shape::Reciprocal => "1/(1 + x)",
        Shape::Quadratic => "1 − x + x²/2",
        Shape::CrankNicolson => "(1 − x/2)/(1 + x/2)",
        Shape::Clear => "all",
    }
}

fn weight(weight: Weight) -> String {
    let with = |first: String, passes: Power| {
        let through = raised("p", passes);
        std::iter::once(first)
            .chain(through)
            .collect::<Vec<_>>()
            .join(" ")
    };
    match weight {
        Weight::Opacity { opacity, passes } => {
            with(raised("α", opacity).unwrap_or_else(|| "1".into()), passes)
        }
        Weight::Depth { depth, passes } => with(of_depth(&depth), passes),
        Weight::Own { depth, shape: of } => {
            format!("1 − p, p = {} with x = {}", shape(of), of_depth(&depth))
        }
    }
}

fn curve(curve: Curve) -> Option<String> {
    Some(match curve {
        Curve::Linear => return None,
        Curve::Gamma(power) => format!("x^{}", short(power)),
        Curve::Srgb => "that of sRGB".into(),
        Curve::Reinhard => "x/(1 + x)".into(),
        Curve::Exposure => "1 − e^(−x)".into(),
    })
}

fn is_other(x: f64, plain: f64) -> bool {
    (x - plain).abs() > 0.0
}

/// A number with all digits that it has, without rows of zeros.
pub(super) fn short(x: f64) -> String {
    let size = x.abs();
    if x.is_finite() && size > 0.0 && !(1e-4..1e6).contains(&size) {
        format!("{x:e}")
    } else {
        format!("{x}")
    }
}
