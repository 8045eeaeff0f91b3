//! Many rays in one request, beside the answers that each has alone.

use super::deviation::{Deviation, drifts, of_batch};
use super::random::Random;
use super::ray::{Emission, Layers, Ray};
use super::session::{Budget, Session, Spent};
use super::silence::Silence;
use super::state::{Batch, shared};
use crate::kernel::{Kernel, KernelError, Rendering};
use rug::Float;
use std::cmp::Ordering;
use std::ops::RangeInclusive;
use std::time::Duration;

/// So many rays may be asked in one request: as many answers fit into a line.
pub const TOGETHER: RangeInclusive<u64> = 2..=4_096;

/// Segments of the longest ray: more than a loop unrolled, or a warp, takes at once.
const LONGEST: usize = 64;
/// Rays beside those of the request, to tell why they differ.
const TO_TELL: u64 = 32;

/// What came of asking many rays in one request.
#[derive(Clone, Debug)]
pub struct Together {
    /// How many there were.
    pub rays: usize,
    /// Segments of the shortest and of the longest.
    pub segments: (usize, usize),
    /// How many have another answer than alone, or one where they have none alone, or none where they have one.
    pub differ: usize,
    /// The first of these.
    pub first: Option<Apart>,
    /// What they depend on, as `volver identify` names it.
    pub deviation: Option<Deviation>,
}

/// A ray with two answers.
#[derive(Clone, Debug)]
pub struct Apart {
    /// Its place in the request, from 0.
    pub ray: usize,
    /// Its segments.
    pub segments: usize,
    /// Its step.
    pub step: f64,
    /// What it has alone.
    pub alone: Result<Rendering, KernelError>,
    /// What it has in the request.
    pub together: Result<Rendering, KernelError>,
}

/// Asks so many rays of different length, step and n, each alone and then all in one request, and compares all that is
/// answered to the last bit.
///
/// # Errors
/// [`Silence`] where a ray cannot be put, no ray has an answer alone, or the kernel takes fewer in one request.
pub fn together(
    kernel: &mut dyn Kernel,
    count: usize,
    heard: &mut dyn FnMut(&Spent),
) -> Result<Together, Silence> {
    let budget = Budget {
        rays: 2 * count as u64 + TO_TELL,
        time: Duration::MAX,
        ..Budget::default()
    };
    kernel.renew();
    let mut session = Session::new(kernel, budget, heard);
    let rays = rays(&mut session, count);
    let mut alone = Vec::with_capacity(count);
    for ray in &rays {
        alone.push(session.alone(ray)?);
    }
    if let Some(Err(error)) = alone.first().filter(|_| alone.iter().all(Result::is_err)) {
        return Err(Silence::Kernel {
            segments: rays.first().map_or(0, |ray| ray.segments.count()),
            error: error.clone(),
        });
    }
    let answers = match session.at_once(&rays)? {
        Ok(answers) => answers,
        // Alone they have answers.
        Err(error) => rays.iter().map(|_| Err(error.clone())).collect(),
    };
    let pairs = alone.iter().zip(&answers);
    let differ = pairs
        .enumerate()
        .filter(|(_, (one, other))| !same(one, other));
    let differ: Vec<usize> = differ.map(|(ray, _)| ray).collect();
    let sizes = || rays.iter().map(|ray| ray.segments.count());
    let first = differ.first().map(|&ray| Apart {
        ray,
        segments: rays[ray].segments.count(),
        step: rays[ray].step(),
        alone: alone[ray].clone(),
        together: answers[ray].clone(),
    });
    let deviation = match differ[..] {
        [] => None,
        _ => cause(&mut session, &rays, &alone, &answers, &differ)?,
    };
    Ok(Together {
        rays: count,
        segments: (sizes().min().unwrap_or(0), sizes().max().unwrap_or(0)),
        differ: differ.len(),
        first,
        deviation,
    })
}

/// Rays of different length and step, and n that differ from one to the next; the one with the most segments stands
/// among the others.
fn rays(session: &mut Session<'_>, count: usize) -> Vec<Ray> {
    let mut random = Random::new(19);
    let mut before = LONGEST;
    let all = (0..count).map(|place| {
        let drawn = random.integer(1, LONGEST - 1);
        let n = match drawn {
            _ if place == count / 2 => LONGEST,
            same if same == before => same % (LONGEST - 1) + 1,
            other => other,
        };
        before = n;
        let n = n.next_multiple_of(session.multiple);
        let length = random.geometric(0.5, 3.0);
        let layers = Layers {
            step: length / n as f64,
            last: 1.0,
            edges: random.many(n + 1, 0.2, 1.5),
            middles: random.many(n, 0.2, 1.5),
        };
        let emission: Vec<Emission> = (0..3)
            .map(|_| Emission::of(n, |_| random.within(0.2, 1.0)))
            .collect();
        Ray {
            // Kernels that draw random numbers draw each ray's own.
            seed: place as u64,
            ..session.ray(&layers, &emission)
        }
    });
    all.collect()
}

/// On what the answers of a request depend.
fn cause(
    session: &mut Session<'_>,
    rays: &[Ray],
    alone: &[Result<Rendering, KernelError>],
    answers: &[Result<Rendering, KernelError>],
    differ: &[usize],
) -> Result<Option<Deviation>, Silence> {
    if let Some(Err(error)) = answers
        .first()
        .filter(|_| answers.iter().all(Result::is_err))
    {
        return Ok(of_batch(Batch::Differs).map(|deviation| Deviation {
            does: format!("rays that have answers alone have none in one request: {error}"),
            ..deviation
        }));
    }
    let longest = (0..rays.len()).max_by_key(|ray| rays[*ray].segments.count());
    let longest = longest.unwrap_or(0);
    let apart = differ.iter().copied().find(|ray| *ray != longest);
    let apart = apart.unwrap_or(longest);
    // What changes from request to request has nothing to do with the other rays.
    if !same(&session.alone(&rays[apart])?, &alone[apart]) {
        return Ok(Some(drifts()));
    }
    let beside = if apart == longest {
        usize::from(apart == 0)
    } else {
        longest
    };
    let radiance = |ray: usize| {
        let answer = alone[ray].as_ref().ok()?;
        Some(
            answer
                .radiance
                .iter()
                .map(Float::to_f64)
                .collect::<Vec<f64>>(),
        )
    };
    let batch = match (radiance(beside), radiance(apart)) {
        (Some(one), Some(other)) if !one.is_empty() => {
            shared(session, &rays[beside], &rays[apart], [&one, &other]).ok()
        }
        _ => None,
    };
    // Two may be too few to show it.
    let batch = batch.filter(|batch| *batch != Batch::Same);
    Ok(of_batch(batch.unwrap_or(Batch::Differs)))
}

/// To the last bit, in all that is answered.
fn same(one: &Result<Rendering, KernelError>, other: &Result<Rendering, KernelError>) -> bool {
    match (one, other) {
        (Ok(one), Ok(other)) => is_same(one, other),
        (Err(_), Err(_)) => true,
        _ => false,
    }
}

fn is_same(one: &Rendering, other: &Rendering) -> bool {
    let equal = |a: &Float, b: &Float| a.total_cmp(b) == Ordering::Equal;
    let numbers =
        |a: &[Float], b: &[Float]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| equal(a, b));
    let maybe = |a: &Option<Float>, b: &Option<Float>| match (a, b) {
        (Some(a), Some(b)) => equal(a, b),
        (None, None) => true,
        _ => false,
    };
    let bits = |errors: &Option<Vec<f64>>| -> Option<Vec<u64>> {
        let errors = errors.as_ref()?;
        Some(errors.iter().map(|error| error.to_bits()).collect())
    };
    numbers(&one.radiance, &other.radiance)
        && maybe(&one.opacity, &other.opacity)
        && maybe(&one.optical_depth, &other.optical_depth)
        && maybe(&one.expected_depth, &other.expected_depth)
        && one.step.map(f64::to_bits) == other.step.map(f64::to_bits)
        && one.segments == other.segments
        && one.edges == other.edges
        && bits(&one.standard_error) == bits(&other.standard_error)
}
