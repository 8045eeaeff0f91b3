//! What renderers that sample as usual make of the rays of a ladder, where nothing is wrong.

use super::Wanted;
use crate::identify::rule::{Law, Place, Rule, Scheme};
use crate::kernel::Quantity;
use crate::kernel::Segments;
use crate::real::Native;
use crate::study::verify::nominal::{summed, terms};

/// One sample a segment.
pub(super) fn at(place: Place) -> Rule {
    Rule {
        scheme: Scheme::Sample {
            place,
            law: Law::default(),
        },
        ..Rule::default()
    }
}

/// A rule's radiance of one channel.
pub(super) fn radiance(rule: &Rule, segments: &Segments, step: f64, channel: usize) -> f64 {
    let format = Native::<f64>::new();
    let composed = rule.composed(segments, step, format);
    rule.radiance(&composed, segments, channel, format)
}

/// What samples in the middles of segments make of what is wanted; the segments are lit as it is.
pub(super) fn by_middles(wanted: &Wanted, segments: &Segments, step: f64, channel: usize) -> f64 {
    let rule = at(Place::Middle);
    match wanted.quantity {
        Quantity::OpticalDepth | Quantity::Emission => {
            summed(segments, Place::Middle, Native::<f64>::new())
        }
        Quantity::ExpectedDepth if wanted.is_divided() => {
            let format = Native::<f64>::new();
            let opacity = 1.0 - rule.composed(segments, step, format).passes;
            radiance(&rule, segments, step, channel) / opacity
        }
        Quantity::Radiance | Quantity::Opacity | Quantity::ExpectedDepth => {
            wanted.background + radiance(&rule, segments, step, channel)
        }
    }
}

/// ∫ |C| τ e^(−t), roughly, where C has both signs, so that terms cancel; `None` where it has one.
pub(super) fn cancelling(segments: &Segments, step: f64, channel: usize) -> Option<f64> {
    let emission = segments.middles.emission.get(channel)?;
    let has_both = emission.iter().any(|c| *c < 0.0) && emission.iter().any(|c| *c > 0.0);
    has_both.then(|| terms(&at(Place::Middle), segments, step, channel))
}
