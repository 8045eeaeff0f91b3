//! Samples that lie elsewhere than at the ends and middles of segments.

use super::Rule;
use crate::identify::pose::{Steps, at, plain};
use crate::identify::ray::Ray;
use crate::kernel::{Samples, Segments};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;

/// Where a kernel samples that looks wherever it likes: λₖ of the samples k = 0, 1, …, N − 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Lattice {
    /// λₖ = (k + a) d, N = n.
    Steps {
        /// a.
        place: f64,
        /// A shorter last segment is sampled at the part a of its own length, and otherwise at a d from its beginning, or
        /// at D where that lies behind the ray.
        own_last: bool,
    },
    /// λₖ = A + (k + a) (B − A)/N: N parts of the same length between A and B.
    Even {
        /// a.
        place: f64,
        /// A.
        start: Along,
        /// B.
        end: Along,
        /// N.
        count: Count,
    },
}

/// p D + ℓ.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Along {
    /// p.
    pub part: f64,
    /// ℓ.
    pub length: f64,
}

impl Along {
    /// On a ray of length D.
    #[must_use]
    pub fn on(self, ray: f64) -> f64 {
        self.part * ray + self.length
    }
}

/// N = q n + c.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Count {
    /// q, samples a segment; 0 where their number does not depend on the step.
    pub each: u64,
    /// c.
    pub more: i64,
}

impl Count {
    /// N of n segments.
    #[must_use]
    pub fn of(self, segments: usize) -> usize {
        let each = i64::try_from(self.each).unwrap_or(i64::MAX);
        let n = i64::try_from(segments).unwrap_or(i64::MAX);
        let count = each.saturating_mul(n).saturating_add(self.more);
        usize::try_from(count).unwrap_or(0)
    }

    /// The least n with that many samples or more.
    fn least(self, samples: usize) -> Option<usize> {
        if self.each == 0 {
            return (self.of(1) >= samples).then_some(1);
        }
        let samples = i64::try_from(samples).ok()?;
        let each = i64::try_from(self.each).ok()?;
        let n = (samples - self.more).max(1);
        usize::try_from((n + each - 1) / each).ok()
    }
}

impl Lattice {
    /// λₖ = (k + a) D/n.
    #[must_use]
    pub fn even(place: f64) -> Self {
        Lattice::Even {
            place,
            start: Along::default(),
            end: Along {
                part: 1.0,
                length: 0.0,
            },
            count: Count { each: 1, more: 0 },
        }
    }

    /// Samples at the same part of their segments, of which as many as there are segments, or a multiple, cover the ray.
    pub(in crate::identify) fn covering(self) -> Self {
        match self {
            Lattice::Even { place, count, .. } => Lattice::Even {
                place,
                start: Along::default(),
                end: Along {
                    part: 1.0,
                    length: 0.0,
                },
                count: Count {
                    each: count.each.max(1),
                    more: if count.each == 0 { 0 } else { count.more },
                },
            },
            steps @ Lattice::Steps { .. } => steps,
        }
    }

    /// The places of the samples, and how far it is from each to the next, or what its segment's length is.
    #[must_use]
    pub(in crate::identify) fn places(&self, steps: &Steps) -> (Vec<f64>, Vec<f64>) {
        let n = steps.segments;
        match *self {
            Lattice::Steps { place, own_last } => {
                let d = steps.step;
                let of = |k: usize| {
                    let from = k as f64 * d;
                    let own = (steps.length - from).min(d);
                    let long = if own_last { own } else { d };
                    let to = from + place * long;
                    (if k + 1 == n { to.min(steps.length) } else { to }, own)
                };
                (0..n).map(of).unzip()
            }
            Lattice::Even {
                place,
                start,
                end,
                count,
            } => {
                let count = count.of(n);
                let (from, to) = (start.on(steps.length), end.on(steps.length));
                let h = (to - from) / count as f64;
                let of = |k: usize| (from + (k as f64 + place) * h, h);
                (0..count).map(of).unzip()
            }
        }
    }

    /// A ray with samples that are as far apart as the segments of the one given, at least so many.
    pub(in crate::identify) fn around(&self, ray: &Steps, samples: usize) -> Option<Steps> {
        match *self {
            Lattice::Steps { .. } => Some(*ray),
            Lattice::Even {
                start, end, count, ..
            } => {
                let segments = count.least(samples)?;
                let between = count.of(segments) as f64 * ray.step;
                let length = (between - (end.length - start.length)) / (end.part - start.part);
                let is_ray = length.is_finite() && length > 0.0;
                is_ray.then_some(Steps {
                    length,
                    step: length / segments as f64,
                    segments,
                })
            }
        }
    }

    /// The ray as such a kernel cuts it: a sample stands in the middle of each segment, and the ends hold nothing.
    pub(in crate::identify) fn cut(
        &self,
        steps: &Steps,
        at: impl Fn(f64, &mut [f64]) -> f64,
        channels: usize,
    ) -> (Segments, f64) {
        let (lambda, lengths) = self.places(steps);
        let mut middles = Samples {
            emission: vec![Vec::new(); channels],
            ..Samples::default()
        };
        let mut emission = vec![0.0; channels];
        for place in &lambda {
            middles.extinction.push(at(*place, &mut emission));
            for (all, one) in middles.emission.iter_mut().zip(&emission) {
                all.push(*one);
            }
        }
        middles.lambda = lambda;
        let step = match self {
            Lattice::Steps { .. } => steps.step,
            Lattice::Even { .. } => lengths.first().copied().unwrap_or(steps.step),
        };
        let n = lengths.len();
        let mut edges: Vec<f64> = (0..n).map(|k| k as f64 * step).collect();
        // The last one by its own length, as the ray has it.
        edges.push(match self {
            Lattice::Steps { .. } => steps.length,
            Lattice::Even { .. } => n as f64 * step,
        });
        let edges = Samples {
            extinction: vec![0.0; edges.len()],
            emission: vec![vec![0.0; edges.len()]; channels],
            lambda: edges,
        };
        (Segments { edges, middles }, step)
    }
}

impl Rule {
    /// The segments and the step that the rule is to be applied to, of a ray: its own, or those between which the samples
    /// of the lattice lie.
    #[must_use]
    pub fn cut<'r>(&self, ray: &'r Ray) -> (Cow<'r, Segments>, f64) {
        let Some(lattice) = &self.lattice else {
            return (Cow::Borrowed(&ray.segments), ray.step());
        };
        let knots = plain(ray);
        let at = |lambda: f64, emission: &mut [f64]| at(&knots, lambda, emission);
        let channels = ray.segments.edges.emission.len();
        let (segments, step) = lattice.cut(&Steps::of(ray), at, channels);
        (Cow::Owned(segments), step)
    }
}

/// x as a term behind another.
pub(in crate::identify) fn plus(f: &mut fmt::Formatter<'_>, x: f64) -> fmt::Result {
    if x > 0.0 {
        write!(f, " + {x}")
    } else if x < 0.0 {
        write!(f, " − {}", -x)
    } else {
        Ok(())
    }
}

/// Whether they are the same number.
fn is(x: f64, y: f64) -> bool {
    (x - y).abs() <= 0.0
}

impl fmt::Display for Along {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Along { part, length } = *self;
        if is(part, 0.0) {
            return write!(f, "{length}");
        }
        if is(part, 1.0) {
            f.write_str("D")?;
        } else {
            write!(f, "{part} D")?;
        }
        plus(f, length)
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.each, self.more) {
            (0, more) => return write!(f, "{more}"),
            (1, _) => f.write_str("n")?,
            (each, _) => write!(f, "{each} n")?,
        }
        match self.more {
            0 => Ok(()),
            more if more > 0 => write!(f, " + {more}"),
            more => write!(f, " − {}", more.unsigned_abs()),
        }
    }
}

/// As a formula.
impl fmt::Display for Lattice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sample = |f: &mut fmt::Formatter<'_>, place: f64| {
            if is(place, 0.0) {
                return f.write_str("k");
            }
            f.write_str("(k")?;
            plus(f, place)?;
            f.write_str(")")
        };
        match *self {
            Lattice::Steps { place, own_last } => {
                f.write_str("λₖ = ")?;
                sample(f, place)?;
                f.write_str(" d")?;
                f.write_str(if own_last {
                    ", in a shorter last segment at the same part of its own length"
                } else {
                    ", at most D"
                })
            }
            Lattice::Even {
                place,
                start,
                end,
                count,
            } => {
                f.write_str("λₖ = ")?;
                if start != Along::default() {
                    write!(f, "{start} + ")?;
                }
                sample(f, place)?;
                f.write_str(" h, ")?;
                match start == Along::default() {
                    true if is(end.length, 0.0) => write!(f, "h = {end}/")?,
                    true => write!(f, "h = ({end})/")?,
                    false => write!(f, "h = ({end} − ({start}))/")?,
                }
                if count.each > 0 && count.more != 0 || count.each > 1 {
                    write!(f, "({count})")
                } else {
                    write!(f, "{count}")
                }
            }
        }
    }
}
