//! What a kernel computes, read off by probes.
//!
//! A kernel is asked rays that are made to tell: emission in one node alone shows the node's weight, an extinction
//! raised shows what it acts on, segments between references show what they add and let through. Each stage reads a
//! part of the [`Rule`] off, or says that it could not and what it measured; a rule is named where it predicts the
//! answers to rays that it was not found with.

mod accumulation;
mod against;
mod channels;
mod covered;
mod curves;
mod depths;
mod deviation;
mod ends;
mod examined;
mod expected;
mod exponential;
mod finding;
mod free_places;
mod gradient;
mod holdout;
mod identification;
mod influence;
mod least_squares;
mod number;
mod opacity;
mod opacity_answered;
mod output;
mod part;
mod places;
mod pose;
mod precision;
pub(crate) mod random;
mod ray;
pub mod rule;
mod scattered;
mod seams;
mod seen;
mod segment;
mod session;
mod silence;
mod stages;
mod state;
mod stated;
mod together;
mod transmittance;
mod volume;
mod weights;
mod witness;

pub use accumulation::Accumulation;
pub use against::{Against, Difference, Known, against, differences};
pub use deviation::{Deviation, deviations, misbehaviour, right_of};
pub(crate) use examined::examine_for;
pub use examined::{Examined, Verdict, examine};
pub use exponential::Exponential;
pub use finding::NotIdentified;
pub use gradient::{GradientFound, GradientsTogether, Off, gradients};
pub use holdout::{HoldOut, Kind, Miss};
pub use identification::{Bracket, Identification, Parameter, Parts, VacuumFails};
#[cfg(feature = "studies")]
pub(crate) use number::simplest;
pub(crate) use opacity_answered::NAME as OPACITY_ANSWERED;
pub use opacity_answered::OpacityAnswered;
pub use part::{Part, Stated, parts};
pub use precision::Precision;
pub use ray::Ray;
pub use rule::Rule;
pub use scattered::Scattered;
pub use seen::Seen;
pub use session::{Budget, Spent};
pub use silence::Silence;
pub use state::{Batch, Name, Repeat, State};
pub use stated::stated;
pub use together::{Apart, TOGETHER, Together, together};
pub use transmittance::Transmittance;
pub use volume::{Lookup, Optics};
pub use witness::{TaskError, Witness, witness};

use crate::kernel::{Declaration, FormKind, Kernel, Quantum};
use crate::method::{Layers, Method};
use rule::{Channels, Output, Scheme};
use session::Session;
use stages::run;
use weights::Answers;

/// Reads off what a kernel computes; `heard` hears of every ray.
pub fn identify(
    kernel: &mut dyn Kernel,
    budget: Budget,
    heard: &mut dyn FnMut(&Spent),
) -> Identification {
    let mut found = Identification::default();
    if let Some(reason) = silent(kernel.declaration()) {
        found.not_identified.push(NotIdentified::new(reason));
        return found;
    }
    let mut session = Session::new(kernel, budget, heard);
    if let Err(reason) = run(&mut session, &mut found) {
        found.not_identified.push(reason);
    }
    if found.named().is_none()
        && let Some((layers, hold_out)) = by_method(&mut session, &found)
    {
        found.rule = None;
        found.not_identified.clear();
        found.method = Some(Method::Layered(layers));
        found.hold_out = hold_out;
    }
    found.spent = session.spent;
    found
}

/// The method that states no rule, and all of whose answers a kernel has: what is seen of ends of segments, and as it is
/// computed.
fn by_method(session: &mut Session<'_>, found: &Identification) -> Option<(Layers, HoldOut)> {
    let is_plain = found.parts.output == Some(Output::default())
        && found.state == Some(State::default())
        && session.pose.form == FormKind::Segments
        && session.channels == Channels::Straight;
    let answers = Answers {
        unit: found.parts.unit?,
        noise: found.parts.noise,
        ..Answers::default()
    };
    let terms = holdout::Terms {
        answers: &answers,
        typical: 1.0,
        no_vacuum: false,
        by_name: false,
        negative: !session.positive,
        right: None,
    };
    let named = is_plain.then(|| holdout::by_method(session, &terms))?;
    named.ok().flatten()
}

/// Why nothing is read off answers that are as declared: probes are brighter and fainter by orders of magnitude, and small
/// differences of answers are what tells parts of a rule apart.
fn silent(declaration: &Declaration) -> Option<&'static str> {
    match (declaration.noise, declaration.quantum) {
        (Some(_), _) => Some("answers are off by chance, as the kernel declares"),
        (None, Some(Quantum::Relative(_))) => Some(
            "answers are multiples of a part of each ray's largest emission, as the kernel declares",
        ),
        (None, Some(Quantum::Absolute(_)) | None) => None,
    }
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
        by_name: false,
        negative: !session.positive,
        right: None,
    };
    holdout::hold_out(&mut session, rule, &terms)
}
