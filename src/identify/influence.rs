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
    let base = Base::of(answers, even, samples);
    // Where there are few rays both are one question: mostly nothing else acts.
    if session.is_short() {
        let others = base.others();
        let both = base.raise(session, &others)?;
        if let Ok(found @ Influence::Own { whole: Whole::One }) = base.acts(&both) {
            return Ok(found);
        }
    }
    if base.others_act(session)? {
        return Ok(Influence::Several);
    }
    let raised = base.raised();
    let found = base.raise(session, &raised)?;
    base.acts(&found)
}

/// The weights over an even medium, with which others are compared.
struct Base<'a> {
    answers: &'a Answers,
    samples: &'a Samples,
    n: usize,
    extinction: f64,
    nodes: Vec<Node>,
    of: Vec<Measured>,
    /// Those that have weight.
    live: Vec<usize>,
    slack: f64,
}

/// Which segment's extinction is raised.
const AT: usize = 5;

impl<'a> Base<'a> {
    fn of(answers: &'a Answers, even: &Even, samples: &'a Samples) -> Self {
        let n = even.weights.ray.segments.count();
        let nodes = nodes_of(samples.place, n, samples.sequence.extra.is_some());
        let weight = |node: &Node| weight_of(&even.weights, n, *node);
        let of: Vec<Measured> = nodes.iter().map(weight).collect();
        let top = of.iter().map(|w| w.value.abs()).fold(0.0, f64::max);
        let lit = |k: &usize| of[*k].value.abs() > 1e-9 * top + 8.0 * of[*k].error;
        Base {
            answers,
            samples,
            n,
            extinction: even.extinction,
            live: (0..nodes.len()).filter(lit).collect(),
            nodes,
            of,
            slack: 8.0 * answers.relative(n),
        }
    }

    /// A weight by that over the even medium.
    fn ratio(&self, of: &[Measured], k: usize) -> Measured {
        let base = self.of[k];
        Measured {
            value: of[k].value / base.value,
            error: (of[k].error + base.error * (of[k].value / base.value).abs()) / base.value.abs(),
        }
    }

    fn agree(&self, all: &[Measured], value: f64) -> bool {
        all.iter()
            .all(|r| (r.value - value).abs() <= 3.0 * r.error + self.slack * value.abs().max(1.0))
    }

    /// Random extinctions.
    fn others(&self) -> Vec<f64> {
        let tau = self.extinction;
        Random::new(23).many(self.n, 0.25 * tau, 5.0 * tau)
    }

    /// The even ones, and one raised.
    fn raised(&self) -> Vec<f64> {
        let mut raised = vec![self.extinction; self.n];
        raised[AT.min(self.n - 1)] *= RAISED;
        raised
    }

    /// Whether extinctions at nodes that have no weight act.
    fn others_act(&self, session: &mut Session<'_>) -> Result<bool, NotIdentified> {
        let taus = vec![self.extinction; self.n];
        let layers = layers_at(self.samples.place, STEP, &taus, &self.others());
        let found = weights(session, self.answers, &layers, &self.nodes, &[])?.of;
        let mut all = self.live.iter();
        Ok(!all.all(|k| self.agree(&[self.ratio(&found, *k)], 1.0)))
    }

    /// Weights with one extinction raised, and those of nodes without weight.
    fn raise(
        &self,
        session: &mut Session<'_>,
        others: &[f64],
    ) -> Result<Vec<Measured>, NotIdentified> {
        let layers = layers_at(self.samples.place, STEP, &self.raised(), others);
        Ok(weights(session, self.answers, &layers, &self.nodes, &[])?.of)
    }

    /// What the extinction that was raised acts on.
    fn acts(&self, found: &[Measured]) -> Result<Influence, NotIdentified> {
        let samples = self.samples;
        // The sample in the middle of those that are taken.
        let back = samples.place == Place::Back;
        let extra = samples.sequence.extra.is_some();
        let order = samples.sequence.order(self.n, false, back);
        let offset = isize::from(back && extra);
        let position = |k: usize| {
            let index = isize::try_from(k).unwrap_or(0) - offset;
            order.iter().position(|i| *i == index)
        };
        let late = usize::from(samples.sequence.late);
        let own = AT.min(self.n - 1) + usize::from(back && extra);
        let Some(at) = position(own) else {
            return Err(NotIdentified::new("the raised sample is not taken"));
        };
        let rows: Vec<Vec<f64>> = self
            .live
            .iter()
            .map(|k| {
                let r = self.ratio(found, *k);
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
        let last = self.live.iter().filter_map(|k| position(*k)).max();
        for &k in &self.live {
            match position(k) {
                Some(p) if p < at => before.push(self.ratio(found, k)),
                Some(p) if p > at && p <= at + late => before.push(self.ratio(found, k)),
                // A wall's weight is another law's.
                Some(p) if p > at + late && !(samples.wall && Some(p) == last) => {
                    behind.push(self.ratio(found, k));
                }
                _ => {}
            }
        }
        let (Some(factor), Some(through)) = (before.first().copied(), behind.first().copied())
        else {
            return failed("too few samples have weight");
        };
        if !self.agree(&before, factor.value) || !self.agree(&behind, through.value) {
            return failed(
                "a segment's extinction does not act as one factor on all that lies behind it and on nothing else",
            );
        }
        if (factor.value - 1.0).abs() <= 3.0 * factor.error + self.slack {
            return Ok(Influence::Own { whole: Whole::One });
        }
        // Neighbours inside, in the order in which they are taken.
        let inner = |k: &usize| position(*k).is_some_and(|p| p > 0 && p + 1 < order.len());
        let mut inner: Vec<(usize, f64)> = self
            .live
            .iter()
            .filter(|k| inner(k))
            .filter_map(|k| Some((position(*k)?, self.of[*k].value)))
            .collect();
        inner.sort_by_key(|(position, _)| *position);
        let raised = Raised {
            factor,
            through,
            count: order.len(),
            allowed: 8.0 * (factor.error + self.slack),
        };
        match raised.whole(&inner) {
            Some(whole) => Ok(Influence::Own { whole }),
            None => failed(
                "all weights change by a common factor, which is neither division nor multiplication by the ray's opacity",
            ),
        }
    }
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
