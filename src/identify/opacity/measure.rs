//! What single segments add and let through, between references.

use crate::identify::NotIdentified;
use crate::identify::influence::layers_at;
use crate::identify::places::Samples;
use crate::identify::ray::{Emission, Layers};
use crate::identify::rule::{End, Node, Place, Whole};
use crate::identify::session::Session;
use crate::identify::weights::{Answers, Measured, nodes_of, weights};

/// (w, p) at an extinction and a length, on a ray of length D.
#[derive(Clone, Copy, Debug)]
pub(in crate::identify) struct Point {
    pub(in crate::identify) extinction: f64,
    pub(in crate::identify) length: f64,
    pub(in crate::identify) ray: f64,
    /// w; NaN where the ray had ended before.
    pub(in crate::identify) weight: Measured,
    /// p; NaN where the ray has ended.
    pub(in crate::identify) passes: Measured,
}

/// Extinctions that segments of a length are compared with, and what they do.
#[derive(Clone, Copy, Debug)]
pub(in crate::identify) struct Reference {
    pub(in crate::identify) length: f64,
    pub(in crate::identify) extinction: f64,
    /// What they are weighed by, of a ray of references alone.
    own: Measured,
    /// What they let through there.
    through: Measured,
}

/// How samples are measured.
#[derive(Clone, Debug)]
pub(in crate::identify) struct Measurer<'a> {
    pub(in crate::identify) answers: &'a Answers,
    pub(in crate::identify) samples: &'a Samples,
    pub(in crate::identify) whole: Whole,
    /// A transmittance is 1 less the opacity so far, and known to a unit of 1.
    pub(in crate::identify) subtracts: bool,
}

/// A ray of extinctions between references.
#[derive(Clone, Debug)]
pub(in crate::identify) struct Asked {
    /// Where the extinctions stand.
    at: Vec<usize>,
    /// References before the first.
    lead: usize,
    /// All samples' weights.
    weights: Vec<Measured>,
}

/// What was not asked.
const UNKNOWN: Measured = Measured {
    value: f64::NAN,
    error: f64::INFINITY,
};

/// One weight by another.
fn ratio(one: Measured, other: Measured) -> Measured {
    let value = one.value / other.value;
    let error = one.error / other.value.abs() + (value * other.error / other.value).abs();
    Measured { value, error }
}

/// The depth of references differs by more than this part where it depends on the length of the ray.
const OTHER: f64 = 0.01;
/// The depth of references.
const DEPTH: f64 = 1.0 / 32.0;
/// Known to this part of a reference's weight, one that is the same behind another says that all is let through.
const CLEAR: f64 = 1e-3;
/// References before the first extinction where all is in order; and where the first samples are not.
const LEAD: usize = 6;
/// References behind the last one.
const TAIL: usize = 3;

/// Behind what lets all through only an end of the ray is dark: the last sample that is seen may count in part, and says
/// nothing.
fn forget_the_crossing(w: &mut [Measured], lead: usize) {
    let lit = |w: &Measured| w.value.abs() > 3.0 * w.error;
    let (near, far) = (w[lead - 2], w[lead - 1]);
    let error = 3.0 * (far.error + near.error);
    let is_fine = error < CLEAR * near.value.abs();
    let is_clear = is_fine && lit(&near) && (far.value - near.value).abs() <= error;
    let is_known = w.last().is_some_and(|last| last.error.is_finite());
    let last = w.iter().rposition(lit);
    if let Some(last) = last.filter(|last| is_clear && is_known && last + 1 < w.len()) {
        w[last].error = f64::INFINITY;
    }
}

impl Measurer<'_> {
    /// The weights of the n samples in the order in which the kernel takes them.
    pub(in crate::identify) fn weights(
        &self,
        session: &mut Session<'_>,
        taus: &[f64],
        length: f64,
    ) -> Result<Vec<Measured>, NotIdentified> {
        self.weights_of(session, taus, length, &|_| true)
    }

    /// The same of those samples alone that are `wanted`, by their place in that order, where each costs a channel; the
    /// others are not known.
    pub(in crate::identify) fn weights_of(
        &self,
        session: &mut Session<'_>,
        taus: &[f64],
        length: f64,
        wanted: &dyn Fn(usize) -> bool,
    ) -> Result<Vec<Measured>, NotIdentified> {
        let is_narrow = session.is_narrow();
        self.some_weights(session, taus, length, &|k| !is_narrow || wanted(k))
    }

    /// The same of those that are `wanted`, of a ray of more samples than a request has channels for.
    pub(in crate::identify) fn some_weights(
        &self,
        session: &mut Session<'_>,
        taus: &[f64],
        length: f64,
        wanted: &dyn Fn(usize) -> bool,
    ) -> Result<Vec<Measured>, NotIdentified> {
        let (layers, nodes) = self.samples_of(taus, length);
        let asked: Vec<(usize, Node)> = nodes.into_iter().filter(|(k, _)| wanted(*k)).collect();
        let nodes: Vec<Node> = asked.iter().map(|(_, node)| *node).collect();
        let found = weights(session, self.answers, &layers, &nodes, &[])?;
        let mut of = vec![UNKNOWN; taus.len()];
        for ((k, _), w) in asked.iter().zip(&found.of) {
            of[*k] = *w;
        }
        // What stands beside much that is no emission's is known no better.
        let beside = 16.0 * self.answers.unit * found.zero.value.abs();
        for w in &mut of {
            w.error += beside;
        }
        Ok(of)
    }

    /// The place in `order`, in which the kernel takes samples, of the last one from which on emission shows. Emission behind
    /// as many samples as a request takes is asked at once; where answers are coarse it is as bright as may be.
    pub(in crate::identify) fn last_lit(
        &self,
        session: &mut Session<'_>,
        taus: &[f64],
        length: f64,
        order: &[usize],
    ) -> Result<usize, NotIdentified> {
        let n = taus.len();
        let size = self.answers.emission_max.min(1e6);
        let (layers, nodes) = self.samples_of(taus, length);
        let node = |k: &usize| nodes.iter().find(|(at, _)| at == k).map(|(_, node)| *node);
        let at_once = if session.is_narrow() { 2 } else { n };
        // Behind all samples nothing shows.
        let (mut low, mut high) = (0, order.len());
        while high - low > 1 {
            let parts = (high - low).min(at_once + 1);
            let borders: Vec<usize> = (1..parts).map(|k| low + (high - low) * k / parts).collect();
            let mut emission = vec![Emission::even(n, 0.0)];
            for border in &borders {
                let mut behind = Emission::even(n, 0.0);
                for node in order[*border..].iter().filter_map(node) {
                    *behind.at_mut(node) = size;
                }
                emission.push(behind);
            }
            let ray = session.ray(&layers, &emission);
            let y = session.ask(&ray)?;
            let shows = |y_behind: &f64| y_behind.to_bits() != y[0].to_bits();
            let first_dark = y[1..].iter().position(|y| !shows(y));
            let lit = first_dark.unwrap_or(borders.len());
            if let Some(border) = lit.checked_sub(1) {
                low = borders[border];
            }
            high = borders.get(lit).copied().unwrap_or(high);
        }
        Ok(low)
    }

    /// The medium of those extinctions along the way that the kernel takes, and the node of each.
    fn samples_of(&self, taus: &[f64], length: f64) -> (Layers, Vec<(usize, Node)>) {
        let n = taus.len();
        let place = self.samples.place;
        let extra = self.samples.sequence.extra.is_some();
        let swapped = self.samples.sequence.swapped;
        let mut along = taus.to_vec();
        if swapped {
            along.reverse();
        }
        let layers = layers_at(place, length, &along, &along);
        let mut nodes = nodes_of(place, n, extra);
        if extra {
            if place == Place::Back {
                nodes.remove(0);
            } else {
                nodes.truncate(n);
            }
        }
        let places: Vec<usize> = if swapped {
            (0..n).rev().collect()
        } else {
            (0..n).collect()
        };
        (layers, places.into_iter().zip(nodes).collect())
    }

    /// n rounded up to what the kernel takes whole.
    pub(in crate::identify) fn suitable(&self, session: &Session<'_>, n: usize) -> usize {
        let unrolled = usize::try_from(self.samples.sequence.unrolled).unwrap_or(1);
        n.min(session.most_samples)
            .next_multiple_of(unrolled.max(1))
            .next_multiple_of(session.multiple)
    }

    /// Samples at the near end that do not count once.
    pub(in crate::identify) fn near_end(&self) -> End {
        let sequence = &self.samples.sequence;
        if sequence.swapped {
            sequence.last
        } else {
            sequence.first
        }
    }

    /// An extinction at which a segment of that length lets about e^(−1/32) through.
    pub(in crate::identify) fn reference(
        &self,
        session: &mut Session<'_>,
        length: f64,
    ) -> Result<Reference, NotIdentified> {
        let mut extinction = DEPTH / length;
        let mut raised = false;
        let mut found = Reference {
            length,
            extinction,
            own: UNKNOWN,
            through: UNKNOWN,
        };
        let mut before: Option<(f64, f64)> = None;
        for _ in 0..10 {
            let n = self.suitable(session, 9);
            let w = self.weights_of(session, &vec![extinction; n], length, &|k| k < 4)?;
            found.extinction = extinction;
            found.own = self.own(&w, n);
            found.through = ratio(w[3], w[2]);
            let got = if w[2].value > 0.0 && w[3].value > 0.0 {
                (w[2].value / w[3].value).ln()
            } else {
                f64::INFINITY
            };
            let alive = w.iter().any(|w| w.value.abs() > 3.0 * w.error);
            if !alive {
                // Nothing is left of so little: a table's first entry, a skip.
                extinction *= 2.0;
                raised = true;
                continue;
            }
            let is_near = got > 0.6 * DEPTH && got < 1.7 * DEPTH;
            let is_clear = got.abs() < 1e-14 && extinction * length > 0.01;
            if is_near || is_clear || (raised && got < 0.5) {
                break;
            }
            // By the power with which the depth grows with the extinction.
            let power = before.map_or(1.0, |(tau, depth)| {
                ((got / depth).ln() / (extinction / tau).ln()).clamp(0.25, 4.0)
            });
            let power = if power.is_finite() { power } else { 1.0 };
            before = (got > 0.0 && got.is_finite()).then_some((extinction, got));
            extinction *= if got > 0.0 {
                (DEPTH / got).powf(1.0 / power).clamp(1.0 / 64.0, 64.0)
            } else {
                8.0
            };
        }
        Ok(found)
    }

    /// (w, p) of each extinction: three references, then each between references, then three; and of the reference.
    pub(in crate::identify) fn points(
        &self,
        session: &mut Session<'_>,
        reference: &Reference,
        extinctions: &[f64],
    ) -> Result<Vec<Point>, NotIdentified> {
        let (lead, count) = (self.lead(), extinctions.len());
        let most = session.most_samples.saturating_sub(lead + TAIL) / 3;
        if count > most.max(1) {
            let mut all = Vec::new();
            for some in extinctions.chunks(most.max(1)) {
                // The reference comes last.
                all.pop();
                all.extend(self.points(session, reference, some)?);
            }
            return Ok(all);
        }
        let asked = self.asked(session, reference, extinctions)?;
        Ok(self.read(&asked, reference, extinctions))
    }

    /// References before the first extinction.
    fn lead(&self) -> usize {
        let sequence = &self.samples.sequence;
        let plain = !sequence.late && sequence.first == End::Once && sequence.last == End::Once;
        if plain { LEAD / 2 } else { LEAD }
    }

    /// Asks a ray of those extinctions between references.
    pub(in crate::identify) fn asked(
        &self,
        session: &mut Session<'_>,
        reference: &Reference,
        extinctions: &[f64],
    ) -> Result<Asked, NotIdentified> {
        let (lead, count) = (self.lead(), extinctions.len());
        let n = self.suitable(session, lead + TAIL + 3 * count);
        let mut taus = vec![reference.extinction; n];
        // From the last to the first: given in ascending order the thin ones come last, where a ray may end by them.
        let at: Vec<usize> = (0..count).rev().map(|k| lead + 3 * k).collect();
        for (place, tau) in at.iter().zip(extinctions) {
            taus[*place] = *tau;
        }
        // Each extinction, the references before and behind, and a few more pairs of neighbours.
        let tells = |k: usize| {
            let block = at.iter().any(|at| k == *at || k + 1 == *at || k == at + 2);
            let pair = at.iter().take(2).any(|at| k == at + 1);
            block || pair || k + 2 == lead || k + 1 == lead
        };
        let weights = self.weights_of(session, &taus, reference.length, &tells)?;
        Ok(Asked { at, lead, weights })
    }

    /// Whether transmittances behind a thick segment are rounded to a unit of 1: what the references there let through is
    /// not what those in front do.
    pub(in crate::identify) fn shows_subtraction(&self, asked: &Asked) -> bool {
        let w = &asked.weights;
        let through = |far: usize| w[far].value / w[far - 1].value;
        let (front, back) = (through(asked.lead - 1), through(asked.at[0] + 2));
        let passed = w[asked.at[0] + 1].value / w[asked.lead - 2].value;
        let off = (back / front - 1.0).abs();
        off > 1e3 * self.answers.unit && off < 16.0 * self.answers.unit / passed
    }

    /// (w, p) of each extinction, and of the reference.
    pub(in crate::identify) fn read(
        &self,
        asked: &Asked,
        reference: &Reference,
        extinctions: &[f64],
    ) -> Vec<Point> {
        let mut w = asked.weights.clone();
        let (at, lead, n, count) = (&asked.at, asked.lead, w.len(), extinctions.len());
        forget_the_crossing(&mut w, lead);
        self.add_rounding(&mut w, at, reference.own.value);
        let ratio = |k: usize, by: usize| ratio(w[k], w[by]);
        let through = self.through(&w, at, lead, count);
        let own = self.own_of(reference, &w, lead, through);
        let ray = n as f64 * reference.length;
        let unit = self.answers.unit;
        let mut points: Vec<Point> = at
            .iter()
            .zip(extinctions)
            .map(|(&at, &extinction)| {
                let (prior, after) = (at - 1, at + 2);
                let is_lit = w[prior].value.abs() > 3.0 * w[prior].error;
                let shines = w[after].value.abs() > 3.0 * w[after].error;
                let step = ratio(at, prior);
                let square = through.value * through.value;
                let across = ratio(after, prior);
                let nan = UNKNOWN;
                let weight = Measured {
                    value: step.value * own.value / through.value,
                    error: (step.error * own.value / through.value).abs()
                        + (step.value * own.value).abs() * (through.error + 8.0 * unit)
                        + (step.value * own.error).abs(),
                };
                let passes = Measured {
                    value: across.value / square,
                    error: across.error / square
                        + across.value.abs() * (2.0 * through.error + 8.0 * unit)
                        // 1 − α is known to a unit of 1.
                        + 2.0 * unit,
                };
                Point {
                    extinction,
                    length: reference.length,
                    ray,
                    weight: if is_lit { weight } else { nan },
                    passes: if is_lit && shines { passes } else { nan },
                }
            })
            .collect();
        points.push(Point {
            extinction: reference.extinction,
            length: reference.length,
            ray,
            weight: Measured {
                error: own.error + own.value.abs() * 8.0 * unit,
                ..own
            },
            passes: through,
        });
        points
    }

    /// An opacity by subtraction is off by a unit of 1, whatever its size; and so is a transmittance, where it is 1 less the
    /// opacity so far.
    fn add_rounding(&self, w: &mut [Measured], at: &[usize], own: f64) {
        let unit = self.answers.unit;
        let sizes: Vec<f64> = w.iter().map(|w| w.value.abs()).collect();
        for (k, w) in w.iter_mut().enumerate() {
            let reference = if at.contains(&k) { k - 1 } else { k };
            w.error += 2.0 * unit / DEPTH * sizes[reference];
            if self.subtracts {
                let transmittance = sizes[reference] / own;
                w.error += 4.0 * unit / transmittance * w.value.abs();
            }
        }
    }

    /// What a reference lets through: from all pairs of neighbours, each by what it is worth.
    fn through(&self, w: &[Measured], at: &[usize], lead: usize, count: usize) -> Measured {
        let mut pairs: Vec<(usize, usize)> = vec![(lead - 1, lead - 2)];
        if !self.samples.sequence.late {
            pairs.extend(at.iter().take(count).map(|at| (at + 2, at + 1)));
        }
        let (mut sum, mut worth) = (0.0, 0.0);
        for (far, near) in pairs {
            let (far, near) = (w[far], w[near]);
            let value = far.value / near.value;
            let error = far.error / near.value.abs() + (value * near.error / near.value).abs();
            let weight = 1.0 / (error + self.answers.unit).powi(2);
            if value > 0.0
                && weight.is_finite()
                && value.is_finite()
                && near.value > 3.0 * near.error
            {
                sum += value * weight;
                worth += weight;
            }
        }
        Measured {
            value: sum / worth,
            error: worth.sqrt().recip() + self.answers.unit,
        }
    }

    /// The weight of a reference behind nothing: from a ray of its own, so that a factor of the whole ray falls out; but
    /// from this ray where references let other parts through on rays of other lengths.
    fn own_of(
        &self,
        reference: &Reference,
        w: &[Measured],
        lead: usize,
        through: Measured,
    ) -> Measured {
        let alone = reference.through;
        let off = (through.value - alone.value).abs();
        let lost = (1.0 - alone.value).abs();
        let is_same = off.is_nan() || off <= 3.0 * (through.error + alone.error) + OTHER * lost;
        let is_plain = self.whole == Whole::One && lead == LEAD / 2;
        if is_same || !is_plain {
            return reference.own;
        }
        let steps = lead as f64 - 1.0;
        let value = w[lead - 1].value / through.value.powf(steps);
        let part = w[lead - 1].error / w[lead - 1].value.abs();
        Measured {
            value,
            error: value.abs() * (part + steps * through.error / through.value),
        }
    }

    /// The weight of a reference behind nothing, from a ray of nothing else.
    fn own(&self, w: &[Measured], n: usize) -> Measured {
        let sequence = &self.samples.sequence;
        let shift = match self.near_end() {
            End::Once => 0,
            End::Twice => 1,
            End::Missing => -1,
        };
        let through = w[3].value / w[2].value;
        let of_through = w[3].error / w[3].value.abs() + w[2].error / w[2].value.abs();
        // One too many stands in front of all at the back of segments.
        let is_behind = self.samples.place == Place::Back && sequence.extra.is_some();
        let steps = 2 + shift - i32::from(sequence.late) + i32::from(is_behind);
        let order = sequence.order(n, false, self.samples.place == Place::Back);
        let count = i32::try_from(order.len()).unwrap_or(i32::MAX);
        let end = through.powi(count);
        let factor = match self.whole {
            Whole::One => 1.0,
            Whole::ByOpacity => 1.0 - end,
            Whole::TimesOpacity => 1.0 / (1.0 - end),
        };
        let value = w[2].value / through.powi(steps) * factor;
        let of_factor = if self.whole == Whole::One {
            0.0
        } else {
            f64::from(count) * end / (1.0 - end) * of_through
        };
        let part = w[2].error / w[2].value.abs() + f64::from(steps) * of_through + of_factor;
        Measured {
            value,
            error: value.abs() * (part + 2.0 * self.answers.unit / DEPTH),
        }
    }
}
