//! Kinds of kernels, each written by hand as its author would: what is named is what was written, and nothing else.

use rug::Float;
use std::collections::HashMap;
use std::fmt;
use volver::identify::{Budget, Examined, Rule, examine};
use volver::kernel::{Data, Declaration, Kernel, KernelError, Rendering, Segments, Task};

/// Radiances of all channels, and the opacity where one comes with them.
type Answer = (Vec<f64>, Option<f64>);

/// A kernel in a few lines.
struct Written<F> {
    declaration: Declaration,
    answer: F,
}

impl<F> fmt::Debug for Written<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Written").finish_non_exhaustive()
    }
}

impl<F: FnMut(&Task<'_>, &Segments) -> Answer + Send> Kernel for Written<F> {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, task: &Task<'_>) -> Result<Rendering, KernelError> {
        let Data::Segments(segments) = task.data else {
            panic!("segments were declared");
        };
        let (radiance, opacity) = (self.answer)(task, segments);
        Ok(Rendering {
            radiance: radiance.iter().map(|y| Float::with_val(53, *y)).collect(),
            opacity: opacity.map(|opacity| Float::with_val(53, opacity)),
            ..Rendering::default()
        })
    }
}

fn examined(answer: impl FnMut(&Task<'_>, &Segments) -> Answer + Send) -> Examined {
    within(Budget::default(), answer)
}

fn within(budget: Budget, answer: impl FnMut(&Task<'_>, &Segments) -> Answer + Send) -> Examined {
    let mut kernel = Written {
        declaration: Declaration::new("written"),
        answer,
    };
    examine(&mut kernel, budget, &mut |_| ())
}

/// The names of the deviations, and the rule.
fn read(examined: &Examined) -> (Vec<&'static str>, &Rule) {
    let names = examined.deviations.iter().map(|one| one.name).collect();
    let Some(rule) = examined.found.named() else {
        panic!("{names:?}, silent: {:?}", examined.found.not_identified);
    };
    (names, rule)
}

fn lengths(segments: &Segments) -> Vec<f64> {
    let ends = segments.edges.lambda.windows(2);
    ends.map(|ends| ends[1] - ends[0]).collect()
}

/// Σ T α C over middles, and 1 − T.
fn march(segments: &Segments, opacity: impl Fn(f64, f64) -> f64) -> Answer {
    let mut through = 1.0;
    let mut weights = Vec::new();
    for (tau, d) in segments.middles.extinction.iter().zip(lengths(segments)) {
        let opacity = opacity(*tau, d);
        weights.push(through * opacity);
        through *= 1.0 - opacity;
    }
    (
        sums(&weights, &segments.middles.emission),
        Some(1.0 - through),
    )
}

fn sums(weights: &[f64], emission: &[Vec<f64>]) -> Vec<f64> {
    let of = |c: &Vec<f64>| weights.iter().zip(c).map(|(w, c)| w * c).sum();
    emission.iter().map(of).collect()
}

fn right(tau: f64, d: f64) -> f64 {
    -(-tau * d).exp_m1()
}

/// An opacity of a unit of length, whatever the step, a tenth of which covers.
#[test]
fn a_blend_factor_is_a_cover() {
    let found = examined(|_, s| march(s, |tau, _| 0.1 * (1.0 - (-tau).exp())));
    let (names, rule) = read(&found);
    assert_eq!(names, ["depth-powers", "cover"]);
    let text = rule.to_string();
    assert!(text.contains("0.1 (1 − exp(−τⱼ))"), "{text}");
}

/// τ d/D: references weigh less on rays of more segments.
#[test]
fn a_step_as_a_part_of_the_ray_is_read_off() {
    let found = examined(|_, s| {
        let whole = s.edges.lambda.last().copied().unwrap();
        march(s, |tau, d| right(tau, d / whole))
    });
    let (names, rule) = read(&found);
    assert_eq!(names, ["depth-powers"]);
    assert!(rule.to_string().contains("dⱼ/D"), "{rule}");
}

/// n ends make n − 1 intervals.
#[test]
fn the_last_interval_of_trapezoids_is_missing() {
    let found = examined(|_, s| {
        let (tau, d) = (&s.edges.extinction, lengths(s));
        let mut weights = vec![0.0; tau.len()];
        let mut through = 1.0;
        for i in 0..d.len() - 1 {
            let behind = through * (-0.5 * (tau[i] + tau[i + 1]) * d[i]).exp();
            weights[i] += 0.5 * d[i] * through * tau[i];
            weights[i + 1] += 0.5 * d[i] * behind * tau[i + 1];
            through = behind;
        }
        (sums(&weights, &s.edges.emission), None)
    });
    let (names, _) = read(&found);
    assert_eq!(names, ["last-sample"]);
}

/// Olson and Kunasz before a boundary that radiates C(D).
#[test]
fn a_boundary_behind_linear_sources_is_a_wall() {
    let found = examined(|_, s| {
        let (tau, d) = (&s.edges.extinction, lengths(s));
        let towards_the_eye = |c: &Vec<f64>| {
            (0..d.len()).rev().fold(c[d.len()], |behind, k| {
                let x = d[k] * (tau[k] + tau[k + 1]) / 2.0;
                let f = if x > 0.0 { -(-x).exp_m1() / x } else { 1.0 };
                let (near, far) = if x > 1e-3 {
                    (1.0 - f, f - (-x).exp())
                } else {
                    let near = x * (0.5 - x * (1.0 / 6.0 - x / 24.0));
                    (near, x * (0.5 - x * (1.0 / 3.0 - x / 8.0)))
                };
                behind * (-x).exp() + near * c[k] + far * c[k + 1]
            })
        };
        (s.edges.emission.iter().map(towards_the_eye).collect(), None)
    });
    let (names, rule) = read(&found);
    assert_eq!(names, ["wall"]);
    assert!(rule.wall.is_some());
}

/// Samples at both ends, the last one 10¹⁰ long.
#[test]
fn a_sample_at_the_far_end_is_the_wall() {
    let found = examined(|_, s| {
        let mut d = lengths(s);
        d.push(1e10);
        let mut through = 1.0;
        let mut weights = Vec::new();
        for (tau, d) in s.edges.extinction.iter().zip(d) {
            weights.push(through * right(*tau, d));
            through *= 1.0 - right(*tau, d);
        }
        (sums(&weights, &s.edges.emission), None)
    });
    let (names, _) = read(&found);
    assert_eq!(names, ["extra-sample", "wall"]);
}

/// Next to nothing hangs on the seed: no places are drawn by it.
#[test]
fn a_seed_that_scatters_answers_is_named_beside_the_rule() {
    let found = examined(|task, s| {
        // A hash of the seed, within ±5e-5.
        let mixed = (task.seed + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 11;
        let part = mixed as f64 / 53_f64.exp2() - 0.5;
        let (radiance, _) = march(s, right);
        (
            radiance.iter().map(|y| y * (1.0 + 1e-4 * part)).collect(),
            None,
        )
    });
    let (names, _) = read(&found);
    assert_eq!(names, ["seed"]);
}

/// Nothing can be read off answers that differ by a tenth; that they do is said.
#[test]
fn noise_is_named_where_nothing_else_can_be() {
    let mut asked = 0_u64;
    let found = examined(|_, s| {
        asked += 1;
        let mixed = asked.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 11;
        let part = mixed as f64 / 53_f64.exp2() - 0.5;
        let (radiance, _) = march(s, right);
        (
            radiance.iter().map(|y| y * (1.0 + 0.2 * part)).collect(),
            None,
        )
    });
    let names: Vec<&str> = found.deviations.iter().map(|one| one.name).collect();
    assert_eq!(names, ["noise"]);
    assert!(found.found.named().is_none());
}

/// The answer to a name is the one before under this name.
#[test]
fn what_is_kept_by_names_is_no_part_of_the_rule() {
    let mut kept: HashMap<String, Vec<f64>> = HashMap::new();
    let found = examined(|task, s| {
        let (radiance, _) = march(s, right);
        let name = task.subject.name().to_owned();
        let before = kept.insert(name, radiance.clone());
        (before.unwrap_or(radiance), None)
    });
    let (names, _) = read(&found);
    assert_eq!(names, ["answers-by-name"]);
}

/// Of Schraudolph's exponential every segment has its own rounding, and so has the opacity that it answers.
#[test]
fn an_opacity_to_the_precision_of_its_exponential_is_no_deviation() {
    let found = examined(|_, s| {
        march(s, |tau, d| {
            let bits = 12_102_203.161_561_485 * (-tau * d).max(-80.0) + 1_064_866_805.0;
            // Between those of 2^−116 and 1.
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            let bits = bits.floor() as u32;
            1.0 - f64::from(f32::from_bits(bits))
        })
    });
    let (names, _) = read(&found);
    assert_eq!(names, ["opacity-table"]);
}

/// A buffer of 8 bits.
fn eight_bits(_: &Task<'_>, s: &Segments) -> Answer {
    let (radiance, opacity) = march(s, right);
    let stored = |y: &f64| (y.clamp(0.0, 1.0) * 255.0 + 0.5).floor() / 255.0;
    (radiance.iter().map(stored).collect(), opacity)
}

/// With red, green and blue alone every impulse costs a third of a ray, and takes eight to be known.
#[test]
fn eight_bits_of_three_channels_take_no_more_than_six_hundred_rays() {
    let budget = Budget {
        rays: 600,
        channels: 3,
        ..Budget::default()
    };
    let found = within(budget, eight_bits);
    let (names, rule) = read(&found);
    assert_eq!(names, ["clip-high", "quantum"]);
    assert_eq!(rule.output.quantum, Some(1.0 / 255.0));
    assert!(found.found.hold_out.misses.is_empty());
}

#[test]
fn eight_bits_are_read_off_many_channels() {
    let found = examined(eight_bits);
    let (names, _) = read(&found);
    assert_eq!(names, ["clip-high", "quantum"]);
}
