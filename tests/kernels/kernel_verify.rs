//! Verification as a library, on kernels that are right in one way and wrong in another.

mod answers;
mod arithmetic;
mod background;
mod baseline;
mod beyond;
mod channels;
mod emission;
mod ladder;
mod quantum;
mod said;
mod stochastic;
mod uneven;
mod volume;
mod wall;

use volver::case::catalogue;
use volver::case::file::Description;
use volver::case::manufacture::manufacture;
use volver::convergence::{Ladder, Sample};
use volver::kernel::{Declaration, Kernel, Segments, Subject};
use volver::study::Silent;
use volver::study::verify::{
    Identified, Line, Measured, Settings, Standing, Steps, Verification, verify,
};

/// Smooth cases in which nothing hides an error: thin and thick, short and long, with one channel and three.
const SMOOTH: [&str; 8] = [
    "cloud",
    "decaying-field",
    "emission-bump",
    "hyperbolic-tangent",
    "linear-transfer",
    "rgb-transfer",
    "sine-squared",
    "thick",
];

pub(crate) fn subjects(names: &[&str]) -> Vec<Subject> {
    let subject =
        |name: &&str| of_description(&catalogue::find(name).expect("in the catalogue").unwrap());
    names.iter().map(subject).collect()
}

fn of_description(description: &Description) -> Subject {
    let channels = manufacture(description).unwrap();
    let channels = channels.into_iter().map(|c| (c.channel, c.case)).collect();
    Subject::new(&description.name, channels).unwrap()
}

/// By steps that divide the ray.
fn settings(ladder: &str) -> Settings {
    let ladder: Ladder = ladder.parse().expect("a ladder");
    Settings {
        steps: Steps::Divide,
        ..Settings::new(&ladder).unwrap()
    }
}

fn run(kernel: &mut dyn Kernel, subjects: &[Subject], settings: &Settings) -> Verification {
    verify(kernel, subjects, settings, &Silent, &mut |_| ()).unwrap()
}

/// A deterministic kernel in binary64 that means to be a method.
fn declared(method: &str) -> Declaration {
    Declaration {
        method: Some(method.parse().expect("a method")),
        ..Declaration::new("under test")
    }
}

/// Front to back, of (τ, C, length) of every sample.
fn composite(samples: impl IntoIterator<Item = (f64, f64, f64)>) -> f64 {
    let (mut radiance, mut transmittance) = (0.0, 1.0);
    for (extinction, emission, length) in samples {
        let alpha = -(-extinction * length).exp_m1();
        radiance += transmittance * alpha * emission;
        transmittance *= 1.0 - alpha;
    }
    radiance
}

/// (τ, C, length) in the front of every segment.
fn front(segments: &Segments, channel: usize) -> Vec<(f64, f64, f64)> {
    let edges = &segments.edges;
    let values = edges.extinction.iter().zip(&edges.emission[channel]);
    let both = values.zip(segments.lengths());
    both.map(|((t, c), length)| (*t, *c, length)).collect()
}

/// Errors and steps that orders are fitted to.
fn samples(line: &Line) -> &[Sample] {
    match &line.measured {
        Measured::Fitted { samples, .. } => samples,
        other => panic!("{}: {other:?}", line.name),
    }
}

/// Lines that stand so, in parts of all.
fn part(verification: &Verification, standing: Standing) -> f64 {
    let lines = &verification.lines;
    let these = lines.iter().filter(|line| line.standing == standing);
    these.count() as f64 / lines.len() as f64
}

/// What a failing test shows.
fn shown(verification: &Verification) -> String {
    let line = |line: &Line| {
        let (name, standing) = (&line.name, line.standing);
        let verdict = line.measured.verdict();
        let order = line.measured.order();
        let pairs: Vec<f64> = match &line.measured {
            Measured::Fitted { fit, .. } => fit.pairs.iter().map(|pair| pair.order).collect(),
            _ => Vec::new(),
        };
        format!(
            "{name} {standing} {verdict} {order:?} of {:?}: {pairs:.4?}\n",
            line.expected
        )
    };
    let lines: String = verification.lines.iter().map(line).collect();
    let said = rule(verification);
    let deviations = deviations(verification);
    format!("{lines}{said}\n{deviations:?} {:?}", verification.findings)
}

/// What it is found to compute.
fn rule(verification: &Verification) -> String {
    let identified = verification.identification.as_ref();
    let named = identified.and_then(Identified::named);
    named.map_or("not identified".into(), ToString::to_string)
}

/// In what that deviates.
fn deviations(verification: &Verification) -> Vec<&'static str> {
    let identified = verification.identification.iter();
    let all = identified.flat_map(|identified| &identified.examined.deviations);
    all.map(|deviation| deviation.name).collect()
}
