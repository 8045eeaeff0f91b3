//! Where a kernel samples that may sample anywhere: places and weights of all samples, by hats of emission.

mod fit;
mod lit;

pub(super) use fit::count;
pub(super) use lit::{Lit, lit};

use super::NotIdentified;
use super::pose::{Made, Steps, hats};
use super::rule::Lattice;
use super::session::Session;
use super::weights::Answers;

/// Where samples lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Places {
    /// At ends and middles of segments.
    Nodes,
    /// Elsewhere.
    Lattice(Lattice),
}

/// The samples of one ray.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub(super) steps: Steps,
    /// λ and weight of every sample, in the order of λ.
    pub(super) samples: Vec<(f64, f64)>,
    /// By how much a place may be off.
    pub(super) tolerance: f64,
}

/// (n, d, length of the last segment by the others).
const RAYS: [(usize, f64, f64); 8] = [
    (8, 0.25, 1.0),
    (12, 0.25, 1.0),
    (8, 0.7, 1.0),
    (5, 0.0625, 1.0),
    (1, 0.5, 1.0),
    (8, 0.25, 0.3),
    (11, 0.7, 0.6),
    (3, 0.25, 0.85),
];
/// The optical depth of these rays: enough that a sample shows, and so little that all do.
const DEPTH: f64 = 0.5;
/// Where a kernel's law hides most of this, less is tried, down to this.
pub(super) const THINNER: f64 = 8.0;
pub(super) const LEAST: f64 = 1e-2;
/// Hats, at first and where samples stand too close.
const HATS: [usize; 3] = [65, 263, 1_049];

/// Reads places off.
pub(super) fn places(
    session: &mut Session<'_>,
    answers: &Answers,
) -> Result<Places, NotIdentified> {
    if answers.is_coarse() {
        // Places are not to be seen in so few digits: later stages ask the nodes, and rays tell whether that was right.
        return Ok(Places::Nodes);
    }
    let mut all = Vec::new();
    let mut probe = Probe {
        finest: 0,
        depth: DEPTH,
    };
    for (n, step, last) in RAYS {
        if (last < 1.0 && session.divides) || !n.is_multiple_of(session.multiple) {
            continue;
        }
        let length = if last < 1.0 {
            (n as f64 - 1.0 + last) * step
        } else {
            n as f64 * step
        };
        let steps = Steps {
            length,
            step,
            segments: n,
        };
        all.push(seen(session, answers, steps, &mut probe)?);
    }
    if all.iter().all(on_nodes) {
        return Ok(Places::Nodes);
    }
    fit::lattice(&all).map_or_else(|| Err(unknown(&all)), |found| Ok(Places::Lattice(found)))
}

/// How rays ask.
struct Probe {
    /// Which of the numbers of hats.
    finest: usize,
    /// Optical depth.
    depth: f64,
}

/// Whether samples hide so much that some behind may not show: the last may be a wall.
pub(super) fn hides(samples: &[Lit]) -> bool {
    match samples {
        [first, .., last, _] => last.weight.abs() < first.weight.abs() / 4.0,
        _ => false,
    }
}

/// The samples of one ray, with more and more hats until each is seen alone.
fn seen(
    session: &mut Session<'_>,
    answers: &Answers,
    steps: Steps,
    probe: &mut Probe,
) -> Result<Seen, NotIdentified> {
    let bright = answers.emission_max.min(1.0) * answers.output.high.map_or(1.0, |h| h.min(1.0));
    loop {
        let extinction = probe.depth / steps.length;
        let count = HATS[probe.finest];
        let knots = hats(steps.length, count, extinction, bright);
        let width = steps.length / (count as f64 - 1.0);
        let made = Made::of_knots(session.name(), session.pose.form, steps, knots);
        let y = session.ask_made(&made)?;
        if let Some(found) = lit(answers, &y, bright) {
            if hides(&found) && probe.depth > LEAST {
                probe.depth /= THINNER;
                continue;
            }
            let samples: Vec<(f64, f64)> = found.iter().map(|s| (s.at * width, s.weight)).collect();
            let parts = 64.0 * answers.unit + 8.0 * answers.noise;
            return Ok(Seen {
                steps,
                samples,
                tolerance: parts * steps.length,
            });
        }
        if probe.finest + 1 == HATS.len() {
            let dark = y.first().copied().unwrap_or(0.0);
            let rows = y.iter().skip(1).enumerate();
            let rows = rows.filter(|(_, y)| (**y - dark).abs() > 0.0);
            return Err(NotIdentified::new(format!(
                "samples stand too close to be told apart on a ray of {} segments",
                steps.segments
            ))
            .with_rows(
                &["place", "answer to emission there"],
                rows.map(|(k, y)| vec![k as f64 * width, *y]).collect(),
            ));
        }
        probe.finest += 1;
    }
}

/// Whether all samples lie at ends and middles.
fn on_nodes(seen: &Seen) -> bool {
    let Steps {
        length,
        step,
        segments,
    } = seen.steps;
    seen.samples.iter().all(|(at, _)| {
        (0..segments).any(|i| {
            let from = i as f64 * step;
            let to = (from + step).min(length);
            [from, f64::midpoint(from, to), to]
                .iter()
                .any(|node| (node - at).abs() <= seen.tolerance)
        })
    })
}

/// All places and weights, where no formula explains them.
fn unknown(all: &[Seen]) -> NotIdentified {
    let rows = all.iter().flat_map(|seen| {
        let Steps {
            length,
            step,
            segments,
        } = seen.steps;
        let row = move |(at, w): &(f64, f64)| vec![segments as f64, length, step, *at, *w];
        seen.samples.iter().map(row)
    });
    NotIdentified::new(
        "samples lie neither at ends or middles of segments nor evenly spaced: their places and weights over an even medium \
         are given",
    )
    .with_rows(&["segments", "length", "step", "place", "weight"], rows.collect())
}
