//! A ray in whose stead a longer one is put, so that its samples are those that are taken once.

use crate::identify::ray::Ray;
use crate::identify::rule::{Place, Seam};
use crate::identify::silence::Silence;
use crate::kernel::Samples;
use rug::Rational;

/// Where a kernel takes some samples twice and others never.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::identify) struct Spread {
    pub(in crate::identify) seam: Seam,
    pub(in crate::identify) place: Place,
    /// Numbers of segments are multiples of this.
    pub(in crate::identify) multiple: usize,
}

/// How many times as long a ray may get, and by how many segments more.
const LONGEST: (usize, usize) = (300, 1_000);
/// So many segments more may make the last one a sample that is taken once.
const FOR_THE_LAST: usize = 8;

impl Spread {
    /// The segments of the longer ray that stand for the n of a ray, and how many there are.
    fn taken(&self, wanted: usize) -> Option<(Vec<usize>, usize)> {
        let once = |n: usize| (0..n).filter(move |i| self.seam.times(*i, n) == 1);
        let (times, more) = LONGEST;
        let mut n = wanted.next_multiple_of(self.multiple);
        loop {
            let missing = wanted.saturating_sub(once(n).count());
            if missing == 0 {
                break;
            }
            if n > times * wanted + more {
                return None;
            }
            n = (n + missing).next_multiple_of(self.multiple);
        }
        let suits = |n: &usize| self.seam.times(n - 1, *n) == 1 && once(*n).count() >= wanted;
        let longer = (0..FOR_THE_LAST).map(|k| n + k * self.multiple);
        let n = longer.into_iter().find(suits).unwrap_or(n);
        let all: Vec<usize> = once(n).collect();
        let (last, rest) = all.split_last()?;
        let mut taken: Vec<usize> = rest.iter().copied().take(wanted - 1).collect();
        taken.push(*last);
        Some((taken, n))
    }

    /// The longer ray: what is taken twice, or once too often, holds nothing.
    pub(super) fn of(&self, ray: &Ray) -> Result<Ray, Silence> {
        let wanted = ray.segments.count();
        let (taken, n) = self
            .taken(wanted)
            .ok_or(Silence::TooMany { segments: wanted })?;
        let given = &ray.segments;
        let mut lambda: Vec<f64> = (0..n).map(|i| i as f64 * ray.step).collect();
        let last = given.lengths().last().unwrap_or(ray.step);
        let is_whole = last >= ray.step * (1.0 - 1e-9);
        lambda.push(if is_whole {
            n as f64 * ray.step
        } else {
            (n as f64 - 1.0) * ray.step + last
        });
        let middles: Vec<f64> = lambda
            .windows(2)
            .map(|ends| f64::midpoint(ends[0], ends[1]))
            .collect();
        let is_middle = self.place == Place::Middle;
        let at_edges = self.sources(&taken, n, true);
        let at_middles = self.sources(&taken, n, false);
        let mut longer = ray.clone();
        longer.length =
            Rational::from_f64(lambda.last().copied().unwrap_or(0.0)).unwrap_or_default();
        longer.segments.edges = self.samples(&given.edges, lambda, &at_edges, !is_middle);
        longer.segments.middles = self.samples(&given.middles, middles, &at_middles, is_middle);
        Ok(longer)
    }

    /// How far behind its segment's own node a sample lies.
    fn shift(&self) -> usize {
        usize::from(self.place == Place::Back)
    }

    /// The node of the ray that stands at each of the longer one, where one does.
    fn sources(&self, taken: &[usize], n: usize, is_edges: bool) -> Vec<Option<usize>> {
        let shift = if is_edges { self.shift() } else { 0 };
        let mut all = vec![None; n + usize::from(is_edges)];
        for (k, i) in taken.iter().enumerate() {
            all[i + shift] = Some(k + shift);
        }
        // The end that is no segment's own.
        if is_edges && shift == 1 {
            all[0] = Some(0);
        } else if is_edges {
            all[n] = Some(taken.len());
        }
        all
    }

    /// Values at the nodes of the longer ray. Where nothing is sampled, or a sample is left out, there is the extinction
    /// of the node in front.
    fn samples(
        &self,
        given: &Samples,
        lambda: Vec<f64>,
        sources: &[Option<usize>],
        has_samples: bool,
    ) -> Samples {
        let shift = if has_samples { self.shift() } else { 0 };
        let n = lambda
            .len()
            .saturating_sub(usize::from(self.place != Place::Middle));
        let is_hidden = |at: usize| {
            let i = at.checked_sub(shift).filter(|_| has_samples);
            i.is_some_and(|i| self.seam.times(i, n) > 0)
        };
        let mut before = given.extinction.first().copied().unwrap_or(0.0);
        let mut extinction = Vec::with_capacity(sources.len());
        for (at, source) in sources.iter().enumerate() {
            extinction.push(match source {
                Some(source) => {
                    before = given.extinction[*source];
                    before
                }
                None if is_hidden(at) => 0.0,
                None => before,
            });
        }
        let of = |values: &Vec<f64>| {
            let own = |source: &Option<usize>| source.map_or(0.0, |source| values[source]);
            sources.iter().map(own).collect()
        };
        Samples {
            extinction,
            emission: given.emission.iter().map(of).collect(),
            lambda,
        }
    }
}
