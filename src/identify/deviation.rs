//! In what a rule deviates from another, part by part: from the rule of the same places without faults, or from the
//! one that a kernel declares.

use super::part::{Part, Stated, parts};
use super::rule::{Law, Rule, Scale, Scheme, Segment};
use super::state::{Batch, Name, Repeat, State};
use super::{Bracket, Identification, Parameter, VacuumFails};
use rug::Rational;

/// The name of what is rounded on the way to an answer.
pub(super) const INNER: &str = "inner-rounding";

/// A part in which a rule deviates.
#[derive(Clone, Debug, PartialEq)]
pub struct Deviation {
    /// By a name that stays: `early-end`.
    pub name: &'static str,
    /// Its parameter.
    pub value: Option<f64>,
    /// Between what the parameter lies, where that was measured.
    pub bracket: Option<(f64, f64)>,
    /// Whether the parameter is a count, or an answer as it came, and needs no bracket.
    pub exact: bool,
    /// The probe that shows it.
    pub probe: &'static str,
    /// The kinds of rays on which the rule that it is a part of was seen to hold; none of what is no part of a rule.
    pub validated: Vec<String>,
    /// What the kernel does, in words.
    pub does: String,
    /// What stands in its place in the other rule; `None` where nothing does.
    pub instead_of: Option<String>,
}

/// The rule of the same places without faults: each sample's opacity is 1 − e^(−τ d) and its weight that opacity, all
/// samples count once in their order, and the answer is the radiance.
///
/// Segments with several values keep their parts where these are consistent (they sum to 1); otherwise the parts are
/// divided by their sum.
#[must_use]
pub fn right_of(rule: &Rule) -> Rule {
    let scheme = match &rule.scheme {
        Scheme::Sample { place, .. } => Scheme::Sample {
            place: *place,
            law: Law::default(),
        },
        Scheme::Segments { depth, weights, .. } => {
            let depth = consistent(depth);
            Scheme::Segments {
                weights: right_segment(weights, &depth),
                depth,
                scale: Scale::default(),
            }
        }
    };
    Rule {
        scheme,
        ..Rule::default()
    }
}

/// Parts that sum to 1.
fn consistent(parts: &[Rational; 3]) -> [Rational; 3] {
    let sum = parts.iter().fold(Rational::new(), |sum, part| sum + part);
    if sum.is_zero() {
        return [0.into(), 1.into(), 0.into()];
    }
    parts.each_ref().map(|part| Rational::from(part / &sum))
}

fn right_segment(weights: &Segment, depth: &[Rational; 3]) -> Segment {
    match weights {
        Segment::Opacity { parts } => Segment::Opacity {
            parts: consistent(parts),
        },
        Segment::LinearInDepth { .. } => Segment::LinearInDepth { swapped: false },
        Segment::Linear => Segment::Linear,
        Segment::Halves => Segment::Halves,
        // Without a value in the middle nothing is seen through half of a segment.
        Segment::Quadrature { parts, half } => Segment::Quadrature {
            parts: consistent(parts),
            half: if parts[1].is_zero() {
                half.clone()
            } else {
                half_of(half)
            },
        },
        // In front of all that its segment absorbs, a sum is a quadrature already.
        Segment::Sum { parts } if parts[1].is_zero() && parts[2].is_zero() => Segment::Sum {
            parts: consistent(parts),
        },
        Segment::Sum { parts } => Segment::Quadrature {
            parts: consistent(parts),
            half: depth
                .each_ref()
                .map(|part| part.clone() / Rational::from(2)),
        },
    }
}

/// Parts that sum to 1/2.
fn half_of(half: &[Rational; 3]) -> [Rational; 3] {
    consistent(half).map(|part| part / Rational::from(2))
}

/// What a rule does and another does not, and what it leaves undone; `brackets` say between what parameters lie.
#[must_use]
pub fn deviations(rule: &Rule, other: &Rule, brackets: &[Bracket]) -> Vec<Deviation> {
    let (own, wanted) = (parts(rule), parts(other));
    let of = |all: &[Stated], part: Part| all.iter().find(|stated| stated.part == part).cloned();
    let mut found = Vec::new();
    for stated in &own {
        if wanted.contains(stated) || is_harmless(stated) {
            continue;
        }
        found.push(Deviation {
            name: stated.part.name(),
            value: stated.value,
            bracket: stated.value.and_then(|_| bracket(stated.part, brackets)),
            exact: stated.part.is_exact(),
            probe: stated.part.probe(),
            validated: Vec::new(),
            does: stated.words.clone(),
            instead_of: of(&wanted, stated.part).map(|wanted| wanted.words),
        });
    }
    for stated in wanted {
        if of(&own, stated.part).is_none() && !is_harmless(&stated) {
            found.push(Deviation {
                name: stated.part.name(),
                value: None,
                bracket: None,
                exact: false,
                probe: stated.part.probe(),
                validated: Vec::new(),
                does: "plain".into(),
                instead_of: Some(stated.words),
            });
        }
    }
    found
}

/// Radiances and emissions are not negative: a cut at 0, or below, changes none.
fn is_harmless(stated: &Stated) -> bool {
    matches!(stated.part, Part::EmissionLow | Part::ClipLow)
        && stated.value.is_some_and(|value| value <= 0.0)
}

fn bracket(part: Part, brackets: &[Bracket]) -> Option<(f64, f64)> {
    let parameter = match part {
        Part::DepthFactor => Parameter::Factor,
        Part::Scale => Parameter::Scale,
        Part::EarlyEnd => Parameter::Stop,
        Part::Eps => Parameter::Eps,
        Part::Background => Parameter::Background,
        Part::Offset => Parameter::Offset,
        Part::Wall => Parameter::Wall,
        Part::Weight => Parameter::Weight,
        Part::Skip => Parameter::Skip,
        Part::SkipExtinction => Parameter::SkipExtinction,
        Part::OpacityClamp => Parameter::OpacityClamp,
        Part::DepthClamp => Parameter::DepthClamp,
        Part::ExtinctionClamp => Parameter::ExtinctionClamp,
        Part::Uncorrected => Parameter::Uncorrected,
        Part::Series => Parameter::Series,
        Part::Table => Parameter::TableStep,
        Part::OutputCurve => Parameter::Gamma,
        Part::EmissionHigh => Parameter::EmissionHigh,
        _ => return None,
    };
    let found = brackets.iter().find(|b| b.parameter == parameter)?;
    Some((found.low, found.high))
}

/// Probes of state.
const TWICE: &str = "the same ray asked again";
const TOGETHER: &str = "several rays in one request";

/// What has another answer after others were asked, and what is said of it.
const DRIFT: &str = "earlier-rays";
const DRIFTS: &str = "an answer depends on the rays asked before";

/// What a ray is called.
const BY_NAME: &str = "answers-by-name";

/// Deviations that no single ray shows: what answers depend on beside the question, and how few digits they have.
const OF_MANY_RAYS: [&str; 14] = [
    INNER,
    "exponential",
    "batch-step",
    "batch-padding",
    "format",
    "digits",
    DRIFT,
    "first-answer",
    "previous-answer",
    "noise",
    "carried-transmittance",
    "batch",
    BY_NAME,
    "seed",
];

impl Deviation {
    /// Whether one ray may show it.
    pub(super) fn shows_on_one_ray(&self) -> bool {
        !OF_MANY_RAYS.contains(&self.name)
    }
}

/// What of a kernel's answers depends on more than the question, and where there are none.
#[must_use]
pub fn misbehaviour(found: &Identification) -> Vec<Deviation> {
    let mut all = Vec::new();
    if let Some(state) = &found.state {
        all.extend(of_state(state));
    }
    // What was seen of its state before is why.
    if found.hold_out.drifts && all.is_empty() {
        all.push(plain(DRIFT, "a ray asked again at the end", DRIFTS));
    }
    if let Some(case) = &found.hold_out.by_case {
        let does = format!("a ray named {case} has another answer than under another name");
        all.push(plain(BY_NAME, "rays under the names of cases", &does));
    }
    match found.parts.vacuum_fails {
        None => {}
        Some(VacuumFails::Ray) => all.push(plain(
            "vacuum-ray",
            "a ray that holds nothing",
            "a ray that holds nothing has no finite answer",
        )),
        Some(VacuumFails::Segment) => all.push(plain(
            "vacuum-segment",
            "a ray with an empty segment",
            "a ray with an empty segment has no finite answer",
        )),
    }
    all
}

/// Without a value, and validated nowhere yet.
pub(super) fn plain(name: &'static str, probe: &'static str, does: &str) -> Deviation {
    Deviation {
        name,
        value: None,
        bracket: None,
        exact: false,
        probe,
        validated: Vec::new(),
        does: does.into(),
        instead_of: None,
    }
}

/// What is asked again has another answer.
pub(super) fn drifts() -> Deviation {
    plain(DRIFT, TWICE, DRIFTS)
}

/// What an answer depends on beside its own ray; nothing where it does not.
pub(super) fn of_batch(batch: Batch) -> Option<Deviation> {
    match batch {
        Batch::Same => None,
        Batch::Carried => Some(plain(
            "carried-transmittance",
            TOGETHER,
            "a ray goes on with the transmittance of the one before in its request",
        )),
        Batch::FirstStep => Some(plain(
            "batch-step",
            TOGETHER,
            "all rays of a request have the step of the first",
        )),
        Batch::Padding => Some(plain(
            "batch-padding",
            TOGETHER,
            "a ray that is shorter than another of its request has another answer than alone",
        )),
        Batch::Differs => Some(plain(
            "batch",
            TOGETHER,
            "an answer depends on the other rays of its request",
        )),
    }
}

fn of_state(state: &State) -> impl Iterator<Item = Deviation> {
    let repeat = match state.repeat {
        Repeat::Same => None,
        Repeat::FirstDiffers => Some(plain(
            "first-answer",
            TWICE,
            "the first answer of all is another one",
        )),
        Repeat::Previous => Some(plain(
            "previous-answer",
            TWICE,
            "an answer is that to the question before",
        )),
        Repeat::Differs(part) => Some(Deviation {
            value: Some(part),
            ..plain("noise", TWICE, "answers to the same question differ")
        }),
        Repeat::Drifts => Some(drifts()),
    };
    let batch = of_batch(state.batch);
    let by_name = |does| plain(BY_NAME, "other data under the same name", does);
    let name = match state.name {
        Name::Nothing => None,
        Name::First => Some(by_name(
            "another ray of the same name has the first one's answer",
        )),
        Name::Mixed => Some(by_name(
            "another ray of the same name has another answer than under its own",
        )),
    };
    let seed = state.seed.then(|| {
        plain(
            "seed",
            "the same ray with another seed",
            "answers depend on the seed",
        )
    });
    [repeat, batch, name, seed].into_iter().flatten()
}
