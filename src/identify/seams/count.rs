//! How often samples are taken, by their weights over an even medium.

use crate::identify::NotIdentified;
use crate::identify::places::{Even, STEP};
use crate::identify::ray::Layers;
use crate::identify::rule::{Node, Place};
use crate::identify::session::Session;
use crate::identify::weights::{Answers, Measured, weights};

/// The extinction by that of the rays before: a segment absorbs next to nothing.
const THIN: f64 = 1.0 / 16.0;
/// Weights under this part of the largest are none.
const NONE: f64 = 1e-9;
/// A last segment by the others.
const SHORT: f64 = 0.3;
/// Between what weights of neighbours lie that are taken as often, and twice as often.
const SAME: (f64, f64) = (0.75, 1.1);
const TWICE: (f64, f64) = (1.5, 2.2);

/// How often each of the samples of a ray is taken.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Counted {
    pub(super) times: Vec<usize>,
}

impl Counted {
    /// n.
    pub(super) fn segments(&self) -> usize {
        self.times.len()
    }

    /// Whether all are taken once.
    pub(super) fn is_plain(&self) -> bool {
        self.times.iter().all(|times| *times == 1)
    }
}

/// What a sample weighs that is taken once, and what it lets through.
#[derive(Clone, Copy)]
struct Sample {
    weight: Measured,
    passes: Measured,
}

/// Counts samples.
pub(super) struct Counter {
    extinction: f64,
    is_middle: bool,
    sample: Option<Sample>,
    /// How often the nodes of rays are taken, by n.
    seen: Vec<(usize, Vec<usize>)>,
}

impl Counter {
    /// Of samples in the middles of segments or at their ends; `None` where they lie at both.
    pub(super) fn new(even: &Even) -> Option<Self> {
        let n = even.weights.ray.segments.count();
        let (edges, middles) = even.weights.of.split_at(n + 1);
        let top = |w: &[Measured]| w.iter().map(|w| w.value.abs()).fold(0.0, f64::max);
        let (at_edges, at_middles) = (top(edges), top(middles));
        let is_middle = at_middles > at_edges;
        let (most, least) = if is_middle {
            (at_middles, at_edges)
        } else {
            (at_edges, at_middles)
        };
        (least <= 1e-6 * most && most > 0.0).then_some(Counter {
            extinction: THIN * even.extinction,
            is_middle,
            sample: None,
            seen: Vec::new(),
        })
    }

    fn nodes(&self, n: usize) -> Vec<Node> {
        if self.is_middle {
            (0..n).map(Node::Middle).collect()
        } else {
            (0..=n).map(Node::Edge).collect()
        }
    }

    /// Counts the samples of a ray of n segments; whether that can be done.
    pub(super) fn look(
        &mut self,
        session: &mut Session<'_>,
        answers: &Answers,
        n: usize,
    ) -> Result<bool, NotIdentified> {
        if self.seen.iter().any(|(seen, _)| *seen == n) {
            return Ok(true);
        }
        let layers = Layers::of(STEP, &vec![self.extinction; n]);
        let found = weights(session, answers, &layers, &self.nodes(n), &[])?;
        let Some(times) = self.times(&found.of) else {
            // One sample alone says nothing, where the ray has a factor.
            let seen = found.of.iter().filter(|w| w.value.abs() > 3.0 * w.error);
            return Ok(self.sample.is_some() && seen.count() == 1);
        };
        if self.sample.is_none() {
            self.sample = sample(&found.of, &times);
        }
        let Some(sample) = self.sample else {
            return Ok(false);
        };
        let fits = follows(&sample, &found.of, &times, answers.relative(n));
        self.seen.push((n, times));
        Ok(fits)
    }

    /// Whether the value in front of the last segment is that segment's: it weighs less where that is shorter.
    pub(super) fn is_short_in_front(
        &self,
        session: &mut Session<'_>,
        answers: &Answers,
        n: usize,
    ) -> Result<bool, NotIdentified> {
        let nodes = [Node::Edge(n - 1)];
        let mut layers = Layers::of(STEP, &vec![self.extinction; n]);
        let whole = weights(session, answers, &layers, &nodes, &[])?.of[0];
        layers.last = SHORT;
        let short = weights(session, answers, &layers, &nodes, &[])?.of[0];
        Ok(short.value < SAME.0 * whole.value)
    }

    /// By the weights of neighbours, which are all but equal or twice each other.
    fn times(&self, w: &[Measured]) -> Option<Vec<usize>> {
        let top = w.iter().map(|w| w.value.abs()).fold(0.0, f64::max);
        let lit = |w: &&Measured| w.value.abs() > NONE * top + 3.0 * w.error;
        let within = |x: f64, (low, high): (f64, f64)| x > low && x < high;
        let lit: Vec<&Measured> = w.iter().filter(lit).collect();
        let mut levels = Vec::with_capacity(lit.len());
        let mut level = 0_i32;
        let mut before: Option<f64> = None;
        for w in &lit {
            if w.value <= 0.0 {
                return None;
            }
            let by = before.map_or(1.0, |before| w.value / before);
            level += match by {
                by if within(by, SAME) => 0,
                by if within(by, TWICE) => 1,
                by if within(1.0 / by, TWICE) => -1,
                _ => return None,
            };
            levels.push(level);
            before = Some(w.value);
        }
        let (low, high) = (levels.iter().min(), levels.iter().max());
        let (low, high) = (low.copied().unwrap_or(0), high.copied().unwrap_or(0));
        let once = match (high - low, self.sample, lit.as_slice()) {
            (1, ..) | (0, None, _) | (0, Some(_), []) => low,
            // All alike: neighbours fall by what one sample lets through, or by what two do.
            (0, Some(sample), [near, .., far]) => {
                let steps = (lit.len() - 1) as f64;
                let fall = (far.value / near.value).powf(1.0 / steps);
                let passes = sample.passes.value;
                let is_twice = (fall - passes * passes).abs() < (fall - passes).abs();
                if is_twice { low - 1 } else { low }
            }
            (0, Some(sample), [only]) => match only.value / sample.weight.value {
                by if within(by, SAME) => low,
                by if within(by, TWICE) => low - 1,
                _ => return None,
            },
            _ => return None,
        };
        let mut levels = levels.into_iter();
        let of = |w: &Measured| {
            let is_lit = w.value.abs() > NONE * top + 3.0 * w.error;
            let level = if is_lit { levels.next() } else { None };
            level.map_or(0, |level| usize::from(level > once) + 1)
        };
        Some(w.iter().map(of).collect())
    }

    /// Whether some sample of n is not taken once.
    pub(super) fn is_seen(&self, n: usize) -> bool {
        self.places().iter().all(|place| {
            let mut all = self.counted(*place).into_iter();
            all.any(|counted| counted.segments() == n && !counted.is_plain())
        })
    }

    /// Whether some sample of some ray is not taken once.
    pub(super) fn has_seams(&self) -> bool {
        self.seen.iter().any(|(n, _)| self.is_seen(*n))
    }

    /// Where samples may lie.
    pub(super) fn places(&self) -> Vec<Place> {
        if self.is_middle {
            return vec![Place::Middle];
        }
        let ends = |times: &[usize]| {
            let lit = |times: Option<&usize>| times.is_some_and(|times| *times > 0);
            (lit(times.first()), lit(times.last()))
        };
        let all: Vec<(bool, bool)> = self.seen.iter().map(|(_, times)| ends(times)).collect();
        let mut places = Vec::new();
        if all.iter().all(|(_, at_back)| !at_back) {
            places.push(Place::Front);
        }
        if all.iter().all(|(at_front, _)| !at_front) {
            places.push(Place::Back);
        }
        places
    }

    /// All rays, as of samples that lie there.
    pub(super) fn counted(&self, place: Place) -> Vec<Counted> {
        let of = |(n, times): &(usize, Vec<usize>)| Counted {
            times: match place {
                Place::Middle | Place::Front => times.iter().take(*n).copied().collect(),
                Place::Back => times.iter().skip(1).copied().collect(),
            },
        };
        self.seen.iter().map(of).collect()
    }
}

/// What samples weigh, by the first and the last that are taken as often.
fn sample(w: &[Measured], times: &[usize]) -> Option<Sample> {
    let near = times.iter().position(|times| *times == 1)?;
    let far = times.iter().rposition(|times| *times == 1)?;
    let between: usize = times.get(near..far)?.iter().sum();
    let in_front: usize = times.get(..near)?.iter().sum();
    if between < 4 {
        return None;
    }
    let part = |k: usize| w[k].error / w[k].value.abs();
    let passes = (w[far].value / w[near].value).powf(1.0 / between as f64);
    let of_passes = (part(near) + part(far)) / between as f64;
    let front = passes.powf(in_front as f64);
    let weight = w[near].value / front;
    Some(Sample {
        weight: Measured {
            value: weight,
            error: weight * (part(near) + in_front as f64 * of_passes),
        },
        passes: Measured {
            value: passes,
            error: passes * of_passes,
        },
    })
}

/// Whether weights are those of samples that are taken so often, one after the other, but for a factor of the ray.
fn follows(sample: &Sample, w: &[Measured], times: &[usize], relative: f64) -> bool {
    let passes = sample.passes;
    let copies = |times: usize| match times {
        0 => 0.0,
        1 => 1.0,
        _ => 1.0 + passes.value,
    };
    let mut taken = 0_usize;
    let mut first: Option<Measured> = None;
    for (w, times) in w.iter().zip(times) {
        let seen = passes.value.powf(taken as f64) * copies(*times);
        if *times > 0 {
            let own = Measured {
                value: w.value / seen,
                error: w.error / seen,
            };
            let first = *first.get_or_insert(own);
            let part = passes.error * (taken + 1) as f64;
            let allowed =
                3.0 * (own.error + first.error) + own.value.abs() * (3.0 * part + 8.0 * relative);
            if (own.value - first.value).abs() > allowed {
                return false;
            }
        }
        taken += times;
    }
    true
}
