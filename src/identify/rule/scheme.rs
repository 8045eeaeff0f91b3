//! What a segment's weights are made of.

use super::{Law, LinearSegments, Node};
use crate::case::Transfer;
use crate::real::special::linear_in_depth;
use crate::real::{Format, Real};
use rug::Rational;
use serde::{Deserialize, Serialize};

/// Where in its segment a sample lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Place {
    /// At the end nearer to the eye.
    Front,
    /// In the middle.
    #[default]
    Middle,
    /// At the end farther from the eye.
    Back,
}

/// How segments are weighed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// By one sample each.
    Sample {
        /// Where it lies.
        place: Place,
        /// What it does.
        law: Law,
    },
    /// By several values each.
    Segments {
        /// Part of d·τ in front, in the middle and at the back that make a segment's depth.
        #[serde(with = "super::json::ratios")]
        depth: [Rational; 3],
        /// What the emissions are multiplied by.
        weights: Segment,
        /// And by this.
        scale: super::Scale,
    },
}

impl Scheme {
    /// The points that its segments take; `None` where they take none.
    pub(super) fn linear<F: Format>(&self, format: F) -> Option<LinearSegments<F::Real>> {
        match self {
            Scheme::Sample { .. } => None,
            Scheme::Segments { weights, .. } => weights.linear(format),
        }
    }

    /// What all weights are multiplied by.
    #[must_use]
    pub fn scale(&self) -> f64 {
        match self {
            Scheme::Sample { law, .. } => law.scale.0,
            Scheme::Segments { scale, .. } => scale.0,
        }
    }
}

impl Default for Scheme {
    fn default() -> Self {
        Scheme::Sample {
            place: Place::Middle,
            law: Law::default(),
        }
    }
}

/// The weights of a segment with extinctions f, m, b in front, in the middle and at the back, depth x.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Segment {
    /// (1 − e^(−x)) times parts of the three emissions.
    Opacity {
        /// The parts.
        #[serde(with = "super::json::ratios")]
        parts: [Rational; 3],
    },
    /// Source linear in optical depth: 1 − e in front and e − e^(−x) at the back, e = (1 − e^(−x))/x.
    LinearInDepth {
        /// The two weights have changed places.
        swapped: bool,
    },
    /// C and τ linear along the segment, integrated exactly.
    Linear,
    /// d f cf, d m cm e^(−y), d b cb e^(−x), y the depth to the middle: trapezoids and Simpson's rule.
    Quadrature {
        /// (cf, cm, cb).
        #[serde(with = "super::json::ratios")]
        parts: [Rational; 3],
        /// Parts of d·τ that make the depth to the middle.
        #[serde(with = "super::json::ratios")]
        half: [Rational; 3],
    },
    /// d f cf, d m cm, d b cb: absorption inside the segment is neglected.
    Sum {
        /// (cf, cm, cb).
        #[serde(with = "super::json::ratios")]
        parts: [Rational; 3],
    },
    /// Two halves with the extinctions in front and at the back.
    Halves,
}

/// The three extinctions of a segment and its length.
#[derive(Clone, Debug)]
pub(crate) struct Three<R> {
    pub(crate) extinction: [R; 3],
    pub(crate) length: R,
}

impl<R: Real> Three<R> {
    /// d (c₀ f + c₁ m + c₂ b).
    pub(crate) fn depth(&self, parts: &[Rational; 3]) -> R {
        let format = self.length.format();
        let mut sum = format.int(0);
        for (part, extinction) in parts.iter().zip(&self.extinction) {
            if !part.is_zero() {
                sum += &(extinction.clone() * &format.ratio(part));
            }
        }
        sum * &self.length
    }
}

impl Segment {
    /// The points that it takes; `None` where it takes none.
    pub(crate) fn linear<F: Format>(&self, format: F) -> Option<LinearSegments<F::Real>> {
        (*self == Segment::Linear).then(|| LinearSegments::new(format))
    }

    /// The weights in front, in the middle and at the back of a segment of depth x, by the points of
    /// [`Segment::linear`].
    pub(crate) fn of<R: Real>(
        &self,
        three: &Three<R>,
        x: &R,
        linear: Option<&LinearSegments<R>>,
    ) -> [R; 3] {
        let format = x.format();
        let zero = || format.int(0);
        let [front, middle, back] = &three.extinction;
        match self {
            Segment::Opacity { parts } => {
                let opacity = -(-x.clone()).exp_m1();
                parts
                    .each_ref()
                    .map(|part| opacity.clone() * &format.ratio(part))
            }
            Segment::LinearInDepth { swapped } => {
                let [near, far] = linear_in_depth(x);
                if *swapped {
                    [far, zero(), near]
                } else {
                    [near, zero(), far]
                }
            }
            Segment::Linear => {
                let lit = |near: i64, far: i64| {
                    let end = |extinction: &R, emission: i64| Transfer {
                        extinction: extinction.clone(),
                        emission: format.int(emission),
                    };
                    let (near, far) = (end(front, near), end(back, far));
                    linear.map_or_else(zero, |rule| rule.segment(&near, &far, &three.length).0)
                };
                [lit(1, 0), zero(), lit(0, 1)]
            }
            Segment::Quadrature { parts, half } => {
                let light = |part: &Rational, extinction: &R, depth: R| {
                    if part.is_zero() {
                        return zero();
                    }
                    (-depth).exp() * extinction * &three.length * &format.ratio(part)
                };
                [
                    light(&parts[0], front, zero()),
                    light(&parts[1], middle, three.depth(half)),
                    light(&parts[2], back, x.clone()),
                ]
            }
            Segment::Sum { parts } => {
                let light = |part: &Rational, extinction: &R| {
                    extinction.clone() * &three.length * &format.ratio(part)
                };
                [
                    light(&parts[0], front),
                    light(&parts[1], middle),
                    light(&parts[2], back),
                ]
            }
            Segment::Halves => {
                let half = format.fraction(1, 2);
                let through = |extinction: &R| -(extinction.clone() * &three.length * &half);
                let near = through(front);
                let far = -through(back).exp_m1() * &near.clone().exp();
                [-near.exp_m1(), zero(), far]
            }
        }
    }
}

impl Place {
    /// The node of the sample of that index.
    #[must_use]
    pub fn node(self, index: isize) -> Option<Node> {
        match self {
            Place::Front => usize::try_from(index).ok().map(Node::Edge),
            Place::Middle => usize::try_from(index).ok().map(Node::Middle),
            Place::Back => usize::try_from(index + 1).ok().map(Node::Edge),
        }
    }
}
