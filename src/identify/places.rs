//! Which nodes have weight over an even medium, and in what order samples are taken.

use super::NotIdentified;
use super::random::Random;
use super::ray::{Emission, Layers};
use super::rule::{End, Extra, LastStep, Node, Place, Sequence};
use super::session::Session;
use super::weights::{Answers, Measured, Weights, all_nodes, weights};

/// What the weights over even media say.
#[derive(Clone, Debug)]
pub(super) enum Places {
    /// One sample a segment.
    Samples(Samples),
    /// Several values a segment; of the last one none, perhaps.
    Several(End),
}

/// One sample a segment.
#[derive(Clone, Debug)]
pub(super) struct Samples {
    pub(super) place: Place,
    pub(super) sequence: Sequence,
    /// The last one weighs more than its place says.
    pub(super) wall: bool,
}

/// The medium in which little is lost along the ray, and its weights.
#[derive(Clone, Debug)]
pub(super) struct Even {
    /// τ.
    pub(super) extinction: f64,
    pub(super) weights: Weights,
}

/// n of the even rays; the second where a loop unrolled by many takes none of the first, and leaves a rest to any loop.
const SEGMENTS: [usize; 2] = [12, 47];
/// d.
pub(super) const STEP: f64 = 0.25;
/// τ of the first.
const EXTINCTION: f64 = 0.4;
/// The optical depth of a ray, beyond which an early end would look like samples that are missing.
const DEEPEST: f64 = 2.0;
/// The sum of weights of a ray that lets everything through, beyond which an end by that sum would look alike.
const BRIGHTEST: f64 = 0.5;
/// What a ray loses that is said to let everything through.
const CLEAR: f64 = 1e-6;
/// Weights under this part of the largest are none.
const NONE: f64 = 1e-9;
/// Groups that loops are unrolled by.
const GROUPS: [u64; 8] = [1, 8, 4, 16, 2, 3, 5, 7];

/// Weights of all nodes over an even medium, after a test that they add up.
pub(super) fn even(
    session: &mut Session<'_>,
    answers: &Answers,
    is_random: bool,
) -> Result<Even, NotIdentified> {
    let mut found = even_of(session, answers, is_random, SEGMENTS[0])?;
    if found.weights.of.iter().all(|w| w.value == 0.0) {
        found = even_of(session, answers, is_random, SEGMENTS[1])?;
    }
    Ok(found)
}

fn even_of(
    session: &mut Session<'_>,
    answers: &Answers,
    is_random: bool,
    n: usize,
) -> Result<Even, NotIdentified> {
    let n = n.next_multiple_of(session.multiple);
    let nodes = all_nodes(n);
    let mut random = Random::new(11);
    let most = answers.emission_max.min(1.0) * answers.output.high.map_or(1.0, |h| h.min(1.0));
    let beside: Vec<Emission> = (0..4)
        .map(|_| Emission::of(n, |_| most * random.within(0.1, 1.0)))
        .collect();
    let mut extinction = EXTINCTION;
    for _ in 0..4 {
        let layers = Layers::of(STEP, &vec![extinction; n]);
        let found = weights(session, answers, &layers, &nodes, &beside)?;
        if !is_random {
            adds_up(answers, &found, &beside, n)?;
        }
        let lost = lost_a_segment(&found, n);
        let sum = found.values().iter().map(|w| w.abs()).sum::<f64>();
        if !is_random && lost * n as f64 <= CLEAR && sum > BRIGHTEST {
            extinction *= 0.6 * BRIGHTEST / sum;
            continue;
        }
        let is_thin = lost.is_nan() || lost * n as f64 <= DEEPEST;
        if is_random || is_thin {
            return Ok(Even {
                extinction,
                weights: found,
            });
        }
        extinction *= 0.6 * DEEPEST / (lost * n as f64);
    }
    Err(NotIdentified::new(
        "no even medium is thin enough to see through",
    ))
}

/// −ln of what a segment in the middle lets through.
fn lost_a_segment(found: &Weights, n: usize) -> f64 {
    let values = found.values();
    let (edges, middles) = values.split_at(n + 1);
    let sum = |w: &[f64]| w.iter().map(|w| w.abs()).sum::<f64>();
    let family = if sum(edges) > sum(middles) {
        edges
    } else {
        middles
    };
    let inner = &family[2.min(family.len() - 1)..5.min(family.len())];
    let of_three = match inner {
        [near, _, far] if *near > 0.0 && *far > 0.0 => ((near / far).ln() / 2.0).abs(),
        _ => 0.0,
    };
    // Neighbours of which one counts twice say less than those that are far apart.
    let top = family.iter().copied().fold(0.0, f64::max);
    let mut lit = (1..family.len() - 1).filter(|k| family[*k] > NONE * top);
    match (lit.next(), lit.next_back()) {
        (Some(near), Some(far)) => {
            let apart = (family[near] / family[far]).ln() / (far - near) as f64;
            of_three.min(apart.abs())
        }
        _ => of_three,
    }
}

/// Whether impulses predict random emissions.
fn adds_up(
    answers: &Answers,
    found: &Weights,
    beside: &[Emission],
    n: usize,
) -> Result<(), NotIdentified> {
    let (edges, middles) = found.of.split_at(n + 1);
    let mut rows = Vec::new();
    let mut fails = false;
    for (emission, &got) in beside.iter().zip(&found.beside) {
        let (mut sum, mut bar) = (found.zero.value, found.zero.error);
        let pairs = edges.iter().zip(&emission.edges);
        for (w, c) in pairs.chain(middles.iter().zip(&emission.middles)) {
            sum += w.value * c;
            bar += (w.error * c).abs();
        }
        let allowed = 2.0 * bar + answers.relative(n) * 4.0 * sum.abs();
        let allowed = allowed + 1.5 * answers.output.quantum.unwrap_or(0.0);
        rows.push(vec![sum, got]);
        fails |= (sum - got).abs() > allowed;
    }
    if fails {
        return Err(NotIdentified::new(
            "the answer is not a linear function of the emission: what single nodes add does not predict their sum",
        )
        .with_rows(&["sum of single nodes", "answer"], rows));
    }
    Ok(())
}

/// One reading of the weights.
#[derive(Clone, Copy, Debug)]
struct Reading {
    place: Place,
    sequence: Sequence,
    wall: bool,
}

impl Reading {
    /// How much is unusual about it.
    fn faults(&self) -> usize {
        let sequence = &self.sequence;
        [
            sequence.first != End::Once,
            sequence.last != End::Once,
            sequence.extra.is_some(),
            sequence.swapped,
            sequence.late,
            sequence.unrolled != 1,
            // Two: any weight of the last sample fits it.
            self.wall,
            self.wall,
        ]
        .into_iter()
        .filter(|is| *is)
        .count()
    }

    /// (node, times it is taken, position of each) in order.
    fn taken(&self, n: usize, partial: bool) -> Vec<Node> {
        let back = self.place == Place::Back;
        let order = self.sequence.order(n, partial, back);
        order.iter().filter_map(|i| self.place.node(*i)).collect()
    }

    /// Whether it explains weights over an even medium.
    fn explains(
        &self,
        answers: &Answers,
        n: usize,
        of: &dyn Fn(Node) -> Measured,
        top: f64,
    ) -> bool {
        let taken = self.taken(n, false);
        if taken.len() < 6 {
            return false;
        }
        // Nodes that are lit are those taken.
        let is_lit = |node: Node| {
            let w = of(node);
            w.value.abs() > NONE * top + 3.0 * w.error
        };
        if all_nodes(n)
            .into_iter()
            .any(|node| is_lit(node) != taken.contains(&node))
        {
            return false;
        }
        // What falls from one sample in the inside to the next.
        let inside = &taken[2..taken.len() - 2];
        let (Some(near), Some(far)) = (inside.first(), inside.last()) else {
            return false;
        };
        if inside.len() < 2 {
            return false;
        }
        let ratio = of(*far).value / of(*near).value;
        if ratio.is_nan() || ratio <= 0.0 {
            return false;
        }
        let fall = ratio.powf(1.0 / (inside.len() - 1) as f64);
        if fall > 1.0 + answers.relative(n) {
            return false;
        }
        let late = usize::from(self.sequence.late);
        let mut model: Vec<(Node, f64)> = Vec::new();
        for (k, node) in taken.iter().enumerate() {
            let seen = fall.powi(i32::try_from(k.saturating_sub(late)).unwrap_or(0));
            match model.iter_mut().find(|(at, _)| at == node) {
                Some((_, sum)) => *sum += seen,
                None => model.push((*node, seen)),
            }
        }
        let (last, rest) = match model.split_last() {
            Some((last, rest)) if self.wall => (Some(*last), rest),
            _ => (None, model.as_slice()),
        };
        let scale = of(*near).value / model_of(&model, *near);
        let fits = |(node, seen): &(Node, f64)| {
            let w = of(*node);
            let want = seen * scale;
            let allowed = 3.0 * w.error + 8.0 * answers.relative(n) * want.abs();
            let near = of(*near);
            let allowed = allowed + 3.0 * near.error * (want / near.value).abs() * n as f64;
            (w.value - want).abs() <= allowed
        };
        if !rest.iter().all(fits) {
            return false;
        }
        match last {
            // A wall weighs more than a segment.
            Some((node, seen)) => of(node).value > 1.5 * seen * scale,
            None => true,
        }
    }
}

fn model_of(model: &[(Node, f64)], node: Node) -> f64 {
    let found = model.iter().find(|(at, _)| *at == node);
    found.map_or(f64::NAN, |(_, seen)| *seen)
}

/// All readings, those with the fewest faults first.
fn readings() -> Vec<Reading> {
    let ends = [End::Once, End::Missing, End::Twice];
    let mut all = Vec::new();
    for place in [Place::Middle, Place::Front, Place::Back] {
        for first in ends {
            for last in ends {
                for extra in [None, Some(Extra::Step), Some(Extra::Last)] {
                    if extra.is_some() && place == Place::Middle {
                        continue;
                    }
                    for swapped in [false, true] {
                        for late in [false, true] {
                            for unrolled in GROUPS {
                                for wall in [false, true] {
                                    let sequence = Sequence {
                                        first,
                                        last,
                                        extra,
                                        swapped,
                                        late,
                                        unrolled,
                                        ..Sequence::default()
                                    };
                                    all.push(Reading {
                                        place,
                                        sequence,
                                        wall,
                                    });
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    all.sort_by_key(Reading::faults);
    all
}

/// Reads places and order off.
pub(super) fn places(
    session: &mut Session<'_>,
    answers: &Answers,
    even: &Even,
) -> Result<Places, NotIdentified> {
    let n = even.weights.ray.segments.count();
    let nodes = all_nodes(n);
    let of = |node: Node| weight_of(&even.weights, n, node);
    let top = nodes
        .iter()
        .map(|node| of(*node).value.abs())
        .fold(0.0, f64::max);
    if top == 0.0 {
        return Err(NotIdentified::new("no node has any weight"));
    }
    let fitting: Vec<Reading> = readings()
        .into_iter()
        .filter(|reading| reading.explains(answers, n, &of, top))
        .collect();
    let Some(first) = fitting.first() else {
        let lit = |node: &Node| of(*node).value.abs() > NONE * top + 3.0 * of(*node).error;
        let lit: Vec<Node> = nodes.iter().copied().filter(lit).collect();
        let first_edges = (0..n).all(|i| lit.contains(&Node::Edge(i)));
        let middles = (0..n).filter(|i| lit.contains(&Node::Middle(*i))).count();
        let last = match lit.contains(&Node::Edge(n)) {
            true if middles == 0 || middles == n => Some(End::Once),
            false if middles == 0 || middles == n - 1 => Some(End::Missing),
            _ => None,
        };
        if let Some(last) = last.filter(|_| first_edges) {
            return Ok(Places::Several(last));
        }
        let rows = nodes.iter().map(|node| {
            let (at, w) = match node {
                Node::Edge(i) => (*i as f64, of(*node)),
                Node::Middle(i) => (*i as f64 + 0.5, of(*node)),
            };
            vec![at, w.value, w.error]
        });
        return Err(NotIdentified::new(
            "the weights over an even medium are not those of a sum over its segments in order",
        )
        .with_rows(&["place in segments", "weight", "error"], rows.collect()));
    };
    // Those with a fault more say the same with more words.
    let least = first.faults();
    let mut left: Vec<Reading> = fitting
        .into_iter()
        .filter(|r| r.faults() == least)
        .collect();
    if left.len() > 1 {
        left = told_by_last_step(session, answers, even, left)?;
    }
    let Some(chosen) = left.first().copied() else {
        return Err(NotIdentified::new(
            "no order of samples explains both a whole and a shorter last segment",
        ));
    };
    let mut sequence = chosen.sequence;
    sequence.last_step = LastStep::Own;
    Ok(Places::Samples(Samples {
        place: chosen.place,
        sequence,
        wall: chosen.wall,
    }))
}

/// The weight of a node among all of them.
pub(super) fn weight_of(weights: &Weights, n: usize, node: Node) -> Measured {
    match node {
        Node::Edge(i) => weights.of[i],
        Node::Middle(i) => weights.of[n + 1 + i],
    }
}

/// Readings that put the last segment where a shorter one changes the weights.
fn told_by_last_step(
    session: &mut Session<'_>,
    answers: &Answers,
    even: &Even,
    readings: Vec<Reading>,
) -> Result<Vec<Reading>, NotIdentified> {
    if session.divides {
        return Ok(readings);
    }
    let n = even.weights.ray.segments.count();
    let mut layers = Layers::of(STEP, &vec![even.extinction; n]);
    layers.last = 0.3;
    let short = weights(session, answers, &layers, &all_nodes(n), &[])?;
    let changed = |node: Node| {
        let (whole, part) = (
            weight_of(&even.weights, n, node),
            weight_of(&short, n, node),
        );
        let allowed = whole.error + part.error + 64.0 * answers.relative(n) * whole.value.abs();
        (whole.value - part.value).abs() > allowed
    };
    let changes: Vec<Node> = all_nodes(n)
        .into_iter()
        .filter(|node| changed(*node))
        .collect();
    if changes.is_empty() {
        return Ok(readings);
    }
    let agrees = |reading: &Reading| {
        let back = reading.place == Place::Back;
        let last = isize::try_from(n).unwrap_or(isize::MAX) - 1;
        let order = reading.sequence.order(n, false, back);
        // Samples that stand for a segment as short as the last one.
        let is_short = |i: &isize| {
            let is_extra = *i < 0 || *i > last;
            *i == last || (is_extra && reading.sequence.extra == Some(Extra::Last))
        };
        let Some(from) = order.iter().position(is_short) else {
            return false;
        };
        // Their own weights change, and what lies behind them may.
        let nodes = |of: &mut dyn Iterator<Item = &isize>| -> Vec<Node> {
            of.filter_map(|i| reading.place.node(*i)).collect()
        };
        let own = nodes(&mut order.iter().filter(|i| is_short(i)));
        let behind = nodes(&mut order[from..].iter());
        own.iter().all(|own| changes.contains(own))
            && changes.iter().all(|node| behind.contains(node))
    };
    let told: Vec<Reading> = readings.iter().copied().filter(agrees).collect();
    Ok(if told.is_empty() { readings } else { told })
}
