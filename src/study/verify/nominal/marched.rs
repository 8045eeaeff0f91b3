//! Compositing of one sample a segment by the formula of opacity that a method names: its rule, and its rounding.

use crate::identify::rule::{Law, Place, Rule, Scheme, Wall};
use crate::kernel::Segments;
use crate::method::OpacityFormula;
use crate::real::{Format, Real};

/// The length that renderers give the last segment to make a wall of it: what absorbs nothing stays clear.
const WALL_LENGTH: i64 = 10_000_000_000;

/// I ← I + T α C, T ← T e^(−x), front to back until T is under the threshold; `None` of a rule with another law.
pub(super) fn marched<F: Format>(
    rule: &Rule,
    formula: OpacityFormula,
    segments: &Segments,
    channel: usize,
    format: F,
) -> Option<F::Real> {
    let Scheme::Sample { place, law } = &rule.scheme else {
        return None;
    };
    if *law != Law::default() {
        return None;
    }
    let under = rule.stop.map(|stop| format.binary64(stop.under));
    let (mut radiance, mut passes) = (format.int(0), format.int(1));
    let n = segments.count();
    for (index, length) in segments.lengths().enumerate() {
        let (extinction, emission) = sample(segments, *place, index, channel)?;
        let length = if index + 1 == n && rule.wall == Some(Wall::Opaque) {
            format.int(WALL_LENGTH)
        } else {
            format.binary64(length)
        };
        let depth = format.binary64(extinction) * &length;
        let light = format.binary64(emission) * &formula.of(&depth);
        radiance += &(light * &passes);
        passes *= &(-depth).exp();
        if under.as_ref().is_some_and(|under| passes < *under) {
            break;
        }
    }
    Some(radiance)
}

/// τ and C of a segment.
fn sample(segments: &Segments, place: Place, index: usize, channel: usize) -> Option<(f64, f64)> {
    let (samples, at) = match place {
        Place::Front => (&segments.edges, index),
        Place::Middle => (&segments.middles, index),
        Place::Back => (&segments.edges, index + 1),
    };
    let emission = samples.emission.get(channel)?;
    Some((*samples.extinction.get(at)?, *emission.get(at)?))
}
