//! A random ray of a kind.

use super::Terms;
use super::kinds::{Make, Values, What};
use crate::identify::random::Random;
use crate::identify::ray::{Emission, Layers, Ray};
use crate::identify::session::Session;

/// One ray, the `turn`th of its kind; `partial` where its last step is shorter.
pub(super) fn ray(
    session: &mut Session<'_>,
    random: &mut Random,
    make: Make,
    (partial, turn): (bool, usize),
    terms: &Terms<'_>,
) -> Ray {
    // Rays of one name have the same values.
    let mut same = Random::new(113);
    let random = if make.what == What::OneName {
        &mut same
    } else {
        random
    };
    let [fewest, most] = make.segments;
    let n = random
        .integer(fewest, most)
        .next_multiple_of(session.multiple);
    let [low, high] = make.depth;
    let depth = random.geometric(low, high) * terms.typical;
    let [short, long] = make.step;
    let step = random.geometric(short, long);
    let last = if partial {
        match make.what {
            What::ShortLast => random.geometric(2e-3, 4e-3),
            _ => random.within(0.15, 0.95),
        }
    } else {
        1.0
    };
    let has_gaps = matches!(make.what, What::Gaps | What::OneName);
    let mut taus = |count: usize| -> Vec<f64> {
        let scale = depth / (n as f64 * step);
        let one = |random: &mut Random| {
            let tau = random.uneven() * scale;
            if has_gaps && random.part() < 0.4 {
                0.0
            } else {
                tau
            }
        };
        (0..count).map(|_| one(random)).collect()
    };
    let (mut edges, mut middles) = (taus(n + 1), taus(n));
    match make.what {
        What::EmptyEnd => {
            // Every node of the segment at this end.
            (edges[n], edges[n - 1], middles[n - 1]) = (0.0, 0.0, 0.0);
            if partial {
                (edges[0], middles[0]) = (0.0, 0.0);
            }
        }
        What::EmptyEighths => {
            for tau in edges.iter_mut().step_by(8) {
                *tau = 0.0;
            }
        }
        What::Opaque(depth) => {
            let at = n / 3;
            let opaque = depth * terms.typical / step;
            (edges[at], edges[at + 1], middles[at]) = (opaque, opaque, opaque);
        }
        What::Smooth | What::Even | What::NearlyEven => {
            let mean = depth / (n as f64 * step);
            let mut part = parts(make.what, n, random);
            edges = (0..=n).map(|i| mean * part(i as f64)).collect();
            middles = (0..n).map(|i| mean * part(i as f64 + 0.5)).collect();
        }
        What::OneName => {
            // The same at both ends: a key made of these is no key.
            let mean = 0.5 * terms.typical / (n as f64 * step);
            (edges[0], middles[0], edges[n], middles[n - 1]) = (mean, mean, mean, mean);
        }
        What::Full | What::Gaps | What::Negative | What::ShortLast => {}
    }
    if make.values == Values::Symmetric {
        mirror(&mut edges);
        mirror(&mut middles);
    }
    let mut emission = emissions(make.what, n, brightest(make, partial, terms), random);
    of_kind(make.values, &mut emission, &edges, &middles);
    if make.what == What::OneName {
        let all = emission
            .iter_mut()
            .flat_map(|emission| [&mut emission.edges, &mut emission.middles]);
        for values in all.chain([&mut edges, &mut middles]) {
            rearrange(values, turn);
        }
    }
    let layers = Layers {
        step,
        last,
        edges,
        middles,
    };
    let mut ray = session.ray(&layers, &emission);
    // What hangs on the seed at times only.
    ray.seed = random.integer(1, 1_000_000) as u64;
    if make.what == What::OneName {
        ray.name = "probe".into();
    }
    ray
}

/// What part of its mean an extinction is at a place in segments, where it changes little from one to the next.
fn parts<'r>(what: What, n: usize, random: &'r mut Random) -> Box<dyn FnMut(f64) -> f64 + 'r> {
    match what {
        What::Smooth => {
            let wave = wave(random);
            Box::new(move |place| wave(place / n as f64))
        }
        What::NearlyEven => Box::new(move |place| match Stretch::at(place, n) {
            Stretch::SameExtinction(_) => 1.0,
            Stretch::SameEmission(part) => drift(part),
            Stretch::Neither => zigzag(place, random),
        }),
        _ => Box::new(|_| 1.0),
    }
}

/// The largest emission.
fn brightest(make: Make, partial: bool, terms: &Terms<'_>) -> f64 {
    let bright = make.bright * if partial { 1.0 } else { 4.0 };
    // Narrow formats end not far below.
    let is_dimmer = make.bright < 1.0 && terms.answers.unit < 1e-6;
    bright * if is_dimmer { 1e-3 } else { 1.0 }
}

/// The same from both ends.
fn mirror(values: &mut [f64]) {
    let near = values.len() / 2;
    let mirrored: Vec<f64> = values[..near].iter().rev().copied().collect();
    let far = values.len() - near;
    values[far..].copy_from_slice(&mirrored);
}

/// The emissions of three channels.
fn emissions(what: What, n: usize, bright: f64, random: &mut Random) -> Vec<Emission> {
    let low = if what == What::Negative { -bright } else { 0.0 };
    let mut emission: Vec<Emission> = (0..3)
        .map(|_| match what {
            What::Smooth => {
                let wave = wave(random);
                Emission::of(n, |i| 0.5 * bright * wave(i / n as f64))
            }
            What::Even => Emission::even(n, random.within(low, bright)),
            What::NearlyEven => {
                let even = bright * random.within(0.995, 1.005);
                Emission::of(n, |place| match Stretch::at(place, n) {
                    Stretch::SameExtinction(part) => even * drift(part),
                    Stretch::SameEmission(_) => even,
                    Stretch::Neither => bright * zigzag(place, random),
                })
            }
            _ => Emission::of(n, |_| random.within(low, bright)),
        })
        .collect();
    if what == What::Gaps {
        let mut dark = || random.part() < 0.3;
        let at_edges: Vec<bool> = (0..=n).map(|_| dark()).collect();
        let at_middles: Vec<bool> = (0..n).map(|_| dark()).collect();
        for emission in &mut emission {
            darken(&mut emission.edges, &at_edges);
            darken(&mut emission.middles, &at_middles);
        }
    }
    emission
}

/// Puts emissions of that kind in place.
fn of_kind(values: Values, emission: &mut [Emission], edges: &[f64], middles: &[f64]) {
    let all = |emission: &mut [Emission], of: &dyn Fn(f64) -> f64| {
        let nodes = emission.iter_mut();
        let nodes = nodes.flat_map(|one| one.edges.iter_mut().chain(&mut one.middles));
        nodes.for_each(|value| *value = of(*value));
    };
    match values {
        Values::Any | Values::Symmetric => {}
        Values::White => all(emission, &|_| 1.0),
        Values::Integers => all(emission, &f64::round),
        Values::Spike => {
            for one in emission {
                for values in [&mut one.edges, &mut one.middles] {
                    let at = values.len() / 3;
                    values.iter_mut().skip(at).take(1).for_each(|c| *c *= 100.0);
                }
            }
        }
        Values::Grey => {
            if let Some((grey, others)) = emission.split_first_mut() {
                others.fill(grey.clone());
            }
        }
        Values::Proportional => {
            let brightest = edges.iter().chain(middles).copied().fold(0.0, f64::max);
            for (part, one) in (1..).map(|k| 1.0 / f64::from(k)).zip(emission) {
                let of = |tau: &f64| part * tau / brightest;
                one.edges = edges.iter().map(of).collect();
                one.middles = middles.iter().map(of).collect();
            }
        }
    }
}

/// What is the same along a part of a ray that is nearly even; with the place as a part of that.
enum Stretch {
    Neither,
    SameExtinction(f64),
    SameEmission(f64),
}

impl Stretch {
    /// At a place in segments, of n.
    fn at(place: f64, n: usize) -> Self {
        let third = 3.0 * place / n as f64;
        match third {
            ..1.0 => Stretch::Neither,
            ..2.0 => Stretch::SameExtinction(third - 1.0),
            _ => Stretch::SameEmission(third - 2.0),
        }
    }
}

/// A factor by which neighbours differ and every second one hardly.
fn zigzag(place: f64, random: &mut Random) -> f64 {
    let up = place.floor().rem_euclid(2.0) == 0.0;
    1.0 + random.within(4.5e-3, 5e-3) * if up { 1.0 } else { -1.0 }
}

/// What neighbours are told apart by at last: a factor that leaves 1 in ever larger steps, by 1e-7 at first and by a third
/// in all.
fn drift(part: f64) -> f64 {
    1.0 + 10_f64.powf(6.5 * part - 7.0)
}

/// Nothing shines there.
fn darken(values: &mut [f64], dark: &[bool]) {
    let both = values.iter_mut().zip(dark);
    both.filter(|(_, dark)| **dark)
        .for_each(|(value, _)| *value = 0.0);
}

/// The same values in another order, but for those at the ends: what is made of their sum is no key.
fn rearrange(values: &mut [f64], turn: usize) {
    let [_, inside @ .., _] = values else { return };
    match turn {
        0 => {}
        1 => inside.reverse(),
        _ => inside.rotate_left(inside.len() / 3),
    }
}

/// A wave about 1, with two periods or fewer along the ray.
fn wave(random: &mut Random) -> impl Fn(f64) -> f64 + use<> {
    let (phase, periods) = (random.within(0.0, 6.0), random.within(0.5, 2.0));
    move |part| 1.0 + 0.9 * (phase + std::f64::consts::TAU * periods * part).sin()
}
