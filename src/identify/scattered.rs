//! Samples whose places are drawn at random: their law over even media, where each seed's sample lies, means held out.

use super::deviation::{Deviation, deviations, right_of};
use super::opacity::fit::{Fitted, laws};
use super::opacity::measure::Point;
use super::random::Random;
use super::ray::{Emission, Layers};
use super::rule::{Law, Place, Rule, Scheme};
use super::session::Session;
use super::weights::{Answers, Measured};
use super::{Identification, NotIdentified};
use std::fmt;

/// A kernel that samples each segment somewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Scattered {
    /// What a segment does.
    pub law: Law,
    /// Whether all samples of a ray lie at the same part of their segments.
    pub one_shift: bool,
    /// Means over so many seeds were held out.
    pub seeds: usize,
    /// By how many standard errors the farthest of them differs.
    pub farthest: f64,
}

/// The law on the values where a sample lies, and how its place is drawn.
impl fmt::Display for Scattered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rule = Rule {
            scheme: Scheme::Sample {
                place: Place::Middle,
                law: self.law.clone(),
            },
            ..Rule::default()
        };
        let drawn = if self.one_shift {
            "samples at one part of all segments of a ray, drawn evenly by the seed"
        } else {
            "samples somewhere in their segments, each drawn evenly by the seed"
        };
        f.write_str(&rule.to_string().replace(MIDDLE, drawn))
    }
}

impl Scattered {
    /// In what it deviates from samples whose opacity is 1 − e^(−τ d).
    pub(super) fn deviations(&self, found: &Identification) -> Vec<Deviation> {
        let scheme = Scheme::Sample {
            place: Place::Middle,
            law: self.law.clone(),
        };
        let rule = Rule {
            scheme,
            output: found.parts.output.unwrap_or_default(),
            channels: found.parts.channels.unwrap_or_default(),
            ..Rule::default()
        };
        let all = deviations(&rule, &right_of(&rule), &found.brackets);
        let of_even = |deviation: Deviation| Deviation {
            probe: "even rays of one and two segments, and means over seeds",
            ..deviation
        };
        all.into_iter().map(of_even).collect()
    }
}

/// What a rule of samples in the middle says of their places.
const MIDDLE: &str = "samples in the middle of segments";

/// Seeds whose places are looked at.
const PLACES: u64 = 48;
/// Segments of a thin ray.
const MANY: usize = 64;
/// Their depth.
const THIN: f64 = 1e-4;
/// Seeds of the means that are held out.
const MEANS: u64 = 24;
/// Own draws that they are compared with.
const DRAWS: usize = 1_000;
/// Standard errors beyond which a mean is another one.
const FARTHEST: f64 = 5.0;
/// Depths of the segments whose law is measured.
const DEPTHS: [f64; 6] = [0.01, 0.1, 0.4, 1.0, 2.5, 6.0];
/// Their lengths.
const LENGTHS: [f64; 3] = [0.25, 1.0, 0.6];

/// An even ray.
struct Even {
    tau: f64,
    length: f64,
    n: usize,
    seed: u64,
}

fn answer(
    session: &mut Session<'_>,
    answers: &Answers,
    even: &Even,
    emission: Emission,
) -> Result<f64, NotIdentified> {
    let layers = Layers::of(even.length, &vec![even.tau; even.n]);
    let mut ray = session.ray(&layers, &[emission]);
    ray.seed = even.seed;
    let y = session.ask(&ray)?;
    Ok(answers.radiance(y[0]).value)
}

/// Reads off law and places.
pub(super) fn scattered(
    session: &mut Session<'_>,
    answers: &Answers,
) -> Result<Scattered, NotIdentified> {
    let law = law(session, answers)?;
    let even = |seed| Even {
        tau: 0.4,
        length: 1.0,
        n: 1,
        seed,
    };
    // C = λ on one segment is the place of the sample.
    let (weight, _) = law.of(&0.4, &1.0, &1.0);
    let mut places = Vec::new();
    for seed in 1..=PLACES {
        let y = answer(session, answers, &even(seed), Emission::of(1, |i| i))?;
        places.push(y / weight);
    }
    places.sort_by(f64::total_cmp);
    let count = places.len() as f64;
    let gap = places.iter().enumerate();
    let gap = gap.map(|(k, place)| (place - (k as f64 + 0.5) / count).abs());
    let gap = gap.fold(0.0, f64::max);
    let (first, last) = (places[0], places[places.len() - 1]);
    // Kolmogorov's bound at one in a thousand.
    if first < -1e-6 || last > 1.0 + 1e-6 || gap > 1.95 / count.sqrt() {
        return Err(NotIdentified::new(
            "the places of samples, by seed, are not spread evenly over a segment",
        )
        .with_rows(&["place"], places.iter().map(|p| vec![*p]).collect()));
    }
    // Of continuous places no two are the same.
    let apart = 16.0 * answers.unit;
    if places.windows(2).any(|w| w[1] - w[0] <= apart) {
        return Err(
            NotIdentified::new("the places of samples, by seed, are few")
                .with_rows(&["place"], places.iter().map(|p| vec![*p]).collect()),
        );
    }
    // Σ wᵢ (i + uᵢ) over thin segments; one shift has n times the variance of n shifts.
    let (thin, passes) = law.of(&THIN, &1.0, &(MANY as f64));
    let weights = std::iter::successors(Some(thin), |w| Some(w * passes));
    let weights: Vec<f64> = weights.take(MANY).collect();
    let fronts: f64 = weights.iter().enumerate().map(|(i, w)| i as f64 * w).sum();
    let whole: f64 = weights.iter().sum();
    let mut means = Vec::new();
    for seed in 1..=MEANS {
        let ray = Even {
            tau: THIN,
            length: 1.0,
            n: MANY,
            seed,
        };
        let y = answer(session, answers, &ray, Emission::of(MANY, |i| i))?;
        means.push((y - fronts) / whole);
    }
    let spread = variance(&means);
    let mean = means.iter().sum::<f64>() / MEANS as f64;
    if (mean - 0.5).abs() > FARTHEST * (spread / MEANS as f64).sqrt() {
        let reason = format!("samples lie at {mean:.3} of their segments in the mean");
        return Err(NotIdentified::new(reason)
            .with_rows(&["mean place"], means.iter().map(|p| vec![*p]).collect()));
    }
    let one_shift = spread > 8.0 / 12.0 / MANY as f64;
    let farthest = held_out(session, answers, &law, one_shift)?;
    Ok(Scattered {
        law,
        one_shift,
        seeds: usize::try_from(MEANS).unwrap_or(0),
        farthest,
    })
}

fn variance(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / (count - 1.0)
}

/// The law, from C = 1 over even rays of one segment and of two.
fn law(session: &mut Session<'_>, answers: &Answers) -> Result<Law, NotIdentified> {
    let ones = |seed, n| Even {
        tau: 0.7,
        length: 0.4,
        n,
        seed,
    };
    let one = |n| Emission::even(n, 1.0);
    let first = answer(session, answers, &ones(1, 5), one(5))?;
    let second = answer(session, answers, &ones(2, 5), one(5))?;
    if (first - second).abs() > answers.relative(5) * first.abs() {
        return Err(NotIdentified::new(
            "answers depend on the seed over an even ray, too: it is not only places that are drawn",
        ));
    }
    let mut points = Vec::new();
    for length in LENGTHS {
        for depth in DEPTHS {
            let even = |n| Even {
                tau: depth / length,
                length,
                n,
                seed: 0,
            };
            let single = answer(session, answers, &even(1), one(1))?;
            let double = answer(session, answers, &even(2), one(2))?;
            let error = 8.0 * answers.unit;
            let passes = double / single - 1.0;
            points.push(Point {
                extinction: depth / length,
                length,
                ray: length,
                weight: Measured {
                    value: single,
                    error: error * single.abs() + 2.0 * answers.unit,
                },
                passes: Measured {
                    value: passes,
                    error: 4.0 * error + 4.0 * answers.unit / single.abs(),
                },
            });
        }
    }
    let found: Vec<Fitted> = laws(&points, 0.0, answers);
    let whole = found.into_iter().find(|fitted| fitted.share > 0.999);
    whole.map(|fitted| fitted.law).ok_or_else(|| {
        let row = |p: &Point| vec![p.extinction, p.length, p.weight.value, p.passes.value];
        NotIdentified::new("no law known for what a segment adds and lets through").with_rows(
            &["extinction", "length", "weight", "let through"],
            points.iter().map(row).collect(),
        )
    })
}

/// How C and τ lie between the nodes of a segment.
#[derive(Clone, Copy)]
enum Between {
    /// Linear from end to middle to end.
    Nodes,
    /// Linear from end to end.
    Ends,
}

impl Between {
    fn at(self, ends: [f64; 2], middle: f64, part: f64) -> f64 {
        let middle = match self {
            Between::Nodes => middle,
            Between::Ends => f64::midpoint(ends[0], ends[1]),
        };
        if part < 0.5 {
            ends[0] + 2.0 * part * (middle - ends[0])
        } else {
            middle + (2.0 * part - 1.0) * (ends[1] - middle)
        }
    }
}

/// Means over seeds beside those of own draws; by how many standard errors the farthest differs.
fn held_out(
    session: &mut Session<'_>,
    answers: &Answers,
    law: &Law,
    one_shift: bool,
) -> Result<f64, NotIdentified> {
    let mut random = Random::new(71);
    let n = 11;
    let length = 0.3;
    let mut farthest = [0.0_f64; 2];
    for total in [0.3, 2.0, 8.0] {
        let scale = total / (n as f64 * length);
        let layers = Layers {
            step: length,
            last: 1.0,
            edges: (0..=n).map(|_| random.uneven() * scale).collect(),
            middles: (0..n).map(|_| random.uneven() * scale).collect(),
        };
        let emission = Emission::of(n, |_| random.within(0.0, 1.0));
        let mut got = Vec::new();
        for seed in 0..MEANS {
            let mut ray = session.ray(&layers, std::slice::from_ref(&emission));
            ray.seed = 31 * seed + 5;
            got.push(answers.radiance(session.ask(&ray)?[0]).value);
        }
        for (between, farthest) in [Between::Nodes, Between::Ends]
            .into_iter()
            .zip(&mut farthest)
        {
            let own: Vec<f64> = (0..DRAWS)
                .map(|_| drawn(law, &layers, &emission, between, one_shift, &mut random))
                .collect();
            let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
            let error =
                (variance(&own) / own.len() as f64 + variance(&own) / got.len() as f64).sqrt();
            *farthest = farthest.max((mean(&got) - mean(&own)).abs() / error.max(1e-300));
        }
    }
    let nearest = farthest[0].min(farthest[1]);
    if nearest > FARTHEST {
        return Err(NotIdentified::new(format!(
            "means over {MEANS} seeds differ from those of places drawn evenly by {nearest:.1} standard errors"
        )));
    }
    Ok(nearest)
}

/// One ray with own draws.
fn drawn(
    law: &Law,
    layers: &Layers,
    emission: &Emission,
    between: Between,
    one_shift: bool,
    random: &mut Random,
) -> f64 {
    let shift = random.part();
    let n = layers.count();
    let ray = n as f64 * layers.step;
    let (mut sum, mut passes) = (0.0, 1.0);
    for i in 0..n {
        let part = if one_shift { shift } else { random.part() };
        let at =
            |edges: &[f64], middles: &[f64]| between.at([edges[i], edges[i + 1]], middles[i], part);
        let tau = at(&layers.edges, &layers.middles);
        let (weight, through) = law.of(&tau, &layers.step, &ray);
        sum += passes * weight * at(&emission.edges, &emission.middles);
        passes *= through;
    }
    sum
}
