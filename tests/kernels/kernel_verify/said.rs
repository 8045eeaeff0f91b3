//! What a kernel says beside its radiance, and whether it says the same twice.

use super::{SMOOTH, composite, part, run, samples, settings, shown, subjects};
use rug::Float;
use std::fmt;
use volver::convergence::Verdict;
use volver::kernel::{
    Closure, Declaration, FormKind, Kernel, KernelError, MAX_TASK_SEGMENTS, Rendering, Task,
};
use volver::study::verify::{Conclusion, Settings, Standing, Verification};

/// One sample in the middle of segments whose number the kernel chooses itself, and what it says of that.
struct Own {
    declaration: Declaration,
    chosen: fn(u64) -> u64,
    says: fn(&mut Rendering, f64, u64),
}

impl Own {
    fn new(chosen: fn(u64) -> u64, says: fn(&mut Rendering, f64, u64)) -> Self {
        Own {
            declaration: Declaration {
                form: FormKind::Function,
                order: Some(2.0),
                ..Declaration::new("its own")
            },
            chosen,
            says,
        }
    }
}

impl fmt::Debug for Own {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Own")
    }
}

impl Kernel for Own {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let n = (self.chosen)(task.segments);
        let length = task.subject.length().to_f64();
        let step = length / n as f64;
        let channels = task.subject.channels().len();
        let radiance = |channel| {
            let mut emission = vec![0.0; channels];
            let radiance = composite((0..n).map(|j| {
                let extinction = task.subject.at((j as f64 + 0.5) * step, &mut emission);
                (extinction, emission[channel], step)
            }));
            Float::with_val(53, radiance)
        };
        let mut rendering = Rendering {
            radiance: (0..channels).map(radiance).collect(),
            ..Rendering::default()
        };
        (self.says)(&mut rendering, step, n);
        Ok(rendering)
    }
}

fn power_of_three(n: u64) -> u64 {
    let mut powers = std::iter::successors(Some(1), |power| Some(3 * power));
    powers.find(|power| *power >= n).expect("powers do not end")
}

fn levels(verification: &Verification) -> Vec<Option<u64>> {
    samples(&verification.lines[0])
        .iter()
        .map(|s| s.n)
        .collect()
}

/// It knows 9, 27, 81 …: asked for 8, 16, …, 1024, some twice.
#[test]
fn orders_are_fitted_to_what_was_used() {
    let ways: [fn(&mut Rendering, f64, u64); 3] = [
        |said, step, _| said.step = Some(step),
        |said, _, n| said.segments = Some(n),
        |said, step, n| (said.step, said.segments) = (Some(step), Some(n)),
    ];
    for says in ways {
        let mut kernel = Own::new(power_of_three, says);
        let verification = run(&mut kernel, &subjects(&SMOOTH), &settings("8..1024"));
        let shown = shown(&verification);
        let used = [9, 27, 81, 243, 729, 2187].map(Some);
        assert_eq!(levels(&verification), used, "{shown}");
        for line in &verification.lines {
            let steps = samples(line).windows(2);
            let ratios = steps.map(|pair| pair[0].step / pair[1].step);
            assert!(ratios.into_iter().all(|ratio| (ratio - 3.0).abs() < 1e-9));
        }
        assert!(part(&verification, Standing::Confirmed) > 0.8, "{shown}");
        assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{shown}");
    }
}

/// Who says nothing is taken to have used what was asked for.
#[test]
fn orders_of_a_kernel_that_keeps_silent_are_others() {
    let mut kernel = Own::new(power_of_three, |_, _, _| ());
    let verification = run(&mut kernel, &subjects(&SMOOTH), &settings("8..1024"));
    let shown = shown(&verification);
    assert_eq!(part(&verification, Standing::Confirmed), 0.0, "{shown}");
    assert_eq!(verification.conclusion(), Conclusion::NotConfirmed);
}

#[test]
fn a_kernel_that_does_not_refine_has_too_few_levels() {
    let mut kernel = Own::new(|_| 64, |said, step, _| said.step = Some(step));
    let verification = run(&mut kernel, &subjects(&["cloud"]), &settings("8..512"));
    assert_eq!(levels(&verification), [Some(64)]);
    let verdict = verification.lines[0].measured.verdict();
    assert_eq!(verdict, Verdict::TooFewLevels);
    assert_eq!(verification.conclusion(), Conclusion::NotConfirmed);
}

/// Rays that cannot be are no answers, and cost no other answer.
#[test]
fn what_cannot_have_been_used_is_a_failure_of_that_level() {
    let ways: [fn(&mut Rendering, f64, u64); 5] = [
        |said, _, n| said.segments = Some(if n == 64 { 0 } else { n }),
        |said, _, n| {
            said.segments = Some(if n == 64 { MAX_TASK_SEGMENTS + 1 } else { n });
        },
        |said, step, n| said.step = Some(if n == 64 { f64::NAN } else { step }),
        |said, step, n| said.step = Some(if n == 64 { -step } else { step }),
        |said, step, n| said.step = Some(if n == 64 { 1e-300 } else { step }),
    ];
    for says in ways {
        let mut kernel = Own::new(|n| n, says);
        let verification = run(&mut kernel, &subjects(&["cloud"]), &settings("8..512"));
        let [line] = &verification.lines[..] else {
            panic!("one channel");
        };
        assert_eq!(line.standing, Standing::Failed);
        let failed = line.failures.iter().map(|failure| failure.segments);
        assert_eq!(failed.collect::<Vec<u64>>(), [64]);
        assert!(matches!(line.failures[0].error, KernelError::Used { .. }));
        assert_eq!(samples(line).len(), 6);
    }
}

#[test]
fn answers_that_differ_are_contradicted_and_said() {
    let mut count = 0.0;
    let mut kernel = Closure::segments("restless", move |segments, channel| {
        count += 1.0;
        composite(super::front(segments, channel)) * (1.0 + 1e-13 * count)
    });
    let verification = run(&mut kernel, &subjects(&SMOOTH), &settings("8..256"));
    let shown = shown(&verification);
    assert_eq!(part(&verification, Standing::Contradicted), 1.0, "{shown}");
    assert!(verification.lines.iter().all(|line| !line.steady));
    let finding = &verification.findings[0];
    let words = "answers differ from run to run, and the kernel is said to be deterministic";
    assert_eq!(finding.words, words);
    assert_eq!(finding.channels.len(), verification.lines.len());
    // Values that change are nobody's.
    assert_eq!(verification.as_declared(), None);
}

#[test]
fn nan_is_an_answer_and_it_contradicts() {
    let mut kernel = Closure::segments("nan", |segments, channel| {
        let radiance = composite(super::front(segments, channel));
        if segments.count() == 32 {
            f64::NAN
        } else {
            radiance
        }
    });
    let verification = run(&mut kernel, &subjects(&["cloud"]), &settings("8..256"));
    let line = &verification.lines[0];
    assert_eq!(line.standing, Standing::Contradicted);
    assert_eq!(line.measured.verdict(), Verdict::NotFinite);
    assert!(line.steady && line.is_complete());
}

/// Half of the light on one case alone, which no probe sees; its rule is still that of all others.
#[test]
fn a_case_that_is_answered_otherwise_is_named() {
    let mut kernel = Closure::new(
        super::declared("front-to-back/front/expm1"),
        |task, channel| {
            let segments = task.cut().expect("segments are asked for");
            let radiance = composite(super::front(segments, channel));
            let part = if task.subject.name() == "cloud" {
                0.5
            } else {
                1.0
            };
            part * radiance
        },
    );
    let verification = run(&mut kernel, &subjects(&SMOOTH), &settings("8..256"));
    let shown = shown(&verification);
    let identified = verification.identification.as_ref().unwrap();
    assert_eq!(identified.differs, ["cloud"], "{shown}");
    assert!(identified.named().is_some(), "{shown}");
    assert!(verification.deviates(), "{shown}");
    assert_eq!(
        verification.conclusion(),
        Conclusion::NotConfirmed,
        "{shown}"
    );
}

/// Orders are confirmed, and nothing is seen behind a transmittance of 1e-6.
#[test]
fn a_deviation_makes_no_confirmation_of_an_order_until_it_is_accepted() {
    let declaration = Declaration {
        order: Some(1.0),
        ..Declaration::new("under test")
    };
    let march = |segments: &volver::kernel::Segments, channel: usize| {
        let (mut radiance, mut transmittance) = (0.0, 1.0);
        for (extinction, emission, length) in super::front(segments, channel) {
            let alpha = -(-extinction * length).exp_m1();
            radiance += transmittance * alpha * emission;
            transmittance *= 1.0 - alpha;
            if transmittance < 1e-6 {
                break;
            }
        }
        radiance
    };
    let verified = |accept: &[&str]| {
        let mut kernel = Closure::new(declaration.clone(), move |task, channel| {
            march(task.cut().expect("segments are asked for"), channel)
        });
        let settings = Settings {
            accept: accept.iter().map(|one| one.parse().unwrap()).collect(),
            ..settings("8..256")
        };
        run(
            &mut kernel,
            &subjects(&["sine-squared", "cloud"]),
            &settings,
        )
    };
    // No ray of these is so deep that it shows in an order.
    let found = verified(&[]);
    assert_eq!(part(&found, Standing::Contradicted), 0.0);
    assert_eq!(super::deviations(&found), ["early-end"]);
    assert_eq!(found.conclusion(), Conclusion::NotConfirmed);
    let off = |accept: &str| verified(&[accept]).conclusion() == Conclusion::Confirmed;
    assert!(off("early-end=1e-6") && off("early-end"));
    assert!(!off("early-end=1.02e-6") && !off("last-sample"));
}
