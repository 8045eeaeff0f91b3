//! Gradients of kernels that draw random numbers: means over seeds.

use super::{at, trapezoids};
use crate::kernel_verify::subjects;
use rug::Float;
use volver::convergence::Ladder;
use volver::kernel::{
    Declaration, Gradient, GradientAt, Kernel, KernelError, Rendering, Sampling, Segments, Task,
};
use volver::study::Silent;
use volver::study::gradient::{
    Against, Biased, Conclusion, Derivative, Gradients, Standing, Trouble, gradients,
};
use volver::study::verify::{Axis, Settings};

#[derive(Clone, Copy, Debug, PartialEq)]
enum Estimator {
    /// One place in every segment, of even chance; the derivative of the very sum.
    Jittered,
    /// The same with transmittances that are held fast: what dims has no part in it.
    Detached,
    /// The same, 3 % too large.
    Factor,
    /// The same, times 0.
    Zero,
    /// The same, and another one when asked again.
    Unsteady,
    /// Trapezoids, whose bias is theirs, with derivatives that are off by 1e-6 of each at most.
    Noisy,
    /// So many segments chosen by their weights; chances are held fast.
    Chosen(usize),
    /// The same, but chances are differentiated as a part of the estimate, though what is chosen does not move.
    Attached(usize),
}
use Estimator::*;

#[derive(Debug)]
struct Drawn {
    declaration: Declaration,
    estimator: Estimator,
    asked: u64,
}

/// `SplitMix64` (Steele, Lea, Flood 2014), from 0 to 1.
struct Even(u64);

impl Even {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / 53_f64.exp2()
    }
}

type Rows = (Vec<f64>, Vec<Vec<f64>>);

fn light(a: &[f64], emission: &[Vec<f64>], i: usize) -> f64 {
    a.iter().zip(emission).map(|(a, row)| a * row[i]).sum()
}

fn jittered(segments: &Segments, a: &[f64], random: &mut Even, is_detached: bool) -> Rows {
    let edges = &segments.edges;
    let lengths: Vec<f64> = segments.lengths().collect();
    let n = lengths.len();
    let places: Vec<f64> = (0..n).map(|_| random.next()).collect();
    let between = |row: &[f64], i: usize| (1.0 - places[i]) * row[i] + places[i] * row[i + 1];
    let mut passes = vec![1.0];
    for i in 0..n {
        let depth = between(&edges.extinction, i) * lengths[i];
        passes.push(passes[i] * (-depth).exp());
    }
    let mut by_tau = vec![0.0; n + 1];
    let mut by_c = vec![vec![0.0; n + 1]; a.len()];
    let mut behind = 0.0;
    for i in (0..n).rev() {
        let seen = (1.0 - places[i]) * light(a, &edges.emission, i)
            + places[i] * light(a, &edges.emission, i + 1);
        let weight = passes[i] - passes[i + 1];
        let from_behind = if is_detached { 0.0 } else { behind };
        let slope = lengths[i] * (passes[i + 1] * seen - from_behind);
        for (at, part) in [(i, 1.0 - places[i]), (i + 1, places[i])] {
            by_tau[at] += part * slope;
            for (row, a) in by_c.iter_mut().zip(a) {
                row[at] += part * a * weight;
            }
        }
        behind += weight * seen;
    }
    (by_tau, by_c)
}

fn chosen(segments: &Segments, a: &[f64], random: &mut Even, count: usize, attached: bool) -> Rows {
    let middles = &segments.middles;
    let lengths: Vec<f64> = segments.lengths().collect();
    let n = lengths.len();
    let mut passes = vec![1.0];
    for (length, tau) in lengths.iter().zip(&middles.extinction) {
        passes.push(passes[passes.len() - 1] * (-tau * length).exp());
    }
    let all = 1.0 - passes[n];
    let mut hits = vec![0.0; n];
    for _ in 0..count {
        let left = 1.0 - random.next() * all;
        let i = passes.partition_point(|pass| *pass > left).max(1) - 1;
        hits[i.min(n - 1)] += 1.0 / count as f64;
    }
    let mut by_tau = vec![0.0; n];
    let mut behind = 0.0;
    let mean: f64 = (0..n)
        .map(|i| hits[i] * light(a, &middles.emission, i))
        .sum();
    for i in (0..n).rev() {
        let own = all * hits[i] * light(a, &middles.emission, i);
        let ratio = passes[i + 1] / (passes[i] - passes[i + 1]).max(1e-300);
        by_tau[i] = if attached {
            lengths[i] * passes[n] * mean
        } else {
            lengths[i] * (ratio * own - behind)
        };
        behind += own;
    }
    let by_c = a
        .iter()
        .map(|a| hits.iter().map(|hit| a * all * hit).collect());
    (by_tau, by_c.collect())
}

impl Kernel for Drawn {
    fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    fn render(&mut self, _: &Task<'_>) -> Result<Rendering, KernelError> {
        Ok(Rendering::default())
    }

    fn gradient(
        &mut self,
        task: &Task<'_>,
        cotangents: &[f64],
    ) -> Result<(Rendering, Gradient), KernelError> {
        self.asked += 1;
        let seed = match self.estimator {
            Unsteady => self.asked,
            _ => task.seed,
        };
        let mut random = Even((seed << 20) + task.segments);
        let segments = task.cut().expect("segments");
        let (mut extinction, emission) = match self.estimator {
            Noisy => {
                let (mut by_tau, mut by_c) = trapezoids(segments, cotangents, false);
                for x in by_c.iter_mut().flatten().chain(&mut by_tau) {
                    *x *= 1.0 + 1e-6 * (2.0 * random.next() - 1.0);
                }
                (by_tau, by_c)
            }
            Chosen(count) => chosen(segments, cotangents, &mut random, count, false),
            Attached(count) => chosen(segments, cotangents, &mut random, count, true),
            _ => jittered(
                segments,
                cotangents,
                &mut random,
                self.estimator == Detached,
            ),
        };
        let times = match self.estimator {
            Factor => 1.03,
            Zero => 0.0,
            _ => 1.0,
        };
        for x in &mut extinction {
            *x *= times;
        }
        let floats = |row: Vec<f64>| row.into_iter().map(|x| Float::with_val(53, x)).collect();
        let gradient = Gradient {
            extinction: floats(extinction),
            emission: emission.into_iter().map(floats).collect(),
        };
        Ok((Rendering::default(), gradient))
    }
}

fn found(estimator: Estimator) -> Gradients {
    let settings = Settings::standard(Axis::Step).unwrap();
    asked(estimator, &settings, &["rgb-transfer", "decaying-field"])
}

fn asked(estimator: Estimator, settings: &Settings, cases: &[&str]) -> Gradients {
    let declaration = match estimator {
        Chosen(_) | Attached(_) => at(GradientAt::Middles, None),
        Noisy => at(GradientAt::Edges, Some(Sampling::Ends)),
        _ => at(GradientAt::Edges, Some(Sampling::Jittered)),
    };
    let mut kernel = Drawn {
        declaration: Declaration {
            stochastic: true,
            ..declaration
        },
        estimator,
        asked: 0,
    };
    gradients(&mut kernel, &subjects(cases), settings, &Silent).unwrap()
}

#[test]
fn without_a_bias_none_is_seen() {
    for estimator in [Jittered, Chosen(40_000)] {
        let found = found(estimator);
        assert_eq!(found.conclusion(), Conclusion::Confirmed, "{estimator:?}");
        assert_eq!(found.lines().count(), 0);
        // Two cases, two derivatives, two sums.
        assert_eq!(found.biases().count(), 8);
        for bias in found.biases() {
            assert_eq!(bias.standing, Standing::Confirmed, "{bias:?}");
        }
    }
}

#[test]
fn a_bias_that_seeds_resolve_falls_with_the_order_of_the_samples() {
    let ladder: Ladder = "32,64,128,256".parse().unwrap();
    let settings = Settings::new(&ladder).unwrap();
    let found = asked(Noisy, &settings, &["rgb-transfer", "decaying-field"]);
    assert_eq!(found.conclusion(), Conclusion::Confirmed, "{found:?}");
    for bias in found.biases() {
        assert_eq!(bias.biased, Biased::Falls, "{bias:?}");
        let order = bias.fit.bias.expect("a bias that falls has an order");
        // That of trapezoids.
        assert!((order.order - 2.0).abs() <= 0.25, "{order:?}");
    }
}

#[test]
fn a_bias_that_stays_is_measured_beside_its_standard_error() {
    for estimator in [Detached, Factor, Attached(40_000)] {
        let found = found(estimator);
        assert_eq!(found.conclusion(), Conclusion::NotConfirmed);
        for bias in found.biases() {
            let is_right = bias.derivative == Derivative::Emission;
            let standing = if is_right {
                Standing::Confirmed
            } else {
                Standing::Contradicted
            };
            assert_eq!(bias.standing, standing, "{estimator:?} {bias:?}");
            if is_right {
                continue;
            }
            assert_eq!(bias.biased, Biased::Stays);
            assert!(bias.standard_errors() > 6.0);
            let finest = bias.finest().unwrap();
            // 3 % of theory, summed with theory itself.
            if estimator == Factor && bias.against == Against::Theory {
                let off = (finest.mean - 0.03).abs();
                assert!(off <= 5.0 * finest.standard_error + 1e-5, "{finest:?}");
            }
        }
    }
}

#[test]
fn scatter_that_hides_a_bias_confirms_nothing() {
    let found = found(Chosen(20));
    assert_eq!(found.conclusion(), Conclusion::NotConfirmed);
    let unresolved = found
        .biases()
        .filter(|bias| bias.biased == Biased::Unresolved);
    assert!(unresolved.count() >= 4, "{found:?}");
    assert_eq!(found.count(Standing::Contradicted), 0);
}

#[test]
fn what_is_wrong_with_every_seed_has_its_name() {
    let found_zero = found(Zero);
    for case in &found_zero.cases {
        assert_eq!(case.troubles, [Trouble::Zero(Derivative::Extinction)]);
    }
    assert_eq!(found_zero.count(Standing::Contradicted), 4);
    let found = found(Unsteady);
    for case in &found.cases {
        assert_eq!(case.troubles, [Trouble::Unsteady]);
    }
    assert_eq!(found.conclusion(), Conclusion::NotConfirmed);
}
