//! Seeded defects are flagged and named, and correct kernels are neither.

mod correct;
mod defects;
mod marcher;

use volver::case::catalogue;
use volver::case::manufacture::manufacture;
use volver::convergence::Ladder;
use volver::kernel::{Kernel, Subject};
use volver::study::Silent;
use volver::study::verify::{Settings, Steps, Verification, verify};

/// Thin and thick, faint and long, smooth and not, one of them beyond binary32's range: 25 channels.
const CASES: [&str; 23] = [
    "absorption-only",
    "atmosphere",
    "cloud",
    "constant-source",
    "decaying-field",
    "emission-back",
    "emission-bump",
    "emission-front",
    "faint",
    "faint-long",
    "homogeneous",
    "hyperbolic-tangent",
    "jump-on-node",
    "kink-off-node",
    "linear-transfer",
    "long-ray",
    "oscillating-field",
    "rgb-transfer",
    "sine-squared",
    "square-root-field",
    "steep-ramp",
    "thick",
    "thick-front",
];

fn subjects() -> Vec<Subject> {
    let subject = |name: &&str| {
        let description = catalogue::find(name).expect("in the catalogue").unwrap();
        let channels = manufacture(&description).unwrap();
        let channels = channels.into_iter().map(|c| (c.channel, c.case)).collect();
        Subject::new(name, channels).unwrap()
    };
    CASES.iter().map(subject).collect()
}

fn run(kernel: &mut dyn Kernel, subjects: &[Subject], ladder: &str, uneven: bool) -> Verification {
    let ladder: Ladder = ladder.parse().expect("a ladder");
    let mut settings = Settings::new(&ladder).unwrap();
    settings.steps = if uneven { Steps::Uneven } else { Steps::Divide };
    verify(kernel, subjects, &settings, &Silent, &mut |_| ()).unwrap()
}
