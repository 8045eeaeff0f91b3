//! Segments of many lengths, asked for or chosen by the kernel.

use super::{composite, declared, run, shown, subjects};
use rug::Float;
use std::fmt;
use volver::kernel::{
    Closure, Declaration, FormKind, Kernel, KernelError, Rendering, Sampling, Spacing, Task,
};
use volver::study::Silent;
use volver::study::verify::{
    Axis, Conclusion, Identify, Settings, Standing, Steps, Verification, VerifyError, verify,
};

const CASES: [&str; 6] = [
    "constant-source",
    "decaying-field",
    "emission-bump",
    "hyperbolic-tangent",
    "rational-radiance",
    "sine-squared",
];

const SPACINGS: [Spacing; 5] = [
    Spacing::Square,
    Spacing::Log,
    Spacing::Disparity,
    Spacing::Random(1),
    Spacing::Random(2),
];

fn spaced(spacing: Spacing) -> Settings {
    Settings {
        steps: Steps::Spaced(spacing),
        identify: Identify::Off,
        ..Settings::standard(Axis::Step).unwrap()
    }
}

/// Samples in the middles of segments, which are as long as `length` has it of the segment, its number and the step.
fn verified(
    declaration: Declaration,
    settings: &Settings,
    length: impl Fn(&[f64], usize, f64) -> f64 + Send + Sync,
) -> Verification {
    let mut kernel = Closure::new(declaration, move |task: &Task<'_>, channel| {
        let segments = task.cut().expect("segments");
        let lengths: Vec<f64> = segments.lengths().collect();
        let middles = &segments.middles;
        composite((0..lengths.len()).map(|i| {
            (
                middles.extinction[i],
                middles.emission[channel][i],
                length(&lengths, i, task.step),
            )
        }))
    });
    run(&mut kernel, &subjects(&CASES), settings)
}

fn of_order_two() -> Declaration {
    Declaration {
        order: Some(2.0),
        ..Declaration::new("under test")
    }
}

#[test]
fn a_kernel_that_looks_at_every_length_is_confirmed() {
    for spacing in SPACINGS {
        for declaration in [of_order_two(), declared("front-to-back/middle/expm1")] {
            let verification = verified(declaration, &spaced(spacing), |lengths, i, _| lengths[i]);
            let shown = shown(&verification);
            assert_eq!(
                verification.conclusion(),
                Conclusion::Confirmed,
                "{spacing}\n{shown}"
            );
            assert!(verification.counts().confirmed >= 4, "{spacing}\n{shown}");
            assert_eq!(verification.counts().contradicted, 0, "{spacing}\n{shown}");
            if verification.is_of_method() {
                assert_eq!(verification.as_declared(), Some((6, 6)), "{spacing}");
            }
        }
    }
}

/// The length that is taken for that of a segment, by the lengths of all, its number and the step.
type Length = fn(&[f64], usize, f64) -> f64;

#[test]
fn one_length_for_all_is_seen() {
    let even = Settings {
        steps: Steps::Divide,
        identify: Identify::Off,
        ..Settings::standard(Axis::Step).unwrap()
    };
    let faults: [Length; 3] = [
        |_, _, step| step,
        |lengths, _, _| lengths[0],
        // The neighbour's.
        |lengths, i, _| lengths[i.saturating_sub(1)],
    ];
    for fault in faults {
        let unseen = verified(of_order_two(), &even, fault);
        assert_eq!(unseen.conclusion(), Conclusion::Confirmed);
        let verification = verified(of_order_two(), &spaced(Spacing::Random(1)), fault);
        assert_eq!(
            verification.conclusion(),
            Conclusion::NotConfirmed,
            "{}",
            shown(&verification)
        );
    }
}

/// Marches through the medium in segments of its own: shorter where it absorbs, by the square root of τ.
struct Adaptive {
    declaration: Declaration,
    /// What it says that it used.
    says: fn(Vec<f64>) -> Rendering,
}

impl Adaptive {
    fn new(says: fn(Vec<f64>) -> Rendering) -> Self {
        Adaptive {
            declaration: Declaration {
                form: FormKind::Function,
                sampling: Some(Sampling::Middle),
                ..of_order_two()
            },
            says,
        }
    }
}

impl fmt::Debug for Adaptive {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Adaptive")
    }
}

fn says_edges(edges: Vec<f64>) -> Rendering {
    Rendering {
        edges: Some(edges),
        ..Rendering::default()
    }
}

impl Kernel for Adaptive {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let length = task.subject.length().to_f64();
        let channels = task.subject.channels().len();
        let mut emission = vec![0.0; channels];
        let mut at = |lambda: f64| (task.subject.at(lambda, &mut emission), emission.clone());
        // Equal parts of a density that is never 0, summed finely.
        let fine = 1 << 14;
        let mut sums = vec![0.0];
        for i in 0..fine {
            let (tau, _) = at(length * (f64::from(i) + 0.5) / f64::from(fine));
            sums.push(sums[sums.len() - 1] + 0.2 + tau.abs().sqrt());
        }
        let whole = sums[sums.len() - 1];
        let edge = |i: u64| {
            let wanted = whole * i as f64 / task.segments as f64;
            let above = sums
                .partition_point(|sum| *sum < wanted)
                .clamp(1, sums.len() - 1);
            let part = (wanted - sums[above - 1]) / (sums[above] - sums[above - 1]);
            length * (above as f64 - 1.0 + part) / f64::from(fine)
        };
        let edges: Vec<f64> = (0..=task.segments).map(edge).collect();
        let radiance = (0..channels).map(|channel| {
            let samples = edges.windows(2).map(|ends| {
                let (tau, emission) = at(f64::midpoint(ends[0], ends[1]));
                (tau, emission[channel], ends[1] - ends[0])
            });
            Float::with_val(53, composite(samples.collect::<Vec<_>>()))
        });
        Ok(Rendering {
            radiance: radiance.collect(),
            ..(self.says)(edges.clone())
        })
    }
}

#[test]
fn a_kernel_may_choose_its_segments_and_say_so() {
    let settings = Settings::standard(Axis::Step).unwrap();
    let verification = run(&mut Adaptive::new(says_edges), &subjects(&CASES), &settings);
    let shown = shown(&verification);
    assert_eq!(verification.counts().contradicted, 0, "{shown}");
    let confirmed = verification
        .lines
        .iter()
        .filter(|line| line.standing == Standing::Confirmed);
    assert!(confirmed.count() >= 4, "{shown}");
}

#[test]
fn edges_that_cannot_be_are_no_answer() {
    let settings = Settings {
        identify: Identify::Off,
        ..Settings::standard(Axis::Step).unwrap()
    };
    let wrong: [fn(Vec<f64>) -> Rendering; 6] = [
        |mut edges| {
            edges.swap(1, 2);
            says_edges(edges)
        },
        |mut edges| {
            edges.push(1e3);
            says_edges(edges)
        },
        |mut edges| {
            edges[0] = -0.1;
            says_edges(edges)
        },
        |mut edges| {
            edges[2] = f64::NAN;
            says_edges(edges)
        },
        |_| says_edges(vec![0.0]),
        |edges| Rendering {
            segments: Some(edges.len() as u64),
            ..says_edges(edges)
        },
    ];
    for says in wrong {
        let verification = run(&mut Adaptive::new(says), &subjects(&CASES[..1]), &settings);
        assert_eq!(verification.conclusion(), Conclusion::CouldNotRun);
        let line = &verification.lines[0];
        let said = line.failures[0].error.to_string();
        assert!(said.contains("edges") && said.contains("allowed"), "{said}");
    }
}

#[test]
fn who_is_given_no_segments_is_not_asked_for_uneven_ones() {
    let settings = spaced(Spacing::Square);
    let of = |kernel: &mut dyn Kernel| {
        let subjects = subjects(&CASES[..1]);
        verify(kernel, &subjects, &settings, &Silent, &mut |_| ()).unwrap_err()
    };
    let form = FormKind::Function;
    let refused = of(&mut Adaptive::new(says_edges));
    assert_eq!(refused, VerifyError::Spacing { form });
    let of_whole = Declaration {
        step_divides: true,
        ..of_order_two()
    };
    let form = FormKind::Segments;
    let none = |_: &Task<'_>, _: usize| 0.0;
    let refused = of(&mut Closure::new(of_whole, none));
    assert_eq!(refused, VerifyError::Spacing { form });
}
