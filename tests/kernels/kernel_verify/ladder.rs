//! What the default ladder sees of kernels that only declare an order, right and wrong.

use super::{composite, run, shown, subjects};
use std::num::NonZeroU64;
use volver::kernel::{
    Closure, Declaration, Kernel, KernelError, Quantum, Rendering, Segments, Task,
};
use volver::real::FormatName;
use volver::study::verify::{
    Axis, Conclusion, Remark, Settings, SettingsError, Standing, Steps, Verification, VerifyError,
    verify,
};

/// One channel of every smooth case and more, thin to opaque.
const CASES: [&str; 16] = [
    "cloud",
    "constant-source",
    "decaying-field",
    "emission-bump",
    "emission-cubic",
    "faint-long",
    "homogeneous",
    "hyperbolic-tangent",
    "jump-on-node",
    "linear-transfer",
    "oscillating-field",
    "rational-radiance",
    "reciprocal",
    "sine-squared",
    "thick",
    "thick-back",
];

fn of_order(order: f64) -> Declaration {
    Declaration {
        order: Some(order),
        ..Declaration::new("under test")
    }
}

fn verified(kernel: &mut dyn Kernel) -> Verification {
    let settings = Settings::standard(Axis::Step).unwrap();
    run(kernel, &subjects(&CASES), &settings)
}

fn of_segments(
    declaration: Declaration,
    radiance: impl Fn(&Task<'_>, &Segments, usize) -> f64 + Send + Sync,
) -> Verification {
    let mut kernel = Closure::new(declaration, move |task: &Task<'_>, channel| {
        task.cut()
            .map_or(f64::NAN, |segments| radiance(task, segments, channel))
    });
    verified(&mut kernel)
}

/// (τ, C, length) in the middle of every segment.
fn middles(segments: &Segments, channel: usize) -> Vec<(f64, f64, f64)> {
    let middles = &segments.middles;
    let values = middles.extinction.iter().zip(&middles.emission[channel]);
    let both = values.zip(segments.lengths());
    both.map(|((t, c), length)| (*t, *c, length)).collect()
}

fn confirmed(verification: &Verification) {
    let conclusion = verification.conclusion();
    assert_eq!(conclusion, Conclusion::Confirmed, "{}", shown(verification));
}

fn not_confirmed(verification: &Verification) {
    let conclusion = verification.conclusion();
    assert_eq!(
        conclusion,
        Conclusion::NotConfirmed,
        "{}",
        shown(verification)
    );
}

#[test]
fn right_kernels_of_other_kinds_are_confirmed() {
    let plain = of_segments(of_order(2.0), |_, segments, channel| {
        composite(middles(segments, channel))
    });
    confirmed(&plain);
    let questions = plain.counts().inconclusive;
    assert!(questions <= 2, "{}", shown(&plain));
    // Means of both ends, in place of samples in the middle.
    confirmed(&of_segments(of_order(2.0), |_, segments, channel| {
        let (t, c) = (
            &segments.edges.extinction,
            &segments.edges.emission[channel],
        );
        let mean = |v: &[f64], i: usize| f64::midpoint(v[i], v[i + 1]);
        let lengths = segments.lengths().enumerate();
        composite(lengths.map(|(i, length)| (mean(t, i), mean(c, i), length)))
    }));
    // The opacity of a unit of length, taken to the power of the length: only where it is below 1 in binary64.
    let mut by_power = of_segments(of_order(2.0), |_, segments, channel| {
        let (mut radiance, mut transmittance) = (0.0, 1.0);
        for (extinction, emission, length) in middles(segments, channel) {
            let unit = -(-extinction).exp_m1();
            let alpha = 1.0 - (1.0 - unit).powf(length);
            radiance += transmittance * alpha * emission;
            transmittance *= 1.0 - alpha;
        }
        radiance
    });
    by_power.lines.retain(|line| line.name != "thick-back");
    confirmed(&by_power);
    // All in binary32.
    let single = Declaration {
        format: FormatName::F32,
        ..of_order(2.0)
    };
    #[allow(clippy::cast_possible_truncation)]
    confirmed(&of_segments(single, |_, segments, channel| {
        let (mut radiance, mut transmittance) = (0.0_f32, 1.0_f32);
        for (extinction, emission, length) in middles(segments, channel) {
            let alpha = -(-(extinction as f32) * length as f32).exp_m1();
            radiance += transmittance * alpha * emission as f32;
            transmittance *= 1.0 - alpha;
        }
        f64::from(radiance)
    }));
}

/// Nothing finer than 1/255 shows: then what shows is that every answer is right to that.
#[test]
fn answers_of_eight_bits_are_right_to_one_of_them() {
    let bits = |offset: f64| {
        let declaration = Declaration {
            quantum: Some(Quantum::Absolute(1.0 / 255.0)),
            ..of_order(2.0)
        };
        of_segments(declaration, move |_, segments, channel| {
            let radiance = composite(middles(segments, channel)) + offset;
            (radiance * 255.0).round() / 255.0
        })
    };
    let right = bits(0.0);
    confirmed(&right);
    assert!(right.is_right_to_quantum() && right.counts().confirmed == 0);
    not_confirmed(&bits(0.01));
}

/// In bfloat16 hundreds of roundings could add up to anything: what is a third too bright is not taken for that.
#[test]
fn no_floor_hides_a_third_of_the_answer() {
    let declaration = Declaration {
        format: FormatName::Bf16,
        ..of_order(2.0)
    };
    let bright = of_segments(declaration, |_, segments, channel| {
        composite(middles(segments, channel)) * 4.0 / 3.0
    });
    not_confirmed(&bright);
    assert!(bright.counts().contradicted >= 10, "{}", shown(&bright));
}

/// Extrapolated from every second segment: right where there is an even number of equal ones, and nowhere else.
fn richardson(segments: &Segments, channel: usize) -> f64 {
    let (t, c) = (
        &segments.edges.extinction,
        &segments.edges.emission[channel],
    );
    let trapezoid = |every: usize| {
        let places: Vec<usize> = (0..t.len()).step_by(every).collect();
        let (mut depth, mut radiance) = (0.0, 0.0);
        for pair in places.windows(2) {
            let (near, far) = (pair[0], pair[1]);
            let length = segments.edges.lambda[far] - segments.edges.lambda[near];
            let add = length * (t[near] + t[far]) / 2.0;
            let source = |i: usize, depth: f64| c[i] * t[i] * (-depth).exp();
            radiance += length * (source(near, depth) + source(far, depth + add)) / 2.0;
            depth += add;
        }
        radiance
    };
    (4.0 * trapezoid(1) - trapezoid(2)) / 3.0
}

#[test]
fn what_a_kernel_takes_is_what_it_is_asked() {
    let declared = Declaration {
        step_divides: true,
        multiple_of: NonZeroU64::new(2).unwrap(),
        ..of_order(4.0)
    };
    let asked = |declaration: Declaration| {
        of_segments(declaration, |_, segments, channel| {
            richardson(segments, channel)
        })
    };
    let right = asked(declared);
    confirmed(&right);
    assert_eq!(right.settings.steps, Steps::Divide);
    assert_eq!(right.settings.ladder[..3], [10, 22, 34]);
    not_confirmed(&asked(of_order(4.0)));
}

#[test]
fn a_multiple_that_the_ladder_has_too_few_of_is_refused() {
    let settings = Settings::standard(Axis::Step).unwrap();
    let refused = |multiple| {
        let declaration = Declaration {
            multiple_of: NonZeroU64::new(multiple).unwrap(),
            ..of_order(2.0)
        };
        let mut kernel = Closure::new(declaration, |_: &Task<'_>, _| 0.0);
        verify(
            &mut kernel,
            &subjects(&["sine-squared"]),
            &settings,
            &volver::study::Silent,
            &mut |_| (),
        )
        .unwrap_err()
    };
    assert_eq!(
        refused(1000),
        VerifyError::Settings(SettingsError::Multiple {
            multiple: 1000,
            levels: 2
        })
    );
    assert_eq!(
        refused(u64::MAX),
        VerifyError::Settings(SettingsError::Multiple {
            multiple: u64::MAX,
            levels: 0
        })
    );
}

#[test]
fn loops_without_tails_and_lengths_that_are_not_theirs_are_seen() {
    for block in [2, 3, 4, 8, 16] {
        not_confirmed(&of_segments(of_order(2.0), move |_, segments, channel| {
            let mut all = middles(segments, channel);
            all.truncate(all.len() / block * block);
            composite(all)
        }));
    }
    // All as long as the first, or as the step of few bits.
    let lengths: [fn(f64) -> f64; 2] = [
        |step| step,
        |step| f64::from_bits(step.to_bits() & !0 << 42),
    ];
    for of_step in lengths {
        not_confirmed(&of_segments(
            of_order(2.0),
            move |task, segments, channel| {
                let all = middles(segments, channel).into_iter();
                composite(all.map(|(t, c, _)| (t, c, of_step(task.step))))
            },
        ));
    }
}

#[test]
fn what_is_far_off_on_coarse_levels_is_named_beside_its_order() {
    let clamped = of_segments(of_order(2.0), |_, segments, channel| {
        let (mut radiance, mut transmittance) = (0.0, 1.0);
        for (extinction, emission, length) in middles(segments, channel) {
            let alpha = (-(-extinction * length).exp_m1()).min(0.99);
            radiance += transmittance * alpha * emission;
            transmittance *= 1.0 - alpha;
        }
        radiance
    });
    not_confirmed(&clamped);
    let behind = clamped.lines.iter().find(|line| line.name == "thick-back");
    let behind = behind.unwrap();
    assert_eq!(behind.standing, Standing::Contradicted);
    assert!(
        matches!(behind.remarks[..], [Remark::Off { n: 9, relative, .. }] if relative > 1e3),
        "{:?}",
        behind.remarks
    );
    assert!(behind.largest_error().unwrap() > 1e3);
}

/// Wrong at numbers of segments that no level has, or where the step divides the ray, and right elsewhere.
#[test]
fn levels_are_not_all_that_is_asked() {
    let wrong: [fn(&Task<'_>) -> bool; 3] = [
        |task| task.segments.is_multiple_of(2),
        |task| !task.segments.is_multiple_of(3),
        |task| (task.subject.length().to_f64() / task.step).fract() == 0.0,
    ];
    for is_wrong in wrong {
        not_confirmed(&of_segments(
            of_order(2.0),
            move |task, segments, channel| {
                let mut all = middles(segments, channel);
                if is_wrong(task) {
                    all.pop();
                }
                composite(all)
            },
        ));
    }
}

/// Extinction in front and emission in the middle: order 1, and 2 where one of both is constant.
#[test]
fn what_is_better_than_promised_is_not_missing() {
    let mixed = of_segments(of_order(1.0), |_, segments, channel| {
        let front = &segments.edges.extinction;
        let middles = middles(segments, channel).into_iter().zip(front);
        composite(middles.map(|((_, c, length), t)| (*t, c, length)))
    });
    confirmed(&mixed);
    let higher = mixed
        .lines
        .iter()
        .filter(|line| line.is_required && line.standing != Standing::Confirmed && line.is_as_good);
    assert!(higher.count() > 0, "{}", shown(&mixed));
}

/// Half of the light, or none, at the finest levels of one channel; a tenth too much at a single one.
#[test]
fn what_is_lost_at_single_levels_is_seen() {
    for (case, from, to, factor) in [
        ("faint-long", 513, u64::MAX, 0.0),
        ("emission-bump", 261, u64::MAX, 0.5),
        ("cloud", 129, 129, 1.1),
        ("jump-on-node", 1029, u64::MAX, 1.2),
    ] {
        let found = of_segments(of_order(2.0), move |task, segments, channel| {
            let radiance = composite(middles(segments, channel));
            let is_lost = task.subject.name() == case && (from..=to).contains(&task.segments);
            radiance * if is_lost { factor } else { 1.0 }
        });
        not_confirmed(&found);
        let line = found.lines.iter().find(|line| line.name == case).unwrap();
        assert!(
            matches!(line.remarks[..], [Remark::Off { n, .. }, ..] if n == from),
            "{case} {:?}",
            line.remarks
        );
    }
}

/// One per cent too bright over three levels, and right before and after.
#[test]
fn a_plateau_on_the_way_is_named() {
    let found = of_segments(of_order(2.0), |task, segments, channel| {
        let radiance = composite(middles(segments, channel));
        let is_held = task.subject.name() == "cloud" && (33..=129).contains(&task.segments);
        radiance * if is_held { 1.01 } else { 1.0 }
    });
    not_confirmed(&found);
    let line = found
        .lines
        .iter()
        .find(|line| line.name == "cloud")
        .unwrap();
    let plateau = line
        .remarks
        .iter()
        .find(|r| matches!(r, Remark::Plateau { .. }));
    let Some(Remark::Plateau {
        first,
        last,
        relative,
    }) = plateau
    else {
        panic!("{:?}", line.remarks);
    };
    assert_eq!((*first, *last), (33, 129));
    assert!((relative - 0.01).abs() < 0.001, "{relative}");
}

/// 0 where there is little light, and too bright by a tenth where theory promises no order.
#[test]
fn faint_answers_and_unpromised_ones_are_looked_at() {
    for (case, factor) in [("thick-back", 0.0), ("jump-on-node", 1.1)] {
        let mut kernel = Closure::new(of_order(2.0), |task: &Task<'_>, channel| {
            let segments = task.cut().unwrap();
            let radiance = composite(middles(segments, channel));
            if task.subject.name() == case {
                radiance * factor
            } else {
                radiance
            }
        });
        let found = verified(&mut kernel);
        not_confirmed(&found);
        let line = found.lines.iter().find(|line| line.name == case).unwrap();
        assert_eq!(line.standing, Standing::Contradicted, "{}", shown(&found));
    }
}

/// A kernel that answers what it was asked the time before.
#[derive(Debug)]
struct Late {
    declaration: Declaration,
    before: Option<Rendering>,
}

impl Kernel for Late {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let mut right = Closure::segments("right", |segments, channel| {
            composite(middles(segments, channel))
        });
        let now = right.render(task)?;
        let fits = |before: &Rendering| before.radiance.len() == now.radiance.len();
        let before = self.before.replace(now.clone()).filter(fits);
        Ok(before.unwrap_or(now))
    }

    fn renew(&mut self) {
        self.before = None;
    }
}

#[test]
fn answers_of_the_request_before_are_told_by_asking_again_at_the_end() {
    let found = verified(&mut Late {
        declaration: of_order(2.0),
        before: None,
    });
    not_confirmed(&found);
    assert!(
        found.lines.iter().all(|line| !line.steady),
        "{}",
        shown(&found)
    );
}

#[test]
fn no_level_is_a_multiple_of_eight_and_breaks_keep_their_place() {
    let settings = Settings::standard(Axis::Step).unwrap();
    let ladder = &settings.ladder;
    assert!(ladder.iter().all(|n| n % 8 != 0) && ladder.len() == 8);
    // n − 7/10 segments: halves, thirds and quarters of the ray are at the same part of one at every level.
    for parts in [2, 3, 4] {
        let places: Vec<u64> = ladder.iter().map(|n| (10 * n - 7) % (10 * parts)).collect();
        assert!(places.iter().all(|place| *place == places[0]), "{places:?}");
    }
}

/// A voxel that is attenuated by all of itself, as in emission tomography: order 1, and a rule of layers by name.
#[test]
fn a_rule_of_layers_is_right_where_it_has_the_order_declared() {
    let whole_own = |declaration| {
        of_segments(declaration, |_, segments, channel| {
            let (mut radiance, mut depth) = (0.0, 0.0);
            for (tau, c, length) in middles(segments, channel) {
                depth += tau * length;
                radiance += f64::exp(-depth) * tau * length * c;
            }
            radiance
        })
    };
    confirmed(&whole_own(of_order(1.0)));
    let second = whole_own(of_order(2.0));
    not_confirmed(&second);
    let found = second.identification.as_ref().unwrap();
    let names = found.examined.deviations.iter().map(|found| found.name);
    assert_eq!(names.collect::<Vec<_>>(), ["weight"]);
}
