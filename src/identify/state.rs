//! Whether an answer depends on nothing but its question.

use super::NotIdentified;
use super::random::Random;
use super::ray::{Emission, Layers, Ray};
use super::session::Session;

/// What answers depend on beside the question.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct State {
    /// What comes of asking again.
    pub repeat: Repeat,
    /// Answers depend on the seed.
    pub seed: bool,
    /// An answer depends on the other tasks of its request.
    pub batch: Batch,
    /// What comes of another ray of the same name.
    pub name: Name,
}

/// What comes of asking another ray under the name of one before.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Name {
    /// Its own answer.
    #[default]
    Nothing,
    /// The first one's answer.
    First,
    /// Neither.
    Mixed,
}

/// What comes of asking again.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Repeat {
    /// The same answer.
    #[default]
    Same,
    /// The first answer of all is another one.
    FirstDiffers,
    /// The answer to the question before.
    Previous,
    /// Another answer, by up to this part.
    Differs(f64),
    /// The same answer, until others were asked.
    Drifts,
}

/// What comes of asking several rays at once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Batch {
    /// The same answers.
    #[default]
    Same,
    /// A ray goes on with the transmittance of the one before.
    Carried,
    /// All rays have the step of the first.
    FirstStep,
    /// What rays are padded with, to be as long as the longest, counts.
    Padding,
    /// Other answers.
    Differs,
}

/// Answers that differ by more than this say nothing.
const MOST_NOISE: f64 = 1e-3;
/// Uniform noise is so many times as wide as what few answers show of it.
const WIDER: f64 = 4.0;
/// Other seeds by which answers may differ as by noise.
const SEEDS: u64 = 4;

/// A ray of n random segments, its emission times `size`.
fn some(session: &mut Session<'_>, random: &mut Random, (n, step): (usize, f64), size: f64) -> Ray {
    let n = n.next_multiple_of(session.multiple);
    let layers = Layers {
        step,
        last: 1.0,
        edges: random.many(n + 1, 0.2, 1.5),
        middles: random.many(n, 0.2, 1.5),
    };
    let emission: Vec<Emission> = (0..3)
        .map(|_| Emission::of(n, |_| size * random.within(0.2, 1.0)))
        .collect();
    session.ray(&layers, &emission)
}

/// Asks two rays A and B as A, B, A, A, A with another seed, B under A's name, and at once. What was `found` stays where
/// nothing else can be told.
pub(super) fn state(
    session: &mut Session<'_>,
    found: &mut Option<State>,
) -> Result<(State, f64), NotIdentified> {
    let mut random = Random::new(5);
    // 16 and 11: a loop unrolled by 8 takes the most of one and not of the other.
    let a = some(session, &mut random, (16, 0.25), 1.0);
    let b = some(session, &mut random, (11, 0.4), 0.05);
    let seeded = Ray {
        seed: 12_345,
        ..a.clone()
    };
    let renamed = Ray {
        name: a.name.clone(),
        ..b.clone()
    };
    let mut y: Vec<Vec<f64>> = Vec::new();
    for (turn, ray) in [&a, &b, &a, &a, &seeded, &renamed].into_iter().enumerate() {
        // Where there are few rays, what came back once is not asked a third time.
        let is_known = turn == 3 && session.is_short() && is_same(&y[0], &y[2]);
        let answers = if is_known {
            y[2].clone()
        } else {
            session.once(ray)?.0
        };
        y.push(answers);
    }
    let all = || y.iter().flatten().copied();
    if !all().all(f64::is_finite) {
        return Err(NotIdentified::new("answers are not finite").with_answers(&y));
    }
    let (least, most) = all().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
        (low.min(y), high.max(y))
    });
    if least.to_bits() == most.to_bits() {
        return Err(NotIdentified::new(format!(
            "the answer is {least} to every question asked"
        )));
    }
    let mut state = State::default();
    let mut noise = 0.0;
    let same = |i: usize, j: usize| is_same(&y[i], &y[j]);
    if !same(2, 3) {
        let apart = f64::max(apart(&y[2], &y[3]), apart(&y[0], &y[3]));
        // A, B, A, A answered as ?, A, B, A.
        if same(1, 3) {
            state.repeat = Repeat::Previous;
            session.twice = true;
            return Ok((state, 0.0));
        }
        state.repeat = Repeat::Differs(apart);
        noise = WIDER * apart;
        if apart > MOST_NOISE {
            *found = Some(state);
            return Err(NotIdentified::new(format!(
                "the same question has answers that differ by {apart:.1e} of them"
            ))
            .with_answers(&y));
        }
    } else if !same(0, 2) {
        state.repeat = Repeat::FirstDiffers;
    }
    state.seed = noise == 0.0 && !same(3, 4);
    if state.seed && apart(&y[3], &y[4]) <= MOST_NOISE {
        noise = WIDER * by_seed(session, &a, &y[3], apart(&y[3], &y[4]))?;
    }
    if noise == 0.0 && !state.seed && !same(5, 1) {
        // Under its own name once more: what has changed by now has nothing to do with names.
        let (again, _) = session.once(&b)?;
        if !is_same(&again, &y[1]) {
            state.repeat = Repeat::Drifts;
        } else if same(5, 3) {
            state.name = Name::First;
        } else {
            state.name = Name::Mixed;
        }
    }
    if !session.is_short()
        && noise == 0.0
        && !state.seed
        && state.name == Name::Nothing
        && state.repeat == Repeat::Same
    {
        state.batch = shared(session, &a, &b, [&y[0], &y[1]])?;
    }
    Ok((state, noise))
}

/// By what part answers differ at most.
fn apart(one: &[f64], other: &[f64]) -> f64 {
    let parts = one.iter().zip(other);
    let parts = parts.map(|(u, v)| ((u - v) / u.abs().max(v.abs())).abs());
    parts.filter(|d| d.is_finite()).fold(0.0, f64::max)
}

/// The same of a ray under other seeds: places that are drawn make more of a difference, and noise no more; 0 where it is
/// none.
fn by_seed(
    session: &mut Session<'_>,
    ray: &Ray,
    before: &[f64],
    least: f64,
) -> Result<f64, NotIdentified> {
    let mut most = least;
    for seed in 1..=SEEDS {
        let seeded = Ray {
            seed: 777 * seed,
            ..ray.clone()
        };
        most = most.max(apart(before, &session.once(&seeded)?.0));
    }
    Ok(if most <= MOST_NOISE { most } else { 0.0 })
}

/// To the last bit.
pub(super) fn is_same(one: &[f64], other: &[f64]) -> bool {
    one.len() == other.len()
        && one
            .iter()
            .zip(other)
            .all(|(u, v)| u.to_bits() == v.to_bits())
}

/// What comes of A and B in one request.
pub(super) fn shared(
    session: &mut Session<'_>,
    a: &Ray,
    b: &Ray,
    alone: [&Vec<f64>; 2],
) -> Result<Batch, NotIdentified> {
    let answers = session.together(&[a.clone(), b.clone()]);
    let answers: Result<Vec<_>, _> = answers.into_iter().collect();
    let answers = answers?;
    let pairs = || answers.iter().zip(alone);
    if pairs().all(|((y, _), want)| is_same(y, want)) {
        return Ok(Batch::Same);
    }
    let near = |got: &[f64], want: &[f64]| {
        let both = got.iter().zip(want);
        both.into_iter()
            .all(|(y, want)| (y - want).abs() <= 1e-9 * want.abs())
    };
    // So little is rounding in another order, which every cause below would pass for.
    if pairs().all(|((y, _), want)| near(y, want)) {
        return Ok(Batch::Differs);
    }
    let is_first = is_same(&answers[0].0, alone[0]);
    let start = match answers[0].1 {
        Some(opacity) => Some(1.0 - opacity),
        None if is_first => seen_through(session, a, b, alone[1], &answers[1].0)?,
        None => None,
    };
    let starts = [Some(1.0), start];
    let carried = pairs().zip(starts).all(|(((y, _), want), start)| {
        start.is_some_and(|start| {
            let want: Vec<f64> = want.iter().map(|want| want * start).collect();
            near(y, &want)
        })
    });
    if carried {
        return Ok(Batch::Carried);
    }
    // The second one alone with the step of the first, in its place or by where its segments end.
    if is_first {
        let stepped = Ray {
            step: a.step,
            ..b.clone()
        };
        for stepped in [stretched(b, a.step / b.step), stepped] {
            if near(&answers[1].0, &session.once(&stepped)?.0) {
                return Ok(Batch::FirstStep);
            }
        }
    }
    // Only the shorter one is wrong, wherever it stands.
    let turned = session.together(&[b.clone(), a.clone()]);
    let turned: Result<Vec<_>, _> = turned.into_iter().collect();
    let turned = turned?;
    let is_padded = is_first
        && is_same(&turned[1].0, alone[0])
        && !is_same(&turned[0].0, alone[1])
        && near(&turned[0].0, &answers[1].0);
    Ok(if is_padded {
        Batch::Padding
    } else {
        Batch::Differs
    })
}

/// The part of B's answers that is left of them behind A, where that is a transmittance: the same in all channels, and
/// squared where A is twice as dense.
fn seen_through(
    session: &mut Session<'_>,
    a: &Ray,
    b: &Ray,
    alone: &[f64],
    behind: &[f64],
) -> Result<Option<f64>, NotIdentified> {
    let left = |answers: &[f64]| {
        let parts = answers.iter().zip(alone).map(|(y, want)| y / want);
        let (low, high) = parts.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), part| {
            (low.min(part), high.max(part))
        });
        let is_one = low > 0.0 && high < 1.0 && high - low <= 1e-9 * high;
        is_one.then_some(high)
    };
    let Some(once) = left(behind) else {
        return Ok(None);
    };
    let mut dense = a.clone();
    for samples in [&mut dense.segments.edges, &mut dense.segments.middles] {
        samples.extinction.iter_mut().for_each(|tau| *tau *= 2.0);
    }
    let answers: Result<Vec<_>, _> = session.together(&[dense, b.clone()]).into_iter().collect();
    let twice = answers?.get(1).and_then(|(y, _)| left(y));
    Ok(twice
        .filter(|twice| (twice - once * once).abs() <= 1e-6 * twice)
        .map(|_| once))
}

/// The same values along a ray of another length.
fn stretched(ray: &Ray, by: f64) -> Ray {
    let mut stretched = ray.clone();
    for samples in [
        &mut stretched.segments.edges,
        &mut stretched.segments.middles,
    ] {
        samples.lambda.iter_mut().for_each(|lambda| *lambda *= by);
    }
    let end = stretched.segments.edges.lambda.last().copied();
    let length = end.and_then(rug::Rational::from_f64);
    stretched.length = length.unwrap_or_else(|| ray.length.clone());
    stretched.step = ray.step * by;
    stretched
}
