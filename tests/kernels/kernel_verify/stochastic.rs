//! Kernels that draw random numbers: their scatter has the order, not one answer.

use super::{SMOOTH, composite, deviations, part, run, settings, shown, subjects};
use rug::Float;
use volver::kernel::{
    Closure, Declaration, FormKind, Kernel, KernelError, Rendering, Sampling, Task,
};
use volver::study::verify::{Conclusion, Measured, Settings, Standing, Verification};

const LADDER: &str = "16..256";

/// `SplitMix64`: numbers from 0 to 1.
struct Random(u64);

impl Random {
    /// A stream of its own for every ray, level and seed.
    fn new(task: &Task<'_>) -> Self {
        let name = task.subject.name().bytes();
        let name = name.fold(0, |hash: u64, byte| hash * 31 % 1_000_003 + u64::from(byte));
        let mut mixed = Random(task.seed);
        for part in [task.segments, name] {
            mixed = Random(mixed.bits() ^ part);
        }
        mixed
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn part(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / 53_f64.exp2()
    }
}

fn declared(order: f64) -> Declaration {
    Declaration {
        form: FormKind::Function,
        order: Some(order),
        stochastic: true,
        sampling: Some(Sampling::Jittered),
        ..Declaration::new("jittered")
    }
}

/// One sample somewhere in every segment.
fn jittered(task: &Task<'_>, channel: usize) -> f64 {
    let mut random = Random::new(task);
    let mut emission = vec![0.0; task.subject.channels().len()];
    composite((0..task.segments).map(|j| {
        let lambda = (j as f64 + random.part()) * task.step;
        let extinction = task.subject.at(lambda, &mut emission);
        (extinction, emission[channel], task.step)
    }))
}

fn verified(kernel: &mut dyn Kernel) -> Verification {
    run(kernel, &subjects(&SMOOTH), &settings(LADDER))
}

/// Errors of n independent samples, each of order 2, add up to n^½ d² = d^(3⁄2).
#[test]
fn one_sample_somewhere_in_every_segment_has_order_three_halves() {
    let verification = verified(&mut Closure::new(declared(1.5), jittered));
    let shown = shown(&verification);
    assert!(part(&verification, Standing::Confirmed) > 0.8, "{shown}");
    assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{shown}");
    assert_eq!(verification.as_declared(), None);
    let identified = verification.identification.as_ref().unwrap();
    let scattered = identified.examined.found.scattered.as_ref().unwrap();
    let words = "samples somewhere in their segments, each drawn evenly by the seed";
    assert_eq!(scattered.to_string().lines().last(), Some(words));
    assert_eq!(deviations(&verification), [""; 0], "{shown}");
    let mut findings = verification.findings.iter();
    assert!(!findings.any(|finding| finding.wrong), "{shown}");
}

#[test]
fn no_other_order_is_confirmed() {
    for order in [0.5, 2.5] {
        let verification = verified(&mut Closure::new(declared(order), jittered));
        let shown = shown(&verification);
        let most = 1.0 / verification.lines.len() as f64;
        assert!(part(&verification, Standing::Confirmed) <= most, "{shown}");
        // An order that is only claimed is the least that may show.
        if order > 1.5 {
            assert_eq!(verification.conclusion(), Conclusion::NotConfirmed);
        }
    }
}

#[test]
fn as_many_seeds_are_asked_as_is_said() {
    let settings = Settings {
        replicas: 12,
        ..settings(LADDER)
    };
    let mut kernel = Closure::new(declared(1.5), jittered);
    let verification = run(&mut kernel, &subjects(&["cloud"]), &settings);
    let [line] = &verification.lines[..] else {
        panic!("one channel");
    };
    let Measured::Scattered(fit) = &line.measured else {
        panic!("{line:?}");
    };
    assert_eq!(fit.replicas, 12);
}

#[test]
fn a_kernel_that_ignores_its_seed_is_not_confirmed() {
    for order in [1.5, 2.0] {
        let mut kernel = Closure::new(declared(order), |task, channel| {
            let whatever = Task { seed: 7, ..*task };
            jittered(&whatever, channel)
        });
        let verification = verified(&mut kernel);
        let shown = shown(&verification);
        assert_eq!(part(&verification, Standing::Confirmed), 0.0, "{shown}");
        assert_eq!(
            verification.conclusion(),
            Conclusion::NotConfirmed,
            "{shown}"
        );
    }
}

/// Without the word it is one whose answers differ.
#[test]
fn a_kernel_that_does_not_say_that_it_draws_is_contradicted() {
    let declaration = Declaration {
        stochastic: false,
        ..declared(1.5)
    };
    let verification = verified(&mut Closure::new(declaration, jittered));
    let shown = shown(&verification);
    assert_eq!(part(&verification, Standing::Contradicted), 1.0, "{shown}");
    assert!(
        verification.findings[0].words.starts_with("answers differ"),
        "{shown}"
    );
    assert_eq!(deviations(&verification), ["seed"], "{shown}");
}

/// Words of what was found, and whether they speak against the kernel.
fn found<'a>(verification: &'a Verification, words: &str) -> Option<(&'a str, bool)> {
    let mut findings = verification.findings.iter();
    let finding = findings.find(|one| one.words.contains(words))?;
    Some((&finding.words, finding.wrong))
}

/// A thousandth too bright: a few standard errors at first, then seventeen and more.
#[test]
fn a_mean_that_is_off_is_contradicted() {
    let mut kernel = Closure::new(declared(1.5), |task, channel| {
        1.001 * jittered(task, channel)
    });
    let verification = verified(&mut kernel);
    let shown = shown(&verification);
    assert_eq!(
        verification.conclusion(),
        Conclusion::NotConfirmed,
        "{shown}"
    );
    let (words, wrong) = found(&verification, "the mean is off").expect("said");
    assert!(wrong, "{words}");
    let all = verification.lines.iter();
    let off = all.filter(|line| line.standing == Standing::Contradicted);
    for line in off {
        let Measured::Scattered(fit) = &line.measured else {
            panic!("{line:?}");
        };
        let most = fit.most_biased().expect("a mean that is off");
        assert!(most.mean.abs() > 5.0 * most.standard_error);
    }
    // Of the right kernel nothing of the kind is said.
    let right = verified(&mut Closure::new(declared(1.5), jittered));
    assert_eq!(found(&right, "the mean is off"), None);
}

/// n samples anywhere on the ray, each of them C τ T D with the exact T, and their standard error times a factor.
#[derive(Debug)]
struct MonteCarlo {
    declaration: Declaration,
    factor: f64,
}

impl Kernel for MonteCarlo {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let mut random = Random::new(task);
        let mut emission = vec![0.0; task.subject.channels().len()];
        let length = task.subject.length().to_f64();
        let count = task.segments as f64;
        let mut values = vec![Vec::new(); emission.len()];
        for _ in 0..task.segments {
            let lambda = length * random.part();
            // The depth in front of it, by samples in the middles of 64 segments.
            let depths = (0..64).map(|j| {
                let at = lambda * (f64::from(j) + 0.5) / 64.0;
                task.subject.at(at, &mut emission) * lambda / 64.0
            });
            let passes = (-depths.sum::<f64>()).exp();
            let extinction = task.subject.at(lambda, &mut emission);
            for (values, emission) in values.iter_mut().zip(&emission) {
                values.push(emission * extinction * passes * length);
            }
        }
        let mean = |values: &Vec<f64>| values.iter().sum::<f64>() / count;
        let error = |values: &Vec<f64>| {
            let mean = mean(values);
            let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
            (squares / (count - 1.0) / count).sqrt()
        };
        Ok(Rendering {
            radiance: values
                .iter()
                .map(|v| Float::with_val(53, mean(v)))
                .collect(),
            standard_error: Some(values.iter().map(|v| self.factor * error(v)).collect()),
            ..Rendering::default()
        })
    }
}

#[test]
fn a_standard_error_that_is_not_the_scatter_is_contradicted() {
    for (factor, right) in [(1.0, true), (10.0, false), (0.1, false)] {
        let mut kernel = MonteCarlo {
            declaration: Declaration {
                sampling: None,
                ..declared(0.5)
            },
            factor,
        };
        let verification = verified(&mut kernel);
        let shown = shown(&verification);
        let words = found(&verification, "standard errors that it reports");
        assert_eq!(words.is_none(), right, "{factor}: {words:?}");
        assert_eq!(
            part(&verification, Standing::Contradicted) > 0.9,
            !right,
            "{shown}"
        );
        let confirmed = verification.conclusion() == Conclusion::Confirmed;
        assert_eq!(confirmed, right, "{shown}");
    }
}

#[test]
fn seeds_that_repeat_are_counted() {
    for (seeds, words) in [
        (
            1,
            "the seed has no effect: the answers to all 30 seeds are the same",
        ),
        (4, "30 seeds have 4 different sets of answers"),
    ] {
        let mut kernel = Closure::new(declared(1.5), |task, channel| {
            let few = Task {
                seed: task.seed % seeds,
                ..*task
            };
            jittered(&few, channel)
        });
        let verification = verified(&mut kernel);
        assert_eq!(verification.different_seeds, Some(seeds as usize));
        assert_eq!(verification.conclusion(), Conclusion::NotConfirmed);
        let found = found(&verification, "seed").expect("said");
        assert_eq!(found, (words, true));
    }
    let right = verified(&mut Closure::new(declared(1.5), jittered));
    assert_eq!(right.different_seeds, Some(30));
}

#[test]
fn the_same_seed_has_the_same_answer() {
    let mut asked = 0;
    let mut kernel = Closure::new(declared(1.5), move |task, channel| {
        asked += 1;
        let whenever = Task {
            seed: asked,
            ..*task
        };
        jittered(&whenever, channel)
    });
    let verification = verified(&mut kernel);
    assert_eq!(part(&verification, Standing::Contradicted), 1.0);
    let found = found(&verification, "the same seed").expect("said");
    assert_eq!(found, ("the same seed has two answers", true));
}

#[test]
fn too_few_seeds_are_said_to_be_too_few() {
    let settings = Settings {
        replicas: 8,
        ..settings(LADDER)
    };
    let mut kernel = Closure::new(declared(1.5), jittered);
    let verification = run(&mut kernel, &subjects(&SMOOTH), &settings);
    let (words, wrong) = found(&verification, "8 seeds are too few").expect("said");
    assert!(!wrong && words.contains("with --replicas "), "{words}");
    assert_eq!(part(&verification, Standing::Contradicted), 0.0);
}
