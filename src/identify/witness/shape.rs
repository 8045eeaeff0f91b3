//! A ray as it is made smaller.

use super::super::part::short;
use super::super::ray::{Emission, Layers, Ray};

/// A ray by its segments.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Shape {
    /// d.
    pub(super) step: f64,
    /// The length of the last segment as a part of the others.
    pub(super) last: f64,
    /// τ.
    pub(super) extinction: Emission,
    /// C, by channel.
    pub(super) emission: Vec<Emission>,
}

impl Shape {
    pub(super) fn of(ray: &Ray) -> Self {
        let segments = &ray.segments;
        let last = segments.lengths().last().unwrap_or(ray.step) / ray.step;
        let both = segments.edges.emission.iter();
        let both = both.zip(&segments.middles.emission);
        Shape {
            step: ray.step,
            last: if last < 1.0 - 1e-9 { last } else { 1.0 },
            extinction: Emission {
                edges: segments.edges.extinction.clone(),
                middles: segments.middles.extinction.clone(),
            },
            emission: both
                .map(|(edges, middles)| Emission {
                    edges: edges.clone(),
                    middles: middles.clone(),
                })
                .collect(),
        }
    }

    /// n.
    pub(super) fn count(&self) -> usize {
        self.extinction.middles.len()
    }

    pub(super) fn ray(&self) -> Ray {
        let layers = Layers {
            step: self.step,
            last: self.last,
            edges: self.extinction.edges.clone(),
            middles: self.extinction.middles.clone(),
        };
        layers.ray("witness".into(), &self.emission)
    }

    /// Without the segments from `start` to `end`; `None` where none is left.
    pub(super) fn without(&self, start: usize, end: usize) -> Option<Self> {
        let end = end.min(self.count());
        if end - start.min(end) == self.count() {
            return None;
        }
        let cut = |values: &Emission| {
            let mut values = values.clone();
            values.edges.drain(start..end);
            values.middles.drain(start..end);
            values
        };
        Some(Shape {
            extinction: cut(&self.extinction),
            emission: self.emission.iter().map(cut).collect(),
            ..self.clone()
        })
    }

    /// With one channel alone.
    pub(super) fn only(&self, channel: usize) -> Option<Self> {
        let one = self.emission.get(channel)?.clone();
        Some(Shape {
            emission: vec![one],
            ..self.clone()
        })
    }

    /// Without a channel.
    pub(super) fn without_channel(&self, channel: usize) -> Self {
        let mut shape = self.clone();
        shape.emission.remove(channel);
        shape
    }
}

/// So often at most a number is written again.
const LISTED: usize = 4;

/// One number a segment where all of a segment has one, ends and middles otherwise.
pub(super) fn per_segment(edges: &[f64], middles: &[f64]) -> String {
    let listed = |values: &[f64]| {
        let runs = values.chunk_by(|a, b| (a - b).abs() <= 0.0);
        let runs: Vec<String> = runs.map(run).collect();
        runs.join(" ")
    };
    let n = middles.len();
    let behind = edges.get(..n) == Some(middles) && edges.last() == middles.last();
    let before = edges.get(1..) == Some(middles) && edges.first() == middles.first();
    if behind || before {
        listed(middles)
    } else {
        format!(
            "{} at ends and {} in middles",
            listed(edges),
            listed(middles)
        )
    }
}

/// The same number several times.
fn run(values: &[f64]) -> String {
    let one = short(values.first().copied().unwrap_or(0.0));
    if values.len() > LISTED {
        format!("{one}×{}", values.len())
    } else {
        vec![one; values.len()].join(" ")
    }
}
