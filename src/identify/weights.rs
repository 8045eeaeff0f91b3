//! What every node of a ray weighs, by emission in one node alone.

use super::NotIdentified;
use super::ray::{Emission, Layers, Ray};
use super::rule::{Node, Output, Place};
use super::session::{Session, Silence};

/// A number, and how far it may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Measured {
    pub(super) value: f64,
    pub(super) error: f64,
}

/// The weights of nodes.
#[derive(Clone, Debug)]
pub(super) struct Weights {
    /// In the order in which nodes were asked.
    pub(super) of: Vec<Measured>,
    /// The answer without emission, before the output's map.
    pub(super) zero: Measured,
    /// The ray that was asked, the last of several.
    pub(super) ray: Ray,
    /// Answers to the channels asked beside, before the output's map.
    pub(super) beside: Vec<f64>,
}

impl Weights {
    pub(super) fn values(&self) -> Vec<f64> {
        self.of.iter().map(|w| w.value).collect()
    }
}

/// How answers are read: what is known of them before anything else.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Answers {
    /// From radiance to answer.
    pub(super) output: Output,
    /// The relative precision of what is computed.
    pub(super) unit: f64,
    /// By which answers to the same question differ, relatively.
    pub(super) noise: f64,
    /// The relative precision of what one segment lets through, where it is no better than this.
    pub(super) grain: f64,
    /// The largest emission that counts as it is.
    pub(super) emission_max: f64,
}

impl Default for Answers {
    fn default() -> Self {
        Answers {
            output: Output::default(),
            unit: f64::EPSILON / 2.0,
            noise: 0.0,
            grain: 0.0,
            emission_max: f64::INFINITY,
        }
    }
}

impl Answers {
    /// The radiance behind an answer.
    pub(super) fn radiance(&self, y: f64) -> Measured {
        let curve = self.output.curve;
        let grain = 2.0 * self.unit * y.abs() + self.noise * y.abs();
        let quantum = self.output.quantum.unwrap_or(0.0) / 2.0;
        let value = curve.inverse(y);
        let off = grain + quantum;
        let error = if off > 0.0 {
            let sides = [curve.inverse(y - off), curve.inverse(y + off)];
            sides.iter().map(|x| (x - value).abs()).fold(0.0, f64::max)
        } else {
            0.0
        };
        Measured { value, error }
    }

    /// A relative tolerance of weights on n segments.
    pub(super) fn relative(&self, n: usize) -> f64 {
        self.unit * (32.0 + 4.0 * n as f64) + 2.0 * self.noise
    }

    /// Whether answers are multiples of something coarse.
    pub(super) fn is_coarse(&self) -> bool {
        self.output.quantum.is_some()
    }
}

/// All nodes of n segments: ends, then middles.
pub(super) fn all_nodes(n: usize) -> Vec<Node> {
    let edges = (0..=n).map(Node::Edge);
    edges.chain((0..n).map(Node::Middle)).collect()
}

/// The nodes of one sample a segment.
pub(super) fn nodes_of(place: Place, n: usize, extra: bool) -> Vec<Node> {
    match place {
        Place::Middle => (0..n).map(Node::Middle).collect(),
        Place::Front => (0..n + usize::from(extra)).map(Node::Edge).collect(),
        Place::Back => (usize::from(!extra)..=n).map(Node::Edge).collect(),
    }
}

/// Emission of that size in one node.
pub(super) fn impulse(n: usize, node: Node, size: f64) -> Emission {
    let mut emission = Emission::even(n, 0.0);
    *emission.at_mut(node) = size;
    emission
}

/// Copies of each impulse, of sizes that differ by parts of a quantum, where answers are coarse.
const COPIES: usize = 8;
/// Times that sizes are changed until answers are large and none is cut off.
const TRIES: usize = 4;
/// How much of the room under a cut is used.
const ROOM: f64 = 0.8;

/// The weights of `nodes`; channels asked in the same request may stand `beside`.
pub(super) fn weights(
    session: &mut Session<'_>,
    answers: &Answers,
    layers: &Layers,
    nodes: &[Node],
    beside: &[Emission],
) -> Result<Weights, NotIdentified> {
    let high = answers.output.high.unwrap_or(f64::INFINITY);
    let coarse = answers.is_coarse();
    let largest = answers.emission_max.min(1e6);
    let start = if coarse || high.is_infinite() {
        1.0
    } else {
        high / 8.0
    };
    let mut sizes = vec![start.min(largest); nodes.len()];
    let tries = if coarse || high.is_finite() { TRIES } else { 1 };
    let mut found = None;
    for attempt in 1..=tries {
        let copies = if coarse && attempt == tries {
            COPIES
        } else {
            1
        };
        let round = measure(session, answers, layers, nodes, &sizes, copies, beside)?;
        let cut: Vec<bool> = round.largest.iter().map(|y| *y >= high).collect();
        if coarse {
            let top = high.min(1e6);
            let room = if high.is_finite() {
                ROOM * (top - round.weights.zero.value)
            } else {
                ROOM
            };
            for (k, size) in sizes.iter_mut().enumerate() {
                let weight = round.weights.of[k].value;
                let next = match (cut[k], weight > 0.0) {
                    (true, _) => *size / 8.0,
                    (false, true) => room / weight.max(1e-9),
                    (false, false) => *size * 32.0,
                };
                *size = next.clamp(1e-6, largest);
            }
            found = Some(round.weights);
        } else if cut.iter().any(|cut| *cut) {
            for (size, cut) in sizes.iter_mut().zip(&cut) {
                if *cut {
                    *size /= 32.0;
                }
            }
            found = Some(round.weights);
        } else {
            return Ok(round.weights);
        }
    }
    found.ok_or_else(|| NotIdentified::new("weights have no finite answers"))
}

struct Round {
    weights: Weights,
    /// The largest answer to an impulse in each node.
    largest: Vec<f64>,
}

fn measure(
    session: &mut Session<'_>,
    answers: &Answers,
    layers: &Layers,
    nodes: &[Node],
    sizes: &[f64],
    copies: usize,
    beside: &[Emission],
) -> Result<Round, NotIdentified> {
    let n = layers.count();
    let quantum = answers.output.quantum.unwrap_or(0.0);
    let size = |copy: usize, k: usize| {
        let part = copy as f64 * quantum / copies as f64 / ROOM;
        (sizes[k] * (1.0 + part)).min(answers.emission_max)
    };
    let mut emission = vec![Emission::even(n, 0.0)];
    for copy in 0..copies {
        let impulses = nodes.iter().enumerate();
        emission.extend(impulses.map(|(k, node)| impulse(n, *node, size(copy, k))));
    }
    emission.extend_from_slice(beside);
    let ray = session.ray(layers, &emission);
    let answered = session.ask(&ray)?;
    let read: Vec<Measured> = answered.iter().map(|y| answers.radiance(*y)).collect();
    let zero = read[0];
    let count = nodes.len();
    let mut of = Vec::with_capacity(count);
    let mut largest = Vec::with_capacity(count);
    for k in 0..count {
        let (mut value, mut error, mut top) = (0.0, 0.0, f64::NEG_INFINITY);
        for copy in 0..copies {
            let at = 1 + copy * count + k;
            let lit = read[at];
            value += (lit.value - zero.value) / size(copy, k);
            error += (lit.error + zero.error) / size(copy, k);
            top = top.max(answered[at]);
        }
        let copies = copies as f64;
        of.push(Measured {
            value: value / copies,
            // Rounding of dithered copies is independent.
            error: error / copies / copies.sqrt(),
        });
        largest.push(top);
    }
    if of.iter().any(|w| !w.value.is_finite()) {
        return Err(NotIdentified::new("weights are not finite"));
    }
    let beside = read[1 + copies * count..].iter().map(|x| x.value).collect();
    Ok(Round {
        weights: Weights {
            of,
            zero,
            ray,
            beside,
        },
        largest,
    })
}

impl From<Silence> for NotIdentified {
    fn from(silence: Silence) -> Self {
        NotIdentified::new(silence.to_string())
    }
}
