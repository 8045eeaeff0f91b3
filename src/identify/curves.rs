//! A rule as curves: what samples weigh along a ray, and what segments absorb.

use super::ray::{Emission, Layers};
use super::rule::{Node, Rule, Scheme};
use crate::real::{Format, Native};

/// Segments of the ray, and its step: of depth 3 in all.
const SEGMENTS: usize = 12;
const STEP: f64 = 0.25;
/// Depths, evenly by their logarithms.
const DEPTHS: usize = 121;

impl Rule {
    /// (λ, w): what the values at the nodes of a ray weigh that absorbs evenly, its depth 3 and its segments 12.
    #[must_use]
    pub fn weights_along(&self) -> Vec<(f64, f64)> {
        let layers = Layers::of(STEP, &[1.0; SEGMENTS]);
        let ray = layers.ray("even".into(), &[Emission::even(SEGMENTS, 1.0)]);
        let composed = self.composed(&ray.segments, STEP, Native::<f64>::new());
        let at = |node: Node| match node {
            Node::Edge(i) => ray.segments.edges.lambda.get(i),
            Node::Middle(i) => ray.segments.middles.lambda.get(i),
        };
        let mut points: Vec<(f64, f64)> = Vec::new();
        for (node, weight) in &composed.terms {
            let Some(lambda) = at(*node) else { continue };
            let weight = *weight * composed.factor;
            // A node between two segments has a weight of each.
            match points
                .iter_mut()
                .find(|(at, _)| (*at - lambda).abs() <= 0.0)
            {
                Some((_, sum)) => *sum += weight,
                None => points.push((*lambda, weight)),
            }
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    }

    /// (τ d, α, 1 − e^(−τ d)) of segments of length 1 with one sample each, α their opacity 1 − p, from 1e-4 to 100.
    #[must_use]
    pub fn opacities(&self) -> Vec<[f64; 3]> {
        let Scheme::Sample { law, .. } = &self.scheme else {
            return Vec::new();
        };
        let format = Native::<f64>::new();
        let one = format.int(1);
        let of = |k: usize| {
            let x = 10_f64.powf(-4.0 + 6.0 * k as f64 / (DEPTHS - 1) as f64);
            let (_, passes) = law.of(&format.binary64(x), &one, &one);
            [x, (one - passes), -(-x).exp_m1()]
        };
        (0..DEPTHS).map(of).collect()
    }
}
