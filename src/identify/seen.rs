//! A rule against rays that a kernel was asked for another reason, as the levels of a ladder: a hold-out at no cost.

use super::holdout::{Compared, compare, of_places};
use super::pose::Steps;
use super::rule::{Rule, Scheme, Segment};
use super::weights::Answers;
use super::{Identification, State};
use crate::kernel::{Medium, Samples, Segments};

/// A ray that a kernel has answered.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The medium, of a kernel that evaluates it itself.
    pub medium: Option<&'a dyn Medium>,
    /// As it was cut.
    pub segments: &'a Segments,
    /// d.
    pub step: f64,
    /// Of all channels, where they stand.
    pub answers: &'a [f64],
}

/// A place that a kernel works out is off by so many units of the ray's length.
const OFF: f64 = 4.0;
/// Ladders are longer than probes: an exponential that is off by a few units always the same way adds up.
const ADDS_UP: f64 = 4.0;
/// Segments so deep no two integrate alike that integrate numerically.
const DEEP: f64 = 8.0;

impl Identification {
    /// Whether the rule that is named answers a ray as the kernel has, channel by channel; answers that are not finite
    /// are nobody's. `None` where no rule is named, where it reads volumes, where answers depend on more than rays, or where the
    /// rule has no value that others have, too.
    #[must_use]
    pub fn agrees(&self, seen: &Seen<'_>) -> Option<Vec<bool>> {
        let rule = self.named()?;
        let is_plain = self.state.as_ref().is_none_or(|s| *s == State::default());
        if self.optics.is_some() || !is_plain {
            return None;
        }
        let known = Answers {
            unit: ADDS_UP * self.parts.unit?,
            noise: self.parts.noise,
            grain: self.parts.grain,
            ..Answers::default()
        };
        if is_too_deep(rule, seen.segments) {
            return None;
        }
        let known = of_places(rule, &known);
        let count = seen.answers.len();
        let own = |k: usize| {
            let place = rule.channels.place(k, count);
            seen.answers.get(place).copied().unwrap_or(f64::NAN)
        };
        let got: Vec<f64> = (0..count).map(own).collect();
        let compared = |off: f64| {
            let (segments, step) = looked_at(rule, seen, off);
            compare(rule, &known, &segments, step, &got)
        };
        let mut all = vec![compared(0.0)];
        let agree = |all: &[Vec<Compared>], k: usize| {
            let of_channel = || all.iter().filter_map(|one| one.get(k));
            let wants = of_channel().map(|one| one.want);
            let (low, high) = wants.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| {
                (low.min(y), high.max(y))
            });
            let is_between = got.get(k).is_none_or(|y| low <= *y && *y <= high);
            is_between || of_channel().any(|one| one.agrees || !one.got.is_finite())
        };
        // Where the medium jumps, or is steep, it is rounding that decides on which side a sample lies.
        if seen.medium.is_some() && !(0..count).all(|k| agree(&all, k)) {
            let off = OFF * known.unit;
            all.extend([compared(-off), compared(off)]);
        }
        Some((0..count).map(|k| agree(&all, k)).collect())
    }
}

/// Whether a segment is too deep for the integral of linear media to be told.
fn is_too_deep(rule: &Rule, segments: &Segments) -> bool {
    let is_integrated = matches!(
        rule.scheme,
        Scheme::Segments {
            weights: Segment::Linear,
            ..
        }
    );
    let pairs = segments.edges.extinction.windows(2);
    let mut depths = pairs
        .zip(segments.lengths())
        .map(|(ends, length)| ends.iter().sum::<f64>() / 2.0 * length);
    is_integrated && depths.any(|depth| depth > DEEP)
}

/// The segments and the step that a rule is to be applied to, all places by so large a part of the ray farther back.
fn looked_at(rule: &Rule, seen: &Seen<'_>, off: f64) -> (Segments, f64) {
    let given = seen.segments;
    let length = given.edges.lambda.last().copied().unwrap_or(0.0);
    let Some(medium) = seen.medium else {
        return (given.clone(), seen.step);
    };
    let at = |lambda: f64, emission: &mut [f64]| {
        medium.at((lambda + off * length).clamp(0.0, length), emission)
    };
    if let Some(lattice) = &rule.lattice {
        let steps = Steps {
            length,
            step: seen.step,
            segments: given.count(),
        };
        return lattice.cut(&steps, at, seen.answers.len());
    }
    if off.abs() > 0.0 {
        let moved = |samples: &Samples| {
            let mut moved = samples.clone();
            let mut emission = vec![0.0; moved.emission.len()];
            for (k, lambda) in samples.lambda.iter().enumerate() {
                moved.extinction[k] = at(*lambda, &mut emission);
                for (all, one) in moved.emission.iter_mut().zip(&emission) {
                    all[k] = *one;
                }
            }
            moved
        };
        let segments = Segments {
            edges: moved(&given.edges),
            middles: moved(&given.middles),
        };
        return (segments, seen.step);
    }
    (given.clone(), seen.step)
}
