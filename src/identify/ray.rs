//! Rays that ask.

use super::rule::Node;
use crate::kernel::{Data, Samples, Segments, Task};
use rug::Rational;

/// The extinctions of a ray cut into segments.
#[derive(Clone, Debug)]
pub(super) struct Layers {
    /// d.
    pub(super) step: f64,
    /// The length of the last segment as a part of the others.
    pub(super) last: f64,
    /// τ at the n + 1 ends.
    pub(super) edges: Vec<f64>,
    /// τ in the n middles.
    pub(super) middles: Vec<f64>,
}

/// C at the n + 1 ends and in the n middles.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Emission {
    pub(super) edges: Vec<f64>,
    pub(super) middles: Vec<f64>,
}

impl Emission {
    /// The same everywhere.
    pub(super) fn even(n: usize, c: f64) -> Self {
        Emission {
            edges: vec![c; n + 1],
            middles: vec![c; n],
        }
    }

    /// C there.
    pub(super) fn at(&self, node: Node) -> f64 {
        match node {
            Node::Edge(i) => self.edges[i],
            Node::Middle(i) => self.middles[i],
        }
    }

    /// The same, to be changed.
    pub(super) fn at_mut(&mut self, node: Node) -> &mut f64 {
        match node {
            Node::Edge(i) => &mut self.edges[i],
            Node::Middle(i) => &mut self.middles[i],
        }
    }

    /// Of what `of` gives at the place in segments.
    pub(super) fn of(n: usize, mut of: impl FnMut(f64) -> f64) -> Self {
        Emission {
            edges: (0..=n).map(|i| of(i as f64)).collect(),
            middles: (0..n).map(|i| of(i as f64 + 0.5)).collect(),
        }
    }
}

impl Layers {
    /// τ of every segment, everywhere in it; an end belongs to the segment behind it.
    pub(super) fn of(step: f64, extinctions: &[f64]) -> Self {
        let mut edges = extinctions.to_vec();
        edges.extend(extinctions.last().copied());
        Layers {
            step,
            last: 1.0,
            edges,
            middles: extinctions.to_vec(),
        }
    }

    /// n.
    pub(super) fn count(&self) -> usize {
        self.middles.len()
    }

    /// The ends of segments.
    fn lambda(&self) -> Vec<f64> {
        let n = self.count();
        let mut lambda: Vec<f64> = (0..n).map(|i| i as f64 * self.step).collect();
        let whole = if self.last < 1.0 {
            (n as f64 - 1.0 + self.last) * self.step
        } else {
            n as f64 * self.step
        };
        lambda.push(whole);
        lambda
    }

    /// A ray through this medium with those channels.
    pub(super) fn ray(&self, name: String, emission: &[Emission]) -> Ray {
        let lambda = self.lambda();
        let middles = lambda
            .windows(2)
            .map(|ends| f64::midpoint(ends[0], ends[1]));
        let middles: Vec<f64> = middles.collect();
        let length = lambda.last().copied().unwrap_or(1.0);
        Ray {
            name,
            channels: (0..emission.len()).map(|k| format!("c{k}")).collect(),
            length: Rational::from_f64(length).unwrap_or_default(),
            step: self.step,
            seed: 0,
            segments: Segments {
                edges: Samples {
                    lambda,
                    extinction: self.edges.clone(),
                    emission: emission.iter().map(|e| e.edges.clone()).collect(),
                },
                middles: Samples {
                    lambda: middles,
                    extinction: self.middles.clone(),
                    emission: emission.iter().map(|e| e.middles.clone()).collect(),
                },
            },
        }
    }
}

/// A ray with channels, made up to ask: C and τ linear between the ends and middles of segments, and constant in
/// the nearest neighbourhood of each.
#[derive(Clone, Debug)]
pub struct Ray {
    pub(super) name: String,
    pub(super) channels: Vec<String>,
    pub(super) length: Rational,
    pub(super) step: f64,
    pub(super) seed: u64,
    /// What the kernel is given.
    pub segments: Segments,
}

impl Ray {
    /// d.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.step
    }

    /// The task that asks for it.
    #[must_use]
    pub fn task(&self) -> Task<'_> {
        Task {
            subject: self,
            step: self.step,
            segments: self.segments.count() as u64,
            seed: self.seed,
            data: Data::Segments(&self.segments),
        }
    }

    /// The same ray with the channels of that range alone.
    pub(super) fn part(&self, range: std::ops::Range<usize>) -> Ray {
        let cut = |samples: &Samples| Samples {
            emission: samples.emission[range.clone()].to_vec(),
            ..samples.clone()
        };
        Ray {
            channels: self.channels[range.clone()].to_vec(),
            segments: Segments {
                edges: cut(&self.segments.edges),
                middles: cut(&self.segments.middles),
            },
            ..self.clone()
        }
    }
}
