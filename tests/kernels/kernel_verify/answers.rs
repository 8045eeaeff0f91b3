//! Opacity, optical and expected depth, answered right and wrong.

use super::{declared, run, shown, subjects};
use rug::Float;
use std::fmt;
use volver::convergence::Verdict;
use volver::kernel::{
    Declaration, DepthWeights, FormKind, Kernel, KernelError, Quantity, Rendering, Sampling,
    Segments, Task,
};
use volver::method::Expected;
use volver::real::FormatName;
use volver::study::verify::{
    Accepted, Axis, Conclusion, Identify, Settings, Standing, Verification,
};

/// Rays that are thin and thick, of which one absorbs evenly, one has a jump and one nothing.
const CASES: [&str; 8] = [
    "sine-squared",
    "atmosphere",
    "decaying-field",
    "homogeneous",
    "rgb-transfer",
    "thick-back",
    "vacuum",
    "vacuum-gap",
];

/// What a ray sums up to.
#[derive(Clone, Copy, Debug)]
struct Sums {
    opacity: f64,
    depth: f64,
    /// Σ w λ.
    weighted: f64,
}

/// One sample a segment, and what the kernel makes of its sums; the radiance is right.
struct Marcher {
    declaration: Declaration,
    /// Of every value that is computed.
    rounds: fn(f64) -> f64,
    answers: fn(&Sums, &Segments) -> Sums,
}

impl fmt::Debug for Marcher {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Marcher")
    }
}

fn as_it_is(sums: &Sums, _: &Segments) -> Sums {
    *sums
}

fn by_opacity(sums: &Sums, _: &Segments) -> Sums {
    Sums {
        weighted: sums.weighted / sums.opacity,
        ..*sums
    }
}

impl Marcher {
    fn new(declaration: Declaration, answers: fn(&Sums, &Segments) -> Sums) -> Self {
        Marcher {
            declaration: Declaration {
                answers: Quantity::ALL.to_vec(),
                ..declaration
            },
            rounds: |x| x,
            answers,
        }
    }

    fn is_in_front(&self) -> bool {
        let method = self.declaration.method;
        method.is_some_and(|method| method.name().contains("/front/"))
    }

    /// The length of a segment; the last is a wall where that is declared.
    fn length(&self, segments: &Segments, i: usize, length: f64) -> f64 {
        let is_wall = self.declaration.far_wall && i + 1 == segments.count();
        if is_wall { 1e10 } else { length }
    }

    fn march(&self, segments: &Segments, channel: usize) -> (f64, Sums) {
        let samples = if self.is_in_front() {
            &segments.edges
        } else {
            &segments.middles
        };
        let round = self.rounds;
        let (mut radiance, mut through) = (0.0, 1.0);
        let (mut depth, mut weighted) = (0.0, 0.0);
        for (i, length) in segments.lengths().enumerate() {
            let length = self.length(segments, i, length);
            let of_segment = round(samples.extinction[i] * length);
            let alpha = round(-(-of_segment).exp_m1());
            let weight = round(through * alpha);
            radiance = round(radiance + weight * samples.emission[channel][i]);
            weighted = round(weighted + weight * samples.lambda[i]);
            through = round(through * (1.0 - alpha));
            depth = round(depth + of_segment);
        }
        let sums = Sums {
            opacity: round(1.0 - through),
            depth,
            weighted,
        };
        (radiance, sums)
    }
}

impl Kernel for Marcher {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let segments = task.cut().expect("segments");
        let channels = 0..task.subject.channels().len();
        let all: Vec<_> = channels.map(|c| self.march(segments, c)).collect();
        let answered = (self.answers)(&all[0].1, segments);
        let float = |x: f64| Float::with_val(53, x);
        let of = |quantity: Quantity, x: f64| self.declaration.has(quantity).then(|| float(x));
        let radiance = all.iter().map(|(radiance, _)| float(*radiance));
        let has_radiance = self.declaration.has(Quantity::Radiance);
        Ok(Rendering {
            radiance: radiance.filter(|_| has_radiance).collect(),
            opacity: Some(float(answered.opacity)).filter(|opacity| {
                // As of the first version of the protocol, where it is not declared.
                self.declaration.has(Quantity::Opacity)
                    || (has_radiance && self.declaration.answers.len() == 1 && !opacity.is_zero())
            }),
            optical_depth: of(Quantity::OpticalDepth, answered.depth),
            expected_depth: of(Quantity::ExpectedDepth, answered.weighted),
            ..Rendering::default()
        })
    }
}

fn settings() -> Settings {
    Settings {
        identify: Identify::Off,
        ..Settings::standard(Axis::Step).unwrap()
    }
}

fn verified(kernel: &mut Marcher) -> Verification {
    run(kernel, &subjects(&CASES), &settings())
}

/// Lines of a quantity that stand so.
fn count(verification: &Verification, quantity: Quantity, standing: Standing) -> usize {
    let lines = verification.of(quantity);
    lines.filter(|line| line.standing == standing).count()
}

const MIDDLE: &str = "front-to-back/middle/expm1";
const FRONT: &str = "front-to-back/front/expm1";

#[test]
fn what_a_composite_answers_has_its_orders() {
    let order_alone = |order| Declaration {
        order: Some(order),
        ..Declaration::new("under test")
    };
    for (declaration, order) in [
        (declared(MIDDLE), 2.0),
        (declared(FRONT), 1.0),
        (order_alone(2.0), 2.0),
    ] {
        let verification = verified(&mut Marcher::new(declaration, as_it_is));
        assert_eq!(
            verification.conclusion(),
            Conclusion::Confirmed,
            "{}",
            shown(&verification)
        );
        assert_eq!(verification.quantities(), Quantity::ALL);
        for quantity in Quantity::ALL {
            let lines = verification.of(quantity);
            let orders = lines.filter(|line| line.expected == Some(Expected::Order(order)));
            let confirmed = orders.filter(|line| line.standing == Standing::Confirmed);
            assert!(
                confirmed.count() >= 3,
                "{quantity}\n{}",
                shown(&verification)
            );
            assert_eq!(count(&verification, quantity, Standing::Contradicted), 0);
        }
    }
}

#[test]
fn truths_are_those_of_closed_forms() {
    // τ = 2 on a ray of length 3/2, and a mean depth by parts: ∫ λ τ e^(−τλ) = (1 − (1 + τD) e^(−τD))/τ.
    let verification = verified(&mut Marcher::new(declared(MIDDLE), as_it_is));
    let subject = subjects(&["homogeneous"]).remove(0);
    let (tau, length) = (subject.at(0.5, &mut [0.0]), subject.length().to_f64());
    let depth = tau * length;
    let expected = (1.0 - (1.0 + depth) * (-depth).exp()) / tau;
    let exact = |name: &str| {
        let mut lines = verification.lines.iter();
        let line = lines.find(|line| line.name == name).expect(name);
        line.exact.to_f64()
    };
    let near =
        |got: f64, want: f64| assert!((got - want).abs() < 1e-14 * want.abs(), "{got} {want}");
    near(exact("homogeneous:optical_depth"), depth);
    near(exact("homogeneous:opacity"), -(-depth).exp_m1());
    near(exact("homogeneous:expected_depth"), expected);
    // The paper's t = sin(λ²)/2.
    near(exact("sine-squared:optical_depth"), 1_f64.sin() / 2.0);
    near(
        exact("sine-squared:opacity"),
        -(-1_f64.sin() / 2.0).exp_m1(),
    );
    assert_eq!(exact("vacuum:expected_depth"), 0.0);
    let divided = Declaration {
        expected_depth: DepthWeights::ByOpacity,
        ..declared(MIDDLE)
    };
    let divided = verified(&mut Marcher::new(divided, by_opacity));
    assert_eq!(
        divided.conclusion(),
        Conclusion::Confirmed,
        "{}",
        shown(&divided)
    );
    let find = |name: &str| divided.lines.iter().find(|line| line.name == name);
    let mean = find("homogeneous:expected_depth").expect("a line");
    near(mean.exact.to_f64(), expected / -(-depth).exp_m1());
    // Nothing has no mean.
    assert!(find("vacuum:opacity").is_some() && find("vacuum:expected_depth").is_none());
}

#[test]
fn any_subset_may_be_answered() {
    for (answers, lines) in [
        (vec![Quantity::OpticalDepth], 8),
        (vec![Quantity::Opacity, Quantity::ExpectedDepth], 16),
        (vec![Quantity::Radiance, Quantity::OpticalDepth], 18),
    ] {
        let mut kernel = Marcher::new(declared(MIDDLE), as_it_is);
        kernel.declaration.answers.clone_from(&answers);
        let verification = verified(&mut kernel);
        let said = shown(&verification);
        assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{said}");
        assert_eq!(verification.quantities(), answers);
        assert_eq!(verification.lines.len(), lines, "{said}");
    }
}

#[test]
fn in_single_precision_nothing_is_contradicted() {
    let mut kernel = Marcher::new(declared(MIDDLE), as_it_is);
    kernel.declaration.format = FormatName::F32;
    // What a kernel in binary32 computes, one operation after the other.
    #[allow(clippy::cast_possible_truncation)]
    let single = |x: f64| f64::from(x as f32);
    kernel.rounds = single;
    let verification = verified(&mut kernel);
    assert_eq!(
        verification.conclusion(),
        Conclusion::Confirmed,
        "{}",
        shown(&verification)
    );
}

/// A mistake in one quantity, and where it has to show.
struct Fault {
    name: &'static str,
    quantity: Quantity,
    weights: DepthWeights,
    answers: fn(&Sums, &Segments) -> Sums,
    /// Cases that contradict, at least.
    contradicted: usize,
}

/// (τ d) of the last segment.
fn last(segments: &Segments) -> f64 {
    let length = segments.lengths().last().expect("a segment");
    segments.middles.extinction.last().expect("a sample") * length
}

#[test]
fn every_fault_is_seen_in_its_quantity_and_no_other() {
    use Quantity::{ExpectedDepth, Opacity, OpticalDepth};
    let faults = [
        Fault {
            name: "divided by the opacity, said to be plain",
            quantity: ExpectedDepth,
            weights: DepthWeights::Plain,
            answers: by_opacity,
            contradicted: 4,
        },
        Fault {
            name: "plain, said to be divided by the opacity",
            quantity: ExpectedDepth,
            weights: DepthWeights::ByOpacity,
            answers: as_it_is,
            contradicted: 4,
        },
        Fault {
            name: "depths of the fronts of segments",
            quantity: ExpectedDepth,
            weights: DepthWeights::Plain,
            answers: |sums, segments| Sums {
                weighted: sums.weighted
                    - sums.opacity * segments.lengths().next().expect("a segment") / 2.0,
                ..*sums
            },
            contradicted: 4,
        },
        Fault {
            name: "the opacity before the last sample",
            quantity: Opacity,
            weights: DepthWeights::Plain,
            answers: |sums, segments| Sums {
                opacity: 1.0 - (1.0 - sums.opacity) / (-last(segments)).exp(),
                ..*sums
            },
            contradicted: 4,
        },
        Fault {
            name: "the transmittance in place of the opacity",
            quantity: Opacity,
            weights: DepthWeights::Plain,
            answers: |sums, _| Sums {
                opacity: 1.0 - sums.opacity,
                ..*sums
            },
            contradicted: 5,
        },
        Fault {
            name: "an opacity of NaN",
            quantity: Opacity,
            weights: DepthWeights::Plain,
            answers: |sums, _| Sums {
                opacity: f64::NAN,
                ..*sums
            },
            contradicted: 8,
        },
        Fault {
            name: "an optical depth without the last half step",
            quantity: OpticalDepth,
            weights: DepthWeights::Plain,
            answers: |sums, segments| Sums {
                depth: sums.depth - last(segments) / 2.0,
                ..*sums
            },
            contradicted: 4,
        },
        Fault {
            name: "an optical depth that ends at 1",
            quantity: OpticalDepth,
            weights: DepthWeights::Plain,
            answers: |sums, _| Sums {
                depth: sums.depth.min(1.0),
                ..*sums
            },
            contradicted: 2,
        },
    ];
    for fault in faults {
        let declaration = Declaration {
            expected_depth: fault.weights,
            ..declared(MIDDLE)
        };
        let verification = verified(&mut Marcher::new(declaration, fault.answers));
        let said = format!("{}\n{}", fault.name, shown(&verification));
        assert_eq!(
            verification.conclusion(),
            Conclusion::NotConfirmed,
            "{said}"
        );
        for quantity in Quantity::ALL {
            let contradicted = count(&verification, quantity, Standing::Contradicted);
            // What is not divided although it should be is the depth's own fault alone.
            if quantity == fault.quantity {
                assert!(contradicted >= fault.contradicted, "{contradicted} {said}");
            } else {
                assert_eq!(contradicted, 0, "{quantity} {said}");
            }
        }
    }
}

#[test]
fn an_opacity_of_12345_is_no_opacity() {
    let answers = |sums: &Sums, _: &Segments| Sums {
        opacity: 12345.0,
        ..*sums
    };
    let mut kernel = Marcher::new(declared(MIDDLE), answers);
    // Declared or not, as in the first version of the protocol.
    for answers in [Quantity::ALL.to_vec(), vec![Quantity::Radiance]] {
        kernel.declaration.answers = answers;
        let verification = verified(&mut kernel);
        let said = shown(&verification);
        assert_eq!(
            verification.conclusion(),
            Conclusion::NotConfirmed,
            "{said}"
        );
        assert_eq!(
            count(&verification, Quantity::Opacity, Standing::Contradicted),
            CASES.len()
        );
        assert_eq!(
            count(&verification, Quantity::Radiance, Standing::Contradicted),
            0
        );
        let found = &verification.findings[0];
        assert_eq!(found.words, "an opacity of 12345 (allowed: 0 to 1)");
        assert_eq!(found.channels.len(), CASES.len());
    }
}

#[test]
fn of_order_one_a_missing_sample_shows_in_the_values() {
    let answers = |sums: &Sums, segments: &Segments| {
        let tau = segments.edges.extinction[segments.count() - 1];
        let last = tau * segments.lengths().last().expect("a segment");
        Sums {
            opacity: 1.0 - (1.0 - sums.opacity) / (-last).exp(),
            ..*sums
        }
    };
    let right = verified(&mut Marcher::new(declared(FRONT), as_it_is));
    let (agree, of) = right.as_declared().expect("compared");
    assert_eq!(agree, of, "{}", shown(&right));
    let wrong = verified(&mut Marcher::new(declared(FRONT), answers));
    let (agree, of) = wrong.as_declared().expect("compared");
    assert!(agree < of, "{}", shown(&wrong));
    assert_eq!(wrong.conclusion(), Conclusion::NotConfirmed);
}

#[test]
fn a_deviation_of_the_opacity_that_is_accepted_passes_with_its_lines() {
    let half = |sums: &Sums, _: &Segments| Sums {
        opacity: sums.opacity / 2.0,
        ..*sums
    };
    let mut kernel = Marcher::new(declared(MIDDLE), half);
    kernel.declaration.answers = vec![Quantity::Radiance];
    let mut settings = Settings::standard(Axis::Step).unwrap();
    let subjects = subjects(&CASES);
    let verification = run(&mut kernel, &subjects, &settings);
    let said = shown(&verification);
    assert_eq!(
        verification.conclusion(),
        Conclusion::NotConfirmed,
        "{said}"
    );
    assert!(said.contains("opacity-answered"), "{said}");
    assert!(count(&verification, Quantity::Opacity, Standing::Contradicted) > 4);
    settings.accept = vec!["opacity-answered".parse::<Accepted>().unwrap()];
    let accepted = run(&mut kernel, &subjects, &settings);
    assert_eq!(
        accepted.conclusion(),
        Conclusion::Confirmed,
        "{}",
        shown(&accepted)
    );
}

#[test]
fn the_depth_of_a_wall_is_no_declaration() {
    let mut kernel = Marcher::new(declared(MIDDLE), as_it_is);
    kernel.declaration.far_wall = true;
    let refused = volver::study::verify::verify(
        &mut kernel,
        &subjects(&["thick"]),
        &settings(),
        &volver::study::Silent,
        &mut |_| (),
    );
    let said = refused.unwrap_err().to_string();
    assert!(
        said.starts_with("it declares a far wall and the optical depth"),
        "{said}"
    );
}

#[test]
fn noise_in_an_opacity_is_no_order() {
    let verification = verified(&mut Marcher::new(declared(MIDDLE), |sums, segments| Sums {
        opacity: sums.opacity * (1.0 + 1e-3 * (segments.count() as f64).sin()),
        ..*sums
    }));
    let bad = verification.of(Quantity::Opacity).filter(|line| {
        line.standing == Standing::Confirmed && line.measured.verdict() != Verdict::Exact
    });
    assert_eq!(bad.count(), 0, "{}", shown(&verification));
    assert_eq!(verification.conclusion(), Conclusion::NotConfirmed);
}

#[test]
fn a_wall_ends_opacity_and_mean_depth() {
    let mut kernel = Marcher::new(declared(FRONT), as_it_is);
    kernel.declaration.far_wall = true;
    kernel.declaration.answers = vec![
        Quantity::Radiance,
        Quantity::Opacity,
        Quantity::ExpectedDepth,
    ];
    let cases = [
        "sine-squared",
        "decaying-field",
        "hyperbolic-tangent",
        "linear-transfer",
    ];
    let subjects = subjects(&cases);
    let verification = run(&mut kernel, &subjects, &settings());
    let said = shown(&verification);
    assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{said}");
    for line in verification.of(Quantity::Opacity) {
        assert_eq!(
            (line.exact.to_f64(), line.measured.verdict()),
            (1.0, Verdict::Exact),
            "{said}"
        );
    }
    assert!(
        count(&verification, Quantity::ExpectedDepth, Standing::Confirmed) >= 3,
        "{said}"
    );
    // What ends where the medium does is another ray.
    kernel.declaration.far_wall = false;
    let free = run(&mut kernel, &subjects, &settings());
    assert_eq!(free.conclusion(), Conclusion::Confirmed, "{}", shown(&free));
    let depths = |of: &Verification| -> Vec<f64> {
        let lines = of.of(Quantity::ExpectedDepth);
        lines.map(|line| line.exact.to_f64()).collect()
    };
    for (with, without) in depths(&verification).iter().zip(depths(&free)) {
        assert!(*with > without);
    }
}

/// One sample somewhere in every segment, by the seed; the opacity is `factor` times what it should be.
struct Jittered {
    declaration: Declaration,
    factor: f64,
}

impl fmt::Debug for Jittered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Jittered")
    }
}

impl Kernel for Jittered {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let mut state = task.seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) ^ (task.segments << 32);
        let mut part = || {
            for shift in [13_u32, 7, 17] {
                state = state.wrapping_add(0x2545_f491_4f6c_dd1d);
                state ^= if shift == 7 {
                    state << shift
                } else {
                    state >> shift
                };
            }
            (state >> 11) as f64 / 53_f64.exp2()
        };
        let mut emission = vec![0.0; task.subject.channels().len()];
        let mut radiance = vec![0.0; emission.len()];
        let (mut through, mut depth, mut weighted) = (1.0, 0.0, 0.0);
        for j in 0..task.segments {
            let lambda = (j as f64 + part()) * task.step;
            let of_segment = task.subject.at(lambda, &mut emission) * task.step;
            let weight = through * -(-of_segment).exp_m1();
            for (sum, c) in radiance.iter_mut().zip(&emission) {
                *sum += weight * c;
            }
            weighted += weight * lambda;
            through *= (-of_segment).exp();
            depth += of_segment;
        }
        let float = |x: f64| Float::with_val(53, x);
        Ok(Rendering {
            radiance: radiance.into_iter().map(float).collect(),
            opacity: Some(float(self.factor * (1.0 - through))),
            optical_depth: Some(float(depth)),
            expected_depth: Some(float(weighted)),
            ..Rendering::default()
        })
    }
}

#[test]
fn random_answers_have_orders_too() {
    let declaration = Declaration {
        form: FormKind::Function,
        order: Some(1.5),
        stochastic: true,
        sampling: Some(Sampling::Jittered),
        answers: Quantity::ALL.to_vec(),
        ..Declaration::new("jittered")
    };
    let settings = Settings {
        identify: Identify::Off,
        ..super::settings("16..256")
    };
    let subjects = subjects(&super::SMOOTH);
    let verified = |factor| {
        let declaration = declaration.clone();
        run(
            &mut Jittered {
                declaration,
                factor,
            },
            &subjects,
            &settings,
        )
    };
    let verification = verified(1.0);
    let said = shown(&verification);
    assert_eq!(verification.conclusion(), Conclusion::Confirmed, "{said}");
    for quantity in Quantity::ALL {
        let confirmed = count(&verification, quantity, Standing::Confirmed);
        assert!(confirmed >= 4, "{quantity} {said}");
        assert_eq!(
            count(&verification, quantity, Standing::Contradicted),
            0,
            "{said}"
        );
    }
    // A bias in one of them.
    let biased = verified(0.98);
    let said = shown(&biased);
    assert_eq!(biased.conclusion(), Conclusion::NotConfirmed, "{said}");
    assert!(
        count(&biased, Quantity::Opacity, Standing::Contradicted) >= 4,
        "{said}"
    );
    assert_eq!(
        count(&biased, Quantity::OpticalDepth, Standing::Contradicted),
        0,
        "{said}"
    );
}
