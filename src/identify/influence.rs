//! What an extinction acts on: which weights change when one is raised.

use super::NotIdentified;
use super::places::{Even, STEP, Samples, weight_of};
use super::random::Random;
use super::ray::Layers;
use super::rule::{Node, Place, Whole};
use super::session::Session;
use super::weights::{Answers, Measured, nodes_of, weights};

/// What was found.
#[derive(Clone, Debug)]
pub(super) enum Influence {
    /// Nothing but the samples' own extinctions acts, on what lies behind.
    Own {
        /// What the whole ray is multiplied by.
        whole: Whole,
    },
    /// Extinctions at other nodes act too.
    Several,
}

/// By how much one extinction is raised.
const RAISED: f64 = 3.25;

/// τ of samples at `place`, and of the `others`.
pub(super) fn layers_at(place: Place, step: f64, taus: &[f64], others: &[f64]) -> Layers {
    let with_end = |values: &[f64]| {
        let mut values = values.to_vec();
        values.extend(values.last().copied());
        values
    };
    let (edges, middles) = match place {
        Place::Middle => (with_end(others), taus.to_vec()),
        Place::Front => (with_end(taus), others.to_vec()),
        Place::Back => {
            let mut edges = vec![taus.first().copied().unwrap_or(0.0)];
            edges.extend_from_slice(taus);
            (edges, others.to_vec())
        }
    };
    Layers {
        step,
        last: 1.0,
        edges,
        middles,
    }
}

/// Other extinctions at random; one raised.
pub(super) fn influence(
    session: &mut Session<'_>,
    answers: &Answers,
    even: &Even,
    samples: &Samples,
) -> Result<Influence, NotIdentified> {
    let n = even.weights.ray.segments.count();
    let place = samples.place;
    let extra = samples.sequence.extra.is_some();
    let nodes = nodes_of(place, n, extra);
    let taus = vec![even.extinction; n];
    let weight = |node: &Node| weight_of(&even.weights, n, *node);
    let base: Vec<Measured> = nodes.iter().map(weight).collect();
    let mixed = with_others(session, answers, place, &taus, &nodes)?;
    let top = base.iter().map(|w| w.value.abs()).fold(0.0, f64::max);
    let lit = |k: usize| base[k].value.abs() > 1e-9 * top + 8.0 * base[k].error;
    let live: Vec<usize> = (0..nodes.len()).filter(|k| lit(*k)).collect();
    let ratio = |of: &[Measured], k: usize| Measured {
        value: of[k].value / base[k].value,
        error: (of[k].error + base[k].error * (of[k].value / base[k].value).abs())
            / base[k].value.abs(),
    };
    let slack = 8.0 * answers.relative(n);
    let same = |u: Measured, value: f64| {
        (u.value - value).abs() <= 3.0 * u.error + slack * value.abs().max(1.0)
    };
    if !live.iter().all(|k| same(ratio(&mixed, *k), 1.0)) {
        return Ok(Influence::Several);
    }
    // The sample in the middle of those that are taken.
    let back = place == Place::Back;
    let order = samples.sequence.order(n, false, back);
    let offset = isize::from(back && extra);
    let position = |k: usize| {
        let index = isize::try_from(k).unwrap_or(0) - offset;
        order.iter().position(|i| *i == index)
    };
    let j = 5.min(n - 1);
    let mut raised = taus.clone();
    raised[j] *= RAISED;
    let layers = layers_at(place, STEP, &raised, &raised);
    let found = weights(session, answers, &layers, &nodes, &[])?.of;
    let late = usize::from(samples.sequence.late);
    let own = j + usize::from(back && extra);
    let Some(at) = position(own) else {
        return Err(NotIdentified::new("the raised sample is not taken"));
    };
    let rows: Vec<Vec<f64>> = live
        .iter()
        .map(|k| {
            let r = ratio(&found, *k);
            vec![*k as f64, r.value, r.error]
        })
        .collect();
    let failed = |reason: &str| {
        Err(NotIdentified::new(reason).with_rows(
            &["sample", "weight by that of the even medium", "error"],
            rows.clone(),
        ))
    };
    let (mut before, mut behind) = (Vec::new(), Vec::new());
    let last = live.iter().filter_map(|k| position(*k)).max();
    for &k in &live {
        match position(k) {
            Some(p) if p < at => before.push(ratio(&found, k)),
            Some(p) if p > at && p <= at + late => before.push(ratio(&found, k)),
            // A wall's weight is another law's.
            Some(p) if p > at + late && !(samples.wall && Some(p) == last) => {
                behind.push(ratio(&found, k));
            }
            _ => {}
        }
    }
    let (Some(factor), Some(through)) = (before.first().copied(), behind.first().copied()) else {
        return failed("too few samples have weight");
    };
    let agree = |all: &[Measured], value: f64| {
        all.iter()
            .all(|r| (r.value - value).abs() <= 3.0 * r.error + slack * value.abs().max(1.0))
    };
    if !agree(&before, factor.value) || !agree(&behind, through.value) {
        return failed(
            "a segment's extinction does not act as one factor on all that lies behind it and on nothing else",
        );
    }
    if (factor.value - 1.0).abs() <= 3.0 * factor.error + slack {
        return Ok(Influence::Own { whole: Whole::One });
    }
    // Neighbours inside, in the order in which they are taken.
    let inner = |k: &usize| position(*k).is_some_and(|p| p > 0 && p + 1 < order.len());
    let mut inner: Vec<(usize, f64)> = live
        .iter()
        .filter(|k| inner(k))
        .filter_map(|k| Some((position(*k)?, base[*k].value)))
        .collect();
    inner.sort_by_key(|(position, _)| *position);
    let raised = Raised {
        factor,
        through,
        count: order.len(),
        allowed: 8.0 * (factor.error + slack),
    };
    match raised.whole(&inner) {
        Some(whole) => Ok(Influence::Own { whole }),
        None => failed(
            "all weights change by a common factor, which is neither division nor multiplication by the ray's opacity",
        ),
    }
}

/// Weights where the extinctions at all other nodes are random.
fn with_others(
    session: &mut Session<'_>,
    answers: &Answers,
    place: Place,
    taus: &[f64],
    nodes: &[Node],
) -> Result<Vec<Measured>, NotIdentified> {
    let tau = taus.first().copied().unwrap_or(0.0);
    let others = Random::new(23).many(taus.len(), 0.25 * tau, 5.0 * tau);
    let layers = layers_at(place, STEP, taus, &others);
    Ok(weights(session, answers, &layers, nodes, &[])?.of)
}

/// Weights of a ray with one extinction raised, by those of the even one.
struct Raised {
    /// In front of it.
    factor: Measured,
    /// Behind it.
    through: Measured,
    /// Samples.
    count: usize,
    allowed: f64,
}

impl Raised {
    /// Which factor of the ray's opacity it is that all weights have: that of the even ray and of the raised one follow
    /// from what a segment lets through, and that from weights at positions inside.
    fn whole(&self, inner: &[(usize, f64)]) -> Option<Whole> {
        let (&(near, first), &(far, last)) = (inner.first()?, inner.last()?);
        let steps = far.checked_sub(near).filter(|steps| *steps > 0)?;
        let even = (last / first).powf(1.0 / steps as f64);
        let raised = self.through.value / self.factor.value * even;
        let count = i32::try_from(self.count).ok()?;
        let whole = 1.0 - even.powi(count);
        let other = 1.0 - even.powi(count - 1) * raised;
        let kinds = [
            (Whole::ByOpacity, whole / other),
            (Whole::TimesOpacity, other / whole),
        ];
        let mut kinds = kinds.into_iter();
        let found = kinds.find(|(_, f)| (self.factor.value / f - 1.0).abs() <= self.allowed);
        found.map(|(whole, _)| whole)
    }
}
