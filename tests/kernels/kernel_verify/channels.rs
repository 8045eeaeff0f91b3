//! Kernels that take rays of some kinds alone: of so many channels, or of no negative emission.

use super::{composite, deviations, front, of_description, rule, run, settings, shown, subjects};
use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex};
use volver::case::file::Description;
use volver::identify::{Budget, Verdict, examine};
use volver::kernel::{Closure, Declaration, Kernel, Task};
use volver::study::verify::Conclusion;

const CASES: [&str; 3] = ["rgb-transfer", "sine-squared", "cloud"];

/// Rays of three channels and of one, asked by two, by four, by one.
#[test]
fn channels_are_asked_by_as_many_as_are_taken() {
    let verified = |channels: usize| {
        let declaration = Declaration {
            channels: NonZeroUsize::new(channels),
            ..super::declared("front-to-back/front/expm1")
        };
        let seen = Arc::new(Mutex::new(BTreeSet::new()));
        let kept = Arc::clone(&seen);
        let mut kernel = Closure::new(declaration, move |task: &Task<'_>, channel| {
            kept.lock().unwrap().insert(task.subject.channels().len());
            composite(front(task.cut().expect("segments"), channel))
        });
        let verification = run(&mut kernel, &subjects(&CASES), &settings("8..256"));
        let seen = seen.lock().unwrap().clone();
        (verification, seen)
    };
    let (whole, _) = verified(0);
    for channels in [1, 2, 4] {
        let (pieces, seen) = verified(channels);
        assert_eq!(seen, BTreeSet::from([channels]), "no other rays are asked");
        assert_eq!(pieces.conclusion(), Conclusion::Confirmed);
        // Every answer stands at its own channel.
        assert_eq!(pieces.lines, whole.lines);
        assert_eq!(deviations(&pieces), [""; 0]);
        // One by one there are too few rays for all questions.
        if channels == 4 {
            assert_eq!(rule(&pieces), rule(&whole));
        }
    }
}

/// The smallest C that a kernel was given.
type Least = Arc<Mutex<f64>>;

/// A kernel that takes no negative emission, and one that would make something of it.
fn positive(positive_emission: bool) -> (impl Kernel, Least) {
    let declaration = Declaration {
        positive_emission,
        ..super::declared("front-to-back/front/expm1")
    };
    let least = Arc::new(Mutex::new(f64::INFINITY));
    let kept = Arc::clone(&least);
    let kernel = Closure::new(declaration, move |task: &Task<'_>, channel| {
        let segments = task.cut().expect("segments");
        let all = [&segments.edges, &segments.middles].into_iter();
        let all = all.flat_map(|samples| &samples.emission[channel]);
        let smallest = all.copied().fold(f64::INFINITY, f64::min);
        let mut least = kept.lock().unwrap();
        *least = least.min(smallest);
        if smallest < 0.0 {
            return f64::NAN;
        }
        composite(front(segments, channel))
    });
    (kernel, least)
}

/// C = 1 − t, negative behind a depth of 1: I = ∫ (1 − t) e^(−t) dt = t e^(−t).
const NEGATIVE: &str = r#"
    name = "negative-behind"
    title = "Emission that ends negative"
    length = "1"
    depth = "lambda + lambda^2"
    emission_of_depth = "1 - t"
    derivation = "(t exp(-t))' = (1 - t) exp(-t) t'"
"#;

#[test]
fn cases_of_negative_emission_are_left_out_and_counted() {
    let mut all = subjects(&["sine-squared", "cloud"]);
    all.insert(1, of_description(&Description::read(NEGATIVE).unwrap()));
    let (mut kernel, least) = positive(true);
    let verification = run(&mut kernel, &all, &settings("8..256"));
    let shown = shown(&verification);
    assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{shown}");
    assert_eq!(verification.left_out, ["negative-behind"]);
    assert_eq!(verification.lines.len(), 2);
    let said = &verification.findings[0];
    assert!(said.words.starts_with("1 case left out"), "{said:?}");
    assert_eq!(said.channels, ["negative-behind"]);
    assert!(*least.lock().unwrap() >= 0.0);
    let (mut kernel, least) = positive(false);
    let verification = run(&mut kernel, &all, &settings("8..256"));
    assert_eq!(verification.conclusion(), Conclusion::NotConfirmed);
    assert!(verification.left_out.is_empty());
    assert!(*least.lock().unwrap() < 0.0);
}

#[test]
fn probes_of_a_kernel_that_takes_no_negative_emission_have_none() {
    let (mut kernel, least) = positive(true);
    let examined = examine(&mut kernel, Budget::default(), &mut |_| ());
    assert_eq!(examined.verdict(), Verdict::Right);
    assert!(*least.lock().unwrap() >= 0.0);
    // Nor have those that seek the smallest ray of a kernel that deviates.
    let least = Arc::new(Mutex::new(f64::INFINITY));
    let kept = Arc::clone(&least);
    let declaration = Declaration {
        positive_emission: true,
        ..super::declared("front-to-back/front/expm1")
    };
    let mut kernel = Closure::new(declaration, move |task: &Task<'_>, channel| {
        let segments = task.cut().expect("segments");
        let all = segments.edges.emission[channel].iter();
        let mut least = kept.lock().unwrap();
        *least = all.copied().fold(*least, f64::min);
        let samples = front(segments, channel);
        let count = samples.len() - 1;
        composite(samples.into_iter().take(count))
    });
    let examined = examine(&mut kernel, Budget::default(), &mut |_| ());
    assert_eq!(examined.verdict(), Verdict::Deviates);
    assert!(*least.lock().unwrap() >= 0.0);
}
