//! Whether a gradient is that of its own ray: asked one after another, and several in one request.
//!
//! Rays of as many segments have gradients of the same shape, so that one passes for another's. Cotangents of the rays differ
//! by powers of 2: which ray's numbers and which ray's cotangents a gradient was made of shows, to rounding.

use super::own::{Entry, ROUNDINGS, measured};
use super::rays::{Probe, alike};
use super::{Ray, rows};
use crate::identify::NotIdentified;
use crate::identify::deviation::{Deviation, plain};
use crate::identify::session::Session;
use crate::kernel::{GradientAt, KernelError};

/// What the cotangents of the rays are multiplied with.
const SCALES: [f64; 7] = [1.0, -2.0, 0.5, -0.25, 4.0, -8.0, 0.125];
/// Faults are found on so many rays, and held out on the others, which are more: what depends on how many there are shows.
const FIRST: usize = 3;

/// How probes were asked.
const ONE_AFTER_ANOTHER: &str = "gradients asked one after another";
const TOGETHER: &str = "gradients of several rays in one request";

/// The rays with their derivatives by the kernel's own values, and as answered one after another.
pub(super) struct Alike {
    /// Derivatives divided by the scales of their cotangents.
    pub(super) rays: Vec<Ray>,
    pub(super) unit: f64,
}

/// What came of several rays in one request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GradientsTogether {
    /// Rays of all requests.
    pub rays: usize,
    /// Those whose gradient is another one than alone.
    pub differ: usize,
}

/// The place of an answer among others.
struct Place<'s> {
    at: usize,
    scales: &'s [f64],
}

impl Place<'_> {
    /// The gradient of one ray, times that.
    fn one(&self, ray: usize, times: f64) -> Vec<f64> {
        let mut parts = vec![0.0; self.scales.len()];
        if let Some(part) = parts.get_mut(ray) {
            *part = times;
        }
        parts
    }

    fn last(&self) -> usize {
        self.scales.len() - 1
    }
}

/// An answer that somebody may give in place of the right one: the sum of so many times the gradient of each ray with
/// cotangents of scale 1. `None` where it says nothing.
struct Candidate {
    name: &'static str,
    does: &'static str,
    parts: fn(&Place<'_>) -> Option<Vec<f64>>,
}

/// Another ray than the own one, by the pattern of places.
type Other = fn(&Place<'_>) -> Option<usize>;

const FIRST_RAY: Other = |_| Some(0);
const LAST_RAY: Other = |place| Some(place.last());
const BEFORE: Other = |place| place.at.checked_sub(1);
const BEHIND: Other = |place| Some(place.at + 1).filter(|at| *at <= place.last());
const REVERSED: Other = |place| Some(place.last() - place.at);
const IN_PAIRS: Other = |place| Some(place.at ^ 1).filter(|at| *at <= place.last());

/// All that is that ray's.
fn whole(place: &Place<'_>, other: Other) -> Option<Vec<f64>> {
    let ray = other(place)?;
    Some(place.one(ray, place.scales[ray]))
}

/// That ray's numbers, with the own cotangents.
fn numbers(place: &Place<'_>, other: Other) -> Option<Vec<f64>> {
    Some(place.one(other(place)?, place.scales[place.at]))
}

/// The own numbers, with that ray's cotangents.
fn cotangents(place: &Place<'_>, other: Other) -> Option<Vec<f64>> {
    Some(place.one(place.at, place.scales[other(place)?]))
}

const OTHER: &str = "gradient-of-another-ray";
const SWAPPED: &str = "gradient-swapped";
const COTANGENTS: &str = "gradient-cotangents-of-another-ray";

/// One after another: the gradients of calls before.
static OF_CALLS: [Candidate; 6] = [
    Candidate {
        name: OTHER,
        does: "a gradient is that of the ray asked before",
        parts: |place| whole(place, BEFORE),
    },
    Candidate {
        name: OTHER,
        does: "a gradient is by the numbers of the ray asked before",
        parts: |place| numbers(place, BEFORE),
    },
    Candidate {
        name: OTHER,
        does: "every gradient is that of the ray asked first",
        parts: |place| whole(place, FIRST_RAY),
    },
    Candidate {
        name: OTHER,
        does: "every gradient is by the numbers of the ray asked first",
        parts: |place| numbers(place, FIRST_RAY),
    },
    Candidate {
        name: COTANGENTS,
        does: "a gradient is with the cotangents of the ray asked before",
        parts: |place| cotangents(place, BEFORE),
    },
    Candidate {
        name: "gradient-accumulated",
        does: "a gradient has those of all rays asked before added to it",
        parts: |place| Some(summed(place, place.at)),
    },
];

/// In one request.
static OF_REQUESTS: [Candidate; 18] = [
    Candidate {
        name: OTHER,
        does: "all rays of a request have the gradient of its first",
        parts: |place| whole(place, FIRST_RAY),
    },
    Candidate {
        name: OTHER,
        does: "all rays of a request have gradients by the numbers of its first",
        parts: |place| numbers(place, FIRST_RAY),
    },
    Candidate {
        name: OTHER,
        does: "all rays of a request have the gradient of its last",
        parts: |place| whole(place, LAST_RAY),
    },
    Candidate {
        name: OTHER,
        does: "all rays of a request have gradients by the numbers of its last",
        parts: |place| numbers(place, LAST_RAY),
    },
    Candidate {
        name: OTHER,
        does: "a gradient is that of the ray before in its request",
        parts: |place| whole(place, BEFORE),
    },
    Candidate {
        name: OTHER,
        does: "a gradient is by the numbers of the ray before in its request",
        parts: |place| numbers(place, BEFORE),
    },
    Candidate {
        name: OTHER,
        does: "a gradient is that of the ray behind in its request",
        parts: |place| whole(place, BEHIND),
    },
    Candidate {
        name: OTHER,
        does: "a gradient is by the numbers of the ray behind in its request",
        parts: |place| numbers(place, BEHIND),
    },
    Candidate {
        name: SWAPPED,
        does: "the rays of a request have their gradients in the reverse order",
        parts: |place| whole(place, REVERSED),
    },
    Candidate {
        name: SWAPPED,
        does: "the rays of a request have gradients by each other's numbers, in the reverse order",
        parts: |place| numbers(place, REVERSED),
    },
    Candidate {
        name: SWAPPED,
        does: "two rays of a request each have the other's gradient",
        parts: |place| whole(place, IN_PAIRS).or_else(|| whole(place, |place| Some(place.at))),
    },
    Candidate {
        name: COTANGENTS,
        does: "all rays of a request have the cotangents of its first",
        parts: |place| cotangents(place, FIRST_RAY),
    },
    Candidate {
        name: COTANGENTS,
        does: "all rays of a request have the cotangents of its last",
        parts: |place| cotangents(place, LAST_RAY),
    },
    Candidate {
        name: COTANGENTS,
        does: "the rays of a request have their cotangents in the reverse order",
        parts: |place| cotangents(place, REVERSED),
    },
    Candidate {
        name: "gradient-summed",
        does: "every gradient is the sum of those of all rays of its request",
        parts: |place| Some(summed(place, place.last())),
    },
    Candidate {
        name: "gradient-accumulated",
        does: "a gradient has those of the rays before in its request added to it",
        parts: |place| Some(summed(place, place.at)),
    },
    Candidate {
        name: "gradient-averaged",
        does: "every gradient is the mean of those of all rays of its request",
        parts: |place| {
            let count = place.scales.len() as f64;
            let sum = summed(place, place.last()).into_iter();
            Some(sum.map(|part| part / count).collect())
        },
    },
    Candidate {
        name: "gradient-divided-by-rays",
        does: "a gradient is divided by the number of rays of its request",
        parts: |place| {
            let count = place.scales.len() as f64;
            Some(place.one(place.at, place.scales[place.at] / count))
        },
    },
];

/// All gradients up to that place.
fn summed(place: &Place<'_>, last: usize) -> Vec<f64> {
    let scales = place.scales.iter().enumerate();
    let part = |(ray, scale): (usize, &f64)| if ray <= last { *scale } else { 0.0 };
    scales.map(part).collect()
}

/// A derivative of a ray with cotangents of scale 1, and how far rounding may take it; `None` where nothing is known.
type Known = Vec<Option<(f64, f64)>>;

/// Asks rays of as many segments one after another; with what is wrong of it.
pub(super) fn one_after_another(
    session: &mut Session<'_>,
    at: GradientAt,
) -> Result<(Alike, Option<Deviation>), NotIdentified> {
    let probes = alike(session, SCALES.len());
    let mut all: Vec<(Probe, Vec<Entry>)> = Vec::new();
    let mut unit = 0.0_f64;
    for probe in probes {
        let (entries, own) = measured(session, &probe, at)?;
        unit = unit.max(own);
        all.push((probe, entries));
    }
    // What was asked before is forgotten where it can be: the first is the first.
    session.restart();
    let mut answers = Vec::new();
    for ((probe, _), scale) in all.iter().zip(SCALES) {
        let gradient = session.derivatives(&probe.ray, &scaled(probe, scale), at)?;
        answers.push(rows(&gradient).concat());
    }
    let known: Vec<Known> = all
        .iter()
        .map(|(probe, entries)| by_values(probe, entries, unit))
        .collect();
    let held_out = fitting(
        &OF_CALLS,
        &known,
        &SCALES,
        &answers,
        unit,
        FIRST..SCALES.len(),
    );
    let found = fitting(&OF_CALLS, &known, &SCALES, &answers, unit, 0..FIRST);
    let found = found.filter(|found| is_same(found, held_out));
    let deviation = found.map(|found| of(found, ONE_AFTER_ANOTHER, "rays asked after these"));
    let rays = all.into_iter().zip(&answers).zip(SCALES);
    let rays = rays.map(|(((probe, entries), answer), scale)| {
        let width = entries.len();
        let unscaled: Vec<f64> = answer.iter().map(|x| x / scale).collect();
        Ray {
            probe,
            entries,
            answered: unscaled.chunks(width.max(1)).map(<[f64]>::to_vec).collect(),
        }
    });
    let rays = rays.collect();
    Ok((Alike { rays, unit }, deviation))
}

/// Asks the same rays in two requests, and compares with what each has alone. `None` where the kernel takes fewer rays at once.
pub(super) fn together(
    session: &mut Session<'_>,
    alike: &Alike,
    at: GradientAt,
) -> Result<Option<(GradientsTogether, Option<Deviation>)>, NotIdentified> {
    let mut shared = GradientsTogether { rays: 0, differ: 0 };
    let mut fits = Vec::new();
    let (first, others) = alike.rays.split_at(FIRST.min(alike.rays.len()));
    for (rays, scales) in [(first, &SCALES[..FIRST]), (others, &SCALES[FIRST..])] {
        let known: Vec<Known> = rays.iter().map(|ray| alone(ray, alike.unit)).collect();
        let asked: Vec<_> = rays
            .iter()
            .zip(scales)
            .map(|(ray, scale)| (&ray.probe.ray, scaled(&ray.probe, *scale)))
            .collect();
        let answered = session.derivatives_together(&asked, at)?;
        let answers: Result<Vec<Vec<f64>>, KernelError> = answered.and_then(|all| {
            all.into_iter()
                .map(|one| one.map(|gradient| rows(&gradient).concat()))
                .collect()
        });
        let answers = match answers {
            Ok(answers) => answers,
            Err(KernelError::Together { .. }) => return Ok(None),
            Err(error) => {
                shared.rays += rays.len();
                shared.differ += rays.len();
                let does =
                    format!("rays that have gradients alone have none in one request: {error}");
                return Ok(Some((
                    shared,
                    Some(plain("gradient-batch", TOGETHER, &does)),
                )));
            }
        };
        shared.rays += rays.len();
        shared.differ += (0..rays.len())
            .filter(|place| {
                let place = Place { at: *place, scales };
                let own = place.one(place.at, scales[place.at]);
                !is(&own, &known, &answers[place.at], alike.unit)
            })
            .count();
        let all = 0..rays.len();
        fits.push(fitting(
            &OF_REQUESTS,
            &known,
            scales,
            &answers,
            alike.unit,
            all,
        ));
    }
    if shared.differ == 0 {
        return Ok(Some((shared, None)));
    }
    let deviation = match fits[..] {
        [Some(found), held_out] if is_same(found, held_out) => {
            of(found, TOGETHER, "other rays of another request")
        }
        _ => {
            let does = "a gradient depends on the other rays of its request";
            plain("gradient-batch", TOGETHER, does)
        }
    };
    Ok(Some((shared, Some(deviation))))
}

fn is_same(found: &Candidate, held_out: Option<&Candidate>) -> bool {
    held_out.is_some_and(|held_out| std::ptr::eq(found, held_out))
}

fn of(found: &Candidate, probe: &'static str, validated: &str) -> Deviation {
    Deviation {
        validated: vec![validated.into()],
        ..plain(found.name, probe, found.does)
    }
}

fn scaled(probe: &Probe, scale: f64) -> Vec<f64> {
    probe.cotangents.iter().map(|a| a * scale).collect()
}

/// What the values say.
fn by_values(probe: &Probe, entries: &[Entry], unit: f64) -> Known {
    let sides = super::sides(probe.cotangents.len());
    let all = sides.flat_map(|side| entries.iter().map(move |entry| (entry, side)));
    let known = all.map(|(entry, side)| {
        let truth = entry.truth(side)?;
        Some((truth.value, entry.tolerance(side, unit)))
    });
    known.collect()
}

/// What was answered alone.
fn alone(ray: &Ray, unit: f64) -> Known {
    let all = ray.sides().flat_map(|side| {
        let values = ray.of(side);
        values.map(move |(entry, got)| (got, ROUNDINGS * unit * entry.size(side)))
    });
    all.map(|(got, tolerance)| got.is_finite().then_some((got, tolerance)))
        .collect()
}

/// The one candidate that all answers of these places are; `None` where they are right, of none, or of several.
fn fitting<'c>(
    candidates: &'c [Candidate],
    known: &[Known],
    scales: &[f64],
    answers: &[Vec<f64>],
    unit: f64,
    places: std::ops::Range<usize>,
) -> Option<&'c Candidate> {
    let is_all = |parts: &dyn Fn(&Place<'_>) -> Option<Vec<f64>>| {
        places.clone().all(|at| {
            let place = Place { at, scales };
            let wanted = parts(&place);
            wanted.is_none_or(|wanted| is(&wanted, known, &answers[at], unit))
        })
    };
    if is_all(&|place| Some(place.one(place.at, place.scales[place.at]))) {
        return None;
    }
    let mut fitting = candidates.iter().filter(|one| is_all(&one.parts));
    fitting.next().filter(|_| fitting.next().is_none())
}

/// Whether an answer is so many times the gradient of each ray.
fn is(parts: &[f64], known: &[Known], answer: &[f64], unit: f64) -> bool {
    answer.iter().enumerate().all(|(i, got)| {
        let (mut sum, mut tolerance) = (0.0, 0.0);
        for (part, known) in parts.iter().zip(known).filter(|(part, _)| **part != 0.0) {
            let Some(Some((value, error))) = known.get(i) else {
                return true;
            };
            sum += part * value;
            tolerance += part.abs() * (error + ROUNDINGS * unit * value.abs());
        }
        (got - sum).abs() <= tolerance
    })
}
