//! What a kernel computes, read off by probes.
//!
//! A kernel is asked rays that are made to tell: emission in one node alone shows the node's weight, an extinction
//! raised shows what it acts on, segments between references show what they add and let through. Each stage reads a
//! part of the [`Rule`] off, or says that it could not and what it measured; a rule is named where it predicts the
//! answers to rays that it was not found with.

mod against;
mod channels;
mod covered;
mod curves;
mod deviation;
mod ends;
mod examined;
mod expected;
mod finding;
mod free_places;
mod holdout;
mod influence;
mod least_squares;
mod number;
mod opacity;
mod opacity_answered;
mod output;
mod part;
mod places;
mod pose;
mod random;
mod ray;
pub mod rule;
mod scattered;
mod seen;
mod segment;
mod session;
mod state;
mod stated;
mod volume;
mod weights;
mod witness;

pub use against::{Against, Difference, Known, against, differences};
pub use deviation::{Deviation, deviations, misbehaviour, right_of};
pub use examined::{Examined, Verdict, examine};
pub use finding::NotIdentified;
pub use holdout::{HoldOut, Kind, Miss};
pub use opacity_answered::OpacityAnswered;
pub use part::{Part, Stated, parts};
pub use ray::Ray;
pub use rule::Rule;
pub use scattered::Scattered;
pub use seen::Seen;
pub use session::{Budget, Silence, Spent};
pub use state::{Batch, Repeat, State};
pub use stated::stated;
pub use volume::{Lookup, Optics};
pub use witness::{TaskError, Witness, witness};

use crate::kernel::{FormKind, Kernel};
use ends::{Lone, Vacuum};
use influence::Influence;
use opacity::measure::Measurer;
use places::{Places, Samples};
use rule::{End, Lattice, Law, Place, Scheme, Sequence, Wall, Whole};
use session::Session;
use weights::Answers;

/// What was found out about a kernel.
#[derive(Clone, Debug, Default)]
pub struct Identification {
    /// What answers depend on beside the question; `None` where that could not be seen.
    pub state: Option<State>,
    /// Parts that hold by themselves.
    pub parts: Parts,
    /// The whole rule.
    pub rule: Option<Rule>,
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
    /// 2^(−p) of the narrowest format that holds all answers.
    pub unit: Option<f64>,
    /// By what answers to the same question differ.
    pub noise: f64,
    /// The relative precision of what one segment lets through, where it is coarser than that of the answers.
    pub grain: f64,
    /// Where one sample a segment lies.
    pub place: Option<Place>,
    /// Other places and orders that have the same weights on every ray asked.
    pub alike: Vec<(Place, Sequence)>,
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
    fn of(parameter: Parameter, (low, high): (f64, f64)) -> Self {
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

/// Reads off what a kernel computes; `heard` hears of every ray.
pub fn identify(
    kernel: &mut dyn Kernel,
    budget: Budget,
    heard: &mut dyn FnMut(&Spent),
) -> Identification {
    let mut found = Identification::default();
    let mut session = Session::new(kernel, budget, heard);
    if let Err(reason) = run(&mut session, &mut found) {
        found.not_identified.push(reason);
    }
    found.spent = session.spent;
    found
}

/// A rule against a kernel: whether it predicts the answers to rays of all kinds.
///
/// # Errors
/// [`Silence::Budget`] where the budget ends before all are asked.
pub fn held_out(
    kernel: &mut dyn Kernel,
    rule: &Rule,
    budget: Budget,
    heard: &mut dyn FnMut(&Spent),
) -> Result<HoldOut, Silence> {
    let mut session = Session::new(kernel, budget, heard);
    session.channels = rule.channels;
    let answers = Answers {
        output: rule.output,
        emission_max: rule.emission_max.unwrap_or(f64::INFINITY),
        ..Answers::default()
    };
    let factor = match &rule.scheme {
        Scheme::Sample { law, .. } => law.depth.factor,
        Scheme::Segments { .. } => 1.0,
    };
    let terms = holdout::Terms {
        answers: &answers,
        typical: factor.recip(),
        no_vacuum: false,
        negative: true,
    };
    holdout::hold_out(&mut session, rule, &terms)
}

/// What stages of one sample a segment have found.
struct Sampled {
    rule: Rule,
    grain: f64,
    typical: f64,
    vacuum: Vacuum,
}

fn run(session: &mut Session<'_>, found: &mut Identification) -> Result<(), NotIdentified> {
    let lean = session.is_narrow() || session.is_short();
    let (state, noise) = state::state(session)?;
    found.parts.noise = noise;
    found.state = Some(state.clone());
    let (channels, odd) = channels::channels(session, &state, noise)?;
    found.not_identified.extend(odd);
    session.channels = channels;
    found.parts.channels = Some(channels);
    let mapped = output::output(session, &state, noise)?;
    let answers = mapped.answers.clone();
    found.brackets.clone_from(&mapped.brackets);
    found.parts.output = Some(answers.output);
    found.parts.unit = Some(answers.unit);
    found.parts.noise = answers.noise;
    if state.seed {
        found.scattered = Some(scattered::scattered(session, &answers)?);
        return Ok(());
    }
    let poses = pose::Pose::new(session.pose.form);
    let divides = session.divides;
    let lean = lean | look(session, &answers, found)?;
    let even = places::even(session, &answers, false)?;
    let base = Rule {
        emission_max: mapped.emission_max,
        emission_min: mapped.emission_min,
        lattice: session.pose.lattice(),
        output: answers.output,
        channels,
        ..Rule::default()
    };
    let sampled = match places::places(session, &answers, &even)? {
        Places::Several => several(session, &answers, &base)?,
        Places::Samples(samples) => {
            found.parts.place = Some(samples.place);
            found.parts.alike.clone_from(&samples.alike);
            match influence::influence(session, &answers, &even, &samples)? {
                Influence::Several => several(session, &answers, &base)?,
                Influence::Own { whole } => {
                    let measurer = Measurer {
                        answers: &answers,
                        samples: &samples,
                        whole,
                    };
                    one_sample(session, &measurer, &base, found, lean)?
                }
            }
        }
    };
    let fails = sampled.vacuum;
    found.parts.vacuum_fails = match (fails.part_fails, fails.whole_fails) {
        (true, _) => Some(VacuumFails::Segment),
        (false, true) => Some(VacuumFails::Ray),
        (false, false) => None,
    };
    found.parts.grain = sampled.grain;
    let answers = Answers {
        grain: sampled.grain,
        ..answers
    };
    let terms = holdout::Terms {
        answers: &answers,
        typical: sampled.typical,
        no_vacuum: fails.part_fails,
        negative: mapped.takes_negative,
    };
    // What was found out is tried on rays that know nothing of it.
    (session.pose, session.divides) = (poses, divides);
    found.hold_out = match &found.optics {
        Some(optics) => volume::hold_out(session, &sampled.rule, optics, &terms)?,
        None => holdout::hold_out(session, &sampled.rule, &terms)?,
    };
    found.rule = Some(sampled.rule);
    Ok(())
}

/// Where a kernel looks that may look anywhere; rays are made for these places from then on. Whether it takes so many
/// samples only.
fn look(
    session: &mut Session<'_>,
    answers: &Answers,
    found: &mut Identification,
) -> Result<bool, NotIdentified> {
    let lattice = match session.pose.form {
        FormKind::Segments => return Ok(false),
        FormKind::Volume => {
            let optics = volume::optics(session, answers)?;
            session.pose.places = pose::Known::Volume(optics);
            found.optics = Some(optics);
            optics.lattice
        }
        FormKind::Formula(_) | FormKind::Function => match free_places::places(session, answers)? {
            free_places::Places::Nodes => return Ok(false),
            free_places::Places::Lattice(lattice) => {
                session.pose.places = pose::Known::Lattice(lattice);
                lattice
            }
        },
    };
    let Lattice::Even { count, .. } = lattice else {
        return Ok(false);
    };
    session.divides = true;
    if count.each == 0 {
        session.most_samples = count.of(1);
    }
    Ok(count.each == 0)
}

/// The rule of segments with several values.
fn several(
    session: &mut Session<'_>,
    answers: &Answers,
    base: &Rule,
) -> Result<Sampled, NotIdentified> {
    let mut rule = Rule {
        scheme: segment::segments(session, answers)?,
        ..base.clone()
    };
    let vacuum = ends::failures(session, 1.0 / 8.0)?;
    let behind = ends::behind(session, answers, 1.0 / 8.0, &rule, !vacuum.whole_fails)?;
    (rule.background, rule.offset) = (behind.background, behind.offset);
    Ok(Sampled {
        rule,
        grain: 0.0,
        typical: 1.0,
        vacuum,
    })
}

/// The rule of one sample a segment.
fn one_sample(
    session: &mut Session<'_>,
    measurer: &Measurer<'_>,
    base: &Rule,
    found: &mut Identification,
    lean: bool,
) -> Result<Sampled, NotIdentified> {
    let samples: &Samples = measurer.samples;
    let measured = opacity::measure(session, measurer, lean)?;
    let reference = measured.reference(0.25).map_or(0.125, |r| r.extinction);
    let vacuum = ends::vacuum(session, measurer, reference)?;
    let fitted = opacity::law(session, measurer, &measured, vacuum.eps)?;
    let law: Law = fitted.law;
    let brackets = &mut found.brackets;
    let mut keep = |parameter, bracket: (f64, f64)| {
        brackets.push(Bracket::of(parameter, bracket));
    };
    keep(Parameter::Factor, fitted.factor);
    keep(Parameter::Scale, fitted.scale);
    for bracket in &fitted.brackets {
        keep(bracket.parameter, (bracket.low, bracket.high));
    }
    if vacuum.eps != 0.0 {
        keep(Parameter::Eps, vacuum.bracket);
    }
    let lone = Lone {
        measurer,
        law: &law,
        measured: &measured,
    };
    let mut rule = Rule {
        scheme: Scheme::Sample {
            place: samples.place,
            law: law.clone(),
        },
        sequence: samples.sequence,
        whole: measurer.whole,
        ..base.clone()
    };
    if samples.wall {
        let walled = ends::wall(session, &lone)?;
        rule.wall = Some(walled.wall);
        if let (Some(whole), Whole::One) = (walled.whole, rule.whole)
            && samples.sequence.first == End::Once
        {
            rule.whole = whole;
        }
        if matches!(walled.wall, Wall::Length(_)) {
            keep(Parameter::Wall, walled.bracket);
        }
    }
    if let Some(early) = ends::early_end(session, &lone)? {
        keep(Parameter::Stop, early.bracket);
        rule.stop = Some(early.stop);
    }
    rule.sequence = ends::counts(session, &lone, &rule, lean)?;
    let has_vacuum = !vacuum.whole_fails && !vacuum.part_fails;
    let behind = ends::behind(session, measurer.answers, reference, &rule, has_vacuum)?;
    (rule.background, rule.offset) = (behind.background, behind.offset);
    if behind.background != 0.0 {
        keep(Parameter::Background, behind.of_background);
    }
    if behind.offset != 0.0 {
        keep(Parameter::Offset, behind.of_offset);
    }
    let answers = Answers {
        grain: fitted.grain,
        ..measurer.answers.clone()
    };
    match ends::last_step(session, &answers, &rule, 6.1 * reference)? {
        Some(with_last) => rule = with_last,
        None => found.not_identified.push(NotIdentified::new(
            "a shorter last segment counts in no known way",
        )),
    }
    let typical = measured.reference(1.0).map_or(1.0, |r| 32.0 * r.extinction);
    Ok(Sampled {
        rule,
        grain: fitted.grain,
        typical,
        vacuum,
    })
}
