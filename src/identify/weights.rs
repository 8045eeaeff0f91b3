//! What every node of a ray weighs, by emission in one node alone.

use super::NotIdentified;
use super::ray::{Emission, Layers, Ray};
use super::rule::{Node, Output, Place};
use super::session::Session;
use super::silence::Silence;

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

/// The most copies of each impulse, of sizes that differ by parts of a quantum, where answers are coarse: as many as 8 bits
/// under a cut take.
const COPIES: usize = 8;
/// To which part of it the mean of copies is to be known.
const PART: f64 = 9e-4;
/// Times that sizes are changed until answers are large and none is cut off.
const TRIES: usize = 4;
/// The same for one node where answers are coarse: sizes halve what is left of the range.
const TRIES_COARSE: usize = 8;
/// How much of the room under a cut is used.
const ROOM: f64 = 0.8;
/// The answers aimed at where none is cut off: so many quanta that each says three more digits.
const OPEN: f64 = 1024.0;
/// Answers of fewer quanta say too little to choose a size by.
const SEEN: f64 = 8.0;

/// The weights of `nodes`; channels asked in the same request may stand `beside`.
pub(super) fn weights(
    session: &mut Session<'_>,
    answers: &Answers,
    layers: &Layers,
    nodes: &[Node],
    beside: &[Emission],
) -> Result<Weights, NotIdentified> {
    if let Some(quantum) = answers.output.quantum {
        return coarse(session, (answers, quantum), layers, nodes, beside);
    }
    let high = answers.output.high.unwrap_or(f64::INFINITY);
    let start = if high.is_infinite() { 1.0 } else { high / 8.0 };
    let mut sizes = vec![start.min(answers.emission_max); nodes.len()];
    let tries = if high.is_finite() { TRIES } else { 1 };
    let mut found = None;
    for _ in 0..tries {
        let impulses = Impulses::once(layers, nodes, &sizes);
        let round = measure(session, answers, &impulses, beside)?;
        let cut: Vec<bool> = round.largest.iter().map(|y| *y >= high).collect();
        found = Some(round.weights);
        if cut.iter().all(|cut| !cut) {
            break;
        }
        for (size, cut) in sizes.iter_mut().zip(&cut) {
            if *cut {
                *size /= 32.0;
            }
        }
    }
    found.ok_or_else(|| NotIdentified::new("weights have no finite answers"))
}

/// The size of an impulse whose answer is to be large, and none that is cut off.
#[derive(Clone, Copy)]
struct Sized {
    size: f64,
    /// The largest size at which it was seen too little.
    low: f64,
    /// The least one at which its answer was cut off.
    cut: Option<f64>,
    /// Nothing is seen of it at the largest size.
    dark: Option<Measured>,
    settled: bool,
}

impl Sized {
    /// What to ask next, where the answer was off by `weight` times the size.
    fn next(&mut self, weight: Measured, is_cut: bool, room: f64, quantum: f64, largest: f64) {
        if is_cut {
            self.cut = Some(self.size);
        } else {
            self.low = self.size;
            let seen = weight.value * self.size;
            if seen >= SEEN * quantum || (self.size >= largest && seen > 0.0) {
                self.settled = true;
                self.size = (room / weight.value).min(largest);
                return;
            }
            if self.size >= largest {
                (self.settled, self.dark) = (true, Some(weight));
                return;
            }
            if seen > 0.0 && self.cut.is_none() {
                // Half of what it seems to need: it is known to half a quantum.
                self.size = (0.5 * room / weight.value).min(largest);
                return;
            }
        }
        self.size = match self.cut {
            None => largest,
            Some(cut) => (self.low * cut).sqrt(),
        };
    }
}

/// The same where answers are multiples of something: each impulse as large as may be, and copies whose sizes differ by
/// parts of a quantum.
fn coarse(
    session: &mut Session<'_>,
    (answers, quantum): (&Answers, f64),
    layers: &Layers,
    nodes: &[Node],
    beside: &[Emission],
) -> Result<Weights, NotIdentified> {
    let high = answers.output.high.unwrap_or(f64::INFINITY);
    let largest = answers.emission_max.min(1e6);
    let mut all = vec![
        Sized {
            size: largest.min(1.0),
            low: 1e-6,
            cut: None,
            dark: None,
            settled: false,
        };
        nodes.len()
    ];
    let mut room = ROOM;
    for _ in 0..TRIES_COARSE {
        let open: Vec<usize> = (0..all.len()).filter(|k| !all[*k].settled).collect();
        if open.is_empty() {
            break;
        }
        let some: Vec<Node> = open.iter().map(|k| nodes[*k]).collect();
        let sizes: Vec<f64> = open.iter().map(|k| all[*k].size).collect();
        let round = measure(
            session,
            answers,
            &Impulses::once(layers, &some, &sizes),
            &[],
        )?;
        room = if high.is_finite() {
            ROOM * (high - round.weights.zero.value)
        } else {
            OPEN * quantum
        };
        for (at, k) in open.into_iter().enumerate() {
            let (weight, is_cut) = (round.weights.of[at], round.largest[at] >= high);
            all[k].next(weight, is_cut, room, quantum, largest);
        }
    }
    let lit: Vec<usize> = (0..all.len()).filter(|k| all[*k].dark.is_none()).collect();
    let some: Vec<Node> = lit.iter().map(|k| nodes[*k]).collect();
    let sizes: Vec<f64> = lit.iter().map(|k| all[*k].size).collect();
    let impulses = Impulses {
        copies: copies(room / quantum),
        apart: quantum / room,
        ..Impulses::once(layers, &some, &sizes)
    };
    let mut found = measure(session, answers, &impulses, beside)?.weights;
    let mut lit = found.of.into_iter();
    let of = all.iter().map(|one| one.dark.or_else(|| lit.next()));
    found.of = of.flatten().collect();
    Ok(found)
}

/// How many copies an answer of so many quanta takes: each is off by half a quantum, and their mean by less.
fn copies(quanta: f64) -> usize {
    let wanted = (0.5 / quanta / PART)
        .powi(2)
        .ceil()
        .clamp(1.0, COPIES as f64);
    // Between 1 and the most.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let wanted = wanted as usize;
    wanted
}

/// Emissions in one node each.
struct Impulses<'a> {
    layers: &'a Layers,
    nodes: &'a [Node],
    sizes: &'a [f64],
    /// Of each, of sizes that differ.
    copies: usize,
    /// By which part of them all copies together do.
    apart: f64,
}

impl<'a> Impulses<'a> {
    fn once(layers: &'a Layers, nodes: &'a [Node], sizes: &'a [f64]) -> Self {
        Impulses {
            layers,
            nodes,
            sizes,
            copies: 1,
            apart: 0.0,
        }
    }
}

struct Round {
    weights: Weights,
    /// The largest answer to an impulse in each node.
    largest: Vec<f64>,
}

fn measure(
    session: &mut Session<'_>,
    answers: &Answers,
    impulses: &Impulses<'_>,
    beside: &[Emission],
) -> Result<Round, NotIdentified> {
    let Impulses {
        layers,
        nodes,
        sizes,
        copies,
        apart,
    } = *impulses;
    let n = layers.count();
    let size = |copy: usize, k: usize| {
        let part = copy as f64 * apart / copies as f64;
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
