//! A rule taken apart: every part that is not the plain one, by a name that stays, with its value, in words.

mod name;
mod words;

pub use name::Part;
pub(super) use words::short;

use super::rule::{
    Channels, Curve, Depth, End, Extra, LastStep, Law, Place, Quantised, Range, Rule, Scheme,
    Sequence, Shape, Step, StopBy, Wall, Weight, Whole,
};
use words::{curve, is_other, of_depth, of_segment, shape, sum, weight};

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
        match range.quantised {
            Quantised::Nearest => format!("opacities are multiples of {x}"),
            Quantised::Below => format!("opacities are rounded down to multiples of {x}"),
            Quantised::UnitNearest => {
                format!("opacities of a unit of length are multiples of {x}")
            }
            Quantised::UnitBelow => {
                format!("opacities of a unit of length are rounded down to multiples of {x}")
            }
        }
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
    if let Some(seam) = sequence.seam {
        said.value(Part::Seam, seam.blocks.count() as f64, |_| seam.words());
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
            StopBy::Sum => {
                format!("the ray ends where what samples weigh by themselves sums to {x} or more")
            }
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
