//! C and τ as functions of λ: linear between knots, and constant before the first and behind the last.

use crate::identify::ray::Ray;
use crate::kernel::{Medium, Samples};
use rug::Rational;

/// Half the width around a node in which values do not change, in halves of a segment: whoever computes λ with rounding
/// errors, also in binary32, sees the node's value.
const PLATEAU: f64 = 1.0 / 1024.0;

/// τ(λ), and into `emission` C(λ) of every channel.
pub(in crate::identify) fn at(knots: &Samples, lambda: f64, emission: &mut [f64]) -> f64 {
    let after = knots.lambda.partition_point(|knot| *knot <= lambda);
    let of = |values: &[f64]| between(&knots.lambda, values, after, lambda);
    for (values, emission) in knots.emission.iter().zip(emission) {
        *emission = of(values);
    }
    of(&knots.extinction)
}

fn between(lambda: &[f64], values: &[f64], after: usize, at: f64) -> f64 {
    let near = after.checked_sub(1).and_then(|near| values.get(near));
    match (near, values.get(after)) {
        (Some(near), Some(far)) => {
            let (from, to) = (lambda[after - 1], lambda[after]);
            near + (far - near) * ((at - from) / (to - from))
        }
        (Some(value), None) | (None, Some(value)) => *value,
        (None, None) => f64::NAN,
    }
}

/// Values at places in ascending order, each the same within `half` of its place.
pub(super) fn around(at: &Samples, half: f64) -> Samples {
    let twice = |values: &Vec<f64>| values.iter().flat_map(|v| [*v, *v]).collect();
    Samples {
        lambda: at
            .lambda
            .iter()
            .flat_map(|x| [x - half, x + half])
            .collect(),
        extinction: twice(&at.extinction),
        emission: at.emission.iter().map(twice).collect(),
    }
}

/// The medium of a ray: linear between the ends and middles of segments, but for a plateau around each.
pub(in crate::identify) fn plain(ray: &Ray) -> Samples {
    let (edges, middles) = (&ray.segments.edges, &ray.segments.middles);
    let shortest = ray.segments.lengths().fold(f64::INFINITY, f64::min);
    let both = |ends: &Vec<f64>, inner: &Vec<f64>| -> Vec<f64> {
        let pairs = ends
            .iter()
            .zip(inner)
            .flat_map(|(end, inner)| [*end, *inner]);
        pairs.chain(ends.last().copied()).collect()
    };
    let emission = edges.emission.iter().zip(&middles.emission);
    let nodes = Samples {
        lambda: both(&edges.lambda, &middles.lambda),
        extinction: both(&edges.extinction, &middles.extinction),
        emission: emission.map(|(e, m)| both(e, m)).collect(),
    };
    around(&nodes, PLATEAU * shortest / 2.0)
}

/// One extinction everywhere; a dark channel, then hats of emission around each of `count` places from 0 to D.
pub(in crate::identify) fn hats(
    length: f64,
    count: usize,
    extinction: f64,
    bright: f64,
) -> Samples {
    let last = count.saturating_sub(1).max(1) as f64;
    let lit = |k: usize| {
        (0..count)
            .map(|i| if i == k { bright } else { 0.0 })
            .collect()
    };
    Samples {
        lambda: (0..count).map(|i| length * (i as f64 / last)).collect(),
        extinction: vec![extinction; count],
        emission: std::iter::once(vec![0.0; count])
            .chain((0..count).map(lit))
            .collect(),
    }
}

/// A ray of segments is one of functions, too.
impl Medium for Ray {
    fn name(&self) -> &str {
        &self.name
    }

    fn channels(&self) -> &[String] {
        &self.channels
    }

    fn length(&self) -> &Rational {
        &self.length
    }

    fn at(&self, lambda: f64, emission: &mut [f64]) -> f64 {
        at(&plain(self), lambda, emission)
    }
}
