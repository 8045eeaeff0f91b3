//! What single segments add and let through, between references.

use crate::identify::NotIdentified;
use crate::identify::influence::layers_at;
use crate::identify::places::Samples;
use crate::identify::rule::{End, Place, Whole};
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
    /// The weight of the second sample of a ray of references alone.
    second: f64,
}

/// How samples are measured.
#[derive(Clone, Debug)]
pub(in crate::identify) struct Measurer<'a> {
    pub(in crate::identify) answers: &'a Answers,
    pub(in crate::identify) samples: &'a Samples,
    pub(in crate::identify) whole: Whole,
}

/// The depth of references.
const DEPTH: f64 = 1.0 / 32.0;
/// References before the first extinction where all is in order; and where the first samples are not.
const LEAD: usize = 6;
/// References behind the last one.
const TAIL: usize = 3;

impl Measurer<'_> {
    /// The weights of the n samples in the order in which the kernel takes them, and the answer without emission.
    pub(in crate::identify) fn weights(
        &self,
        session: &mut Session<'_>,
        taus: &[f64],
        length: f64,
    ) -> Result<Vec<Measured>, NotIdentified> {
        let n = taus.len();
        let place = self.samples.place;
        let extra = self.samples.sequence.extra.is_some();
        let swapped = self.samples.sequence.swapped;
        let mut along = taus.to_vec();
        if swapped {
            along.reverse();
        }
        let layers = layers_at(place, length, &along, &along);
        let nodes = nodes_of(place, n, extra);
        let found = weights(session, self.answers, &layers, &nodes, &[])?;
        let mut of = found.of;
        if extra {
            if place == Place::Back {
                of.remove(0);
            } else {
                of.truncate(n);
            }
        }
        if swapped {
            of.reverse();
        }
        // What stands beside much that is no emission's is known no better.
        let beside = 16.0 * self.answers.unit * found.zero.value.abs();
        for w in &mut of {
            w.error += beside;
        }
        Ok(of)
    }

    /// n rounded up to what the kernel takes whole.
    pub(in crate::identify) fn suitable(&self, session: &Session<'_>, n: usize) -> usize {
        let unrolled = usize::try_from(self.samples.sequence.unrolled).unwrap_or(1);
        n.next_multiple_of(unrolled.max(1))
            .next_multiple_of(session.multiple)
    }

    /// Samples at the near end that do not count once.
    fn near_end(&self) -> End {
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
            second: 0.0,
        };
        let mut before: Option<(f64, f64)> = None;
        for _ in 0..10 {
            let n = self.suitable(session, 9);
            let w = self.weights(session, &vec![extinction; n], length)?;
            found.extinction = extinction;
            found.second = w[1].value;
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
        let sequence = &self.samples.sequence;
        let plain = !sequence.late && sequence.first == End::Once && sequence.last == End::Once;
        let lead = if plain { LEAD / 2 } else { LEAD };
        let count = extinctions.len();
        let n = self.suitable(session, lead + TAIL + 3 * count);
        let mut taus = vec![reference.extinction; n];
        let at: Vec<usize> = (0..count).map(|k| lead + 3 * k).collect();
        for (place, tau) in at.iter().zip(extinctions) {
            taus[*place] = *tau;
        }
        let mut w = self.weights(session, &taus, reference.length)?;
        self.add_rounding(&mut w, &at);
        let ratio = |k: usize, by: usize| {
            let (one, other) = (w[k], w[by]);
            let value = one.value / other.value;
            let error = one.error / other.value.abs() + (value * other.error / other.value).abs();
            Measured { value, error }
        };
        let through = self.through(&w, &at, lead, count);
        let near = lead - 2;
        let shift = match self.near_end() {
            End::Once => 0,
            End::Twice => 1,
            End::Missing => -1,
        };
        let steps = i32::try_from(near).unwrap_or(0) + shift - i32::from(sequence.late);
        let mut own = Measured {
            value: w[near].value / through.value.powi(steps),
            error: w[near].error,
        };
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
                let nan = Measured {
                    value: f64::NAN,
                    error: f64::INFINITY,
                };
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
        let factor = self.factor(&w, &points, through.value, n, reference);
        if factor.is_finite() && factor > 0.0 {
            for point in &mut points {
                point.weight.value *= factor;
                point.weight.error *= factor;
            }
            own.value *= factor;
            own.error *= factor;
        }
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
        Ok(points)
    }

    /// An opacity by subtraction is off by a unit of 1, whatever its size.
    fn add_rounding(&self, w: &mut [Measured], at: &[usize]) {
        let of_opacity = 2.0 * self.answers.unit / DEPTH;
        let sizes: Vec<f64> = w.iter().map(|w| w.value.abs()).collect();
        for (k, w) in w.iter_mut().enumerate() {
            let reference = if at.contains(&k) { k - 1 } else { k };
            w.error += of_opacity * sizes[reference];
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

    /// What undoes a factor of the whole ray.
    fn factor(
        &self,
        w: &[Measured],
        points: &[Point],
        through: f64,
        n: usize,
        reference: &Reference,
    ) -> f64 {
        let back = self.samples.place == Place::Back;
        let order = self.samples.sequence.order(n, false, back);
        let ended = w.last().is_some_and(|w| w.value.abs() <= 3.0 * w.error);
        match self.whole {
            Whole::One if ended && self.samples.sequence.last != End::Missing => {
                // Rays that end early may be divided by the opacity reached.
                let factor = reference.second / w[1].value;
                if (factor - 1.0).abs() > 1e-9 + 64.0 * self.answers.unit {
                    factor
                } else {
                    1.0
                }
            }
            Whole::One => 1.0,
            Whole::ByOpacity | Whole::TimesOpacity => {
                let passes = points.iter().map(|p| p.passes.value);
                let passes = passes.filter(|p| p.is_finite()).product::<f64>();
                let references = order.len().saturating_sub(points.len());
                let exponent = i32::try_from(references).unwrap_or(i32::MAX);
                let end = passes * through.powi(exponent);
                if self.whole == Whole::ByOpacity {
                    1.0 - end
                } else {
                    1.0 / (1.0 - end)
                }
            }
        }
    }
}
