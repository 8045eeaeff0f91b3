//! A rule as curves: what samples weigh along a ray, how much light reaches them, and what segments absorb.

use super::ray::{Emission, Layers, Ray};
use super::rule::{Composed, Node, Rule, Scheme, StopBy, Whole};
use crate::real::{Format, Native};

/// The step of rays, whose extinction is 1.
const STEP: f64 = 0.25;
/// Their depths.
const SHALLOW: f64 = 3.0;
const DEEP: f64 = 24.0;
/// A ray that ends early is so much deeper than where it does.
const DEEPER: f64 = 1.25;
/// Depths, evenly by their logarithms.
const DEPTHS: usize = 49;
/// Differences of opacities that rounding makes.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// A ray of that depth that absorbs evenly.
fn even_ray(depth: f64) -> Ray {
    // Not negative, and clamped.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let count = (depth.clamp(STEP, DEEP) / STEP).ceil() as usize;
    let layers = Layers::of(STEP, &vec![1.0; count]);
    layers.ray("even".into(), &[Emission::even(count, 1.0)])
}

impl Rule {
    /// The depth of an even ray that shows what the rule does: 3, or deep enough to end.
    #[must_use]
    pub fn telling_depth(&self) -> f64 {
        match self.stop {
            Some(stop) if stop.by == StopBy::Transmittance => {
                (-stop.under.ln() * DEEPER).clamp(SHALLOW, DEEP)
            }
            _ => SHALLOW,
        }
    }

    fn along(&self, ray: &Ray) -> Composed<f64> {
        let composed = self.composed(&ray.segments, STEP, Native::<f64>::new());
        let terms = composed.terms.into_iter();
        Composed {
            terms: terms.map(|(node, w)| (node, w * composed.factor)).collect(),
            passes: composed.passes,
            factor: composed.factor,
        }
    }

    /// (λ, w): what the values at the nodes of a ray of that depth weigh that absorbs evenly, in segments of depth ¼.
    #[must_use]
    pub fn weights_along(&self, depth: f64) -> Vec<(f64, f64)> {
        let ray = even_ray(depth);
        let at = |node: Node| match node {
            Node::Edge(i) => ray.segments.edges.lambda.get(i),
            Node::Middle(i) => ray.segments.middles.lambda.get(i),
        };
        let mut points: Vec<(f64, f64)> = Vec::new();
        let mut terms = self.along(&ray).terms;
        if let Scheme::Sample { place, .. } = &self.scheme {
            // Behind the end of a ray samples weigh nothing.
            let all = (0..ray.segments.count()).filter_map(|i| isize::try_from(i).ok());
            terms.extend(all.filter_map(|i| Some((place.node(i)?, 0.0))));
        }
        for (node, weight) in &terms {
            let Some(lambda) = at(*node) else { continue };
            // A node between two segments has a weight of each.
            match points
                .iter_mut()
                .find(|(at, _)| (*at - lambda).abs() <= 0.0)
            {
                Some((_, sum)) => *sum += weight,
                None => points.push((*lambda, *weight)),
            }
        }
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        points
    }

    /// (λ, T): how much of the light of each sample reaches the eye on the same ray, by its weight in that of a lone
    /// segment; none of rules with several values a segment, or with a factor of the whole ray.
    #[must_use]
    pub fn transmittances_along(&self, depth: f64) -> Vec<(f64, f64)> {
        let Scheme::Sample { law, .. } = &self.scheme else {
            return Vec::new();
        };
        let ray = even_ray(depth);
        let length = STEP * ray.segments.count() as f64;
        let (lone, _) = law.of(&1.0, &STEP, &length);
        if self.whole != Whole::One || lone.abs() <= 0.0 {
            return Vec::new();
        }
        let weights = self.weights_along(depth).into_iter();
        weights.map(|(at, weight)| (at, weight / lone)).collect()
    }

    /// λ of the last sample of that ray that counts, where the ray ends early.
    #[must_use]
    pub fn ends_at(&self, depth: f64) -> Option<f64> {
        self.stop?;
        let points = self.weights_along(depth);
        let last = points.iter().rev().find(|(_, w)| w.abs() > 0.0)?;
        Some(last.0)
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
            let (opacity, right) = (one - passes, -(-x).exp_m1());
            let is_same = (opacity - right).abs() <= ROUNDING;
            [x, if is_same { right } else { opacity }, right]
        };
        (0..DEPTHS).map(of).collect()
    }
}
