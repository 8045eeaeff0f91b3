//! Rays through values that are one vector each.

use crate::kernel::{Data, Declaration, GradientAt, Medium, Samples, Segments, Task};
use crate::study::gradient::Places;
use rug::Rational;

/// Numbers of segments, steps, the last segment as a part of the others, and whether faults are held out on the ray. Steps
/// and parts have few bits: lengths are then exact, of whatever format the projector is.
const MADE: [(usize, f64, f64, bool); 5] = [
    (6, 0.5, 1.0, false),
    (9, 0.34375, 0.3125, false),
    (5, 1.25, 0.6875, false),
    (8, 0.8125, 0.4375, true),
    (7, 0.15625, 1.0, true),
];

/// A ray of the projector.
#[derive(Clone, Debug)]
pub(super) struct Projected {
    /// Without any values.
    pub(super) plain: Segments,
    step: f64,
    /// The length that each value stands for; 0 where it is not used.
    pub(super) lengths: Vec<f64>,
    /// The same, had all segments the length of the first.
    pub(super) even: Vec<f64>,
    pub(super) seed: u64,
    pub(super) held_out: bool,
}

/// A ray with values.
#[derive(Debug)]
pub(super) struct Made {
    name: String,
    channels: Vec<String>,
    length: Rational,
    step: f64,
    segments: Segments,
}

/// The rays, as the kernel takes them.
pub(super) fn rays(declaration: &Declaration, places: Places) -> Vec<Projected> {
    let multiple = usize::try_from(declaration.multiple_of.get()).unwrap_or(usize::MAX);
    let one = |(seed, (n, step, last, held_out)): (usize, (usize, f64, f64, bool))| {
        let n = n.checked_next_multiple_of(multiple).unwrap_or(n);
        let last = if declaration.step_divides { 1.0 } else { last };
        let plain = segments(n, step, last);
        let lengths = |segments: &Segments| -> Vec<f64> {
            let lengths = places.lengths(segments).into_iter();
            lengths.map(|length| length.unwrap_or(0.0)).collect()
        };
        Projected {
            lengths: lengths(&plain),
            even: lengths(&segments(n, step, 1.0)),
            plain,
            step,
            seed: seed as u64 + 1,
            held_out,
        }
    };
    MADE.into_iter().enumerate().map(one).collect()
}

fn segments(n: usize, step: f64, last: f64) -> Segments {
    let mut edges: Vec<f64> = (0..n).map(|i| i as f64 * step).collect();
    edges.push((n as f64 - 1.0 + last) * step);
    let middles = edges.windows(2).map(|ends| f64::midpoint(ends[0], ends[1]));
    let samples = |lambda: Vec<f64>| Samples {
        extinction: vec![0.0; lambda.len()],
        emission: vec![vec![0.0; lambda.len()]],
        lambda,
    };
    Segments {
        middles: samples(middles.collect()),
        edges: samples(edges),
    }
}

impl Projected {
    /// n.
    pub(super) fn segments(&self) -> usize {
        self.plain.count()
    }

    /// With these values at those places, and 0 at the others.
    pub(super) fn with(&self, at: GradientAt, x: &[f64]) -> Made {
        let mut segments = self.plain.clone();
        let samples = match at {
            GradientAt::Middles => &mut segments.middles,
            GradientAt::Edges => &mut segments.edges,
        };
        samples.extinction = x.to_vec();
        let length = segments.edges.lambda.last().copied();
        Made {
            name: format!("projected-{}", self.seed),
            channels: vec!["none".into()],
            length: length.and_then(Rational::from_f64).unwrap_or_default(),
            step: self.step,
            segments,
        }
    }
}

impl Made {
    pub(super) fn task(&self) -> Task<'_> {
        Task {
            subject: self,
            step: self.step,
            segments: self.segments.count() as u64,
            seed: 0,
            data: Data::Segments(&self.segments),
        }
    }
}

impl Medium for Made {
    fn name(&self) -> &str {
        &self.name
    }

    fn channels(&self) -> &[String] {
        &self.channels
    }

    fn length(&self) -> &Rational {
        &self.length
    }

    /// The value nearest to λ: kernels with an adjoint are given segments, and do not ask.
    fn at(&self, lambda: f64, emission: &mut [f64]) -> f64 {
        emission.fill(0.0);
        let middles = &self.segments.middles;
        let edges = &self.segments.edges.lambda;
        let at = edges.partition_point(|edge| *edge <= lambda).max(1) - 1;
        middles.extinction.get(at).copied().unwrap_or(0.0)
    }
}
