//! Kernels that draw random numbers: their scatter has the order, not one answer.

use super::{SMOOTH, composite, part, run, settings, shown, subjects};
use volver::kernel::{Closure, Declaration, FormKind, Kernel, Sampling, Task};
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
    assert_eq!(verification.fingerprint, None);
    let [finding] = &verification.findings[..] else {
        panic!("{shown}");
    };
    let words = "jittered samples, 1 - exp(-τd): mean and scatter agree in ";
    assert!(finding.defect.starts_with(words), "{shown}");
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
    let defects = verification.findings.iter().map(|one| &one.defect[..]);
    let defects: Vec<&str> = defects.collect();
    assert!(defects[0].starts_with("answers differ"), "{shown}");
    assert!(defects[1].starts_with("jittered samples"), "{shown}");
}
