//! Answers beside a rule's, up to rounding.

use super::OpacityCheck;
use crate::identify::rule::{Output, Rule, Whole};
use crate::identify::weights::Answers;
use crate::kernel::Segments;
use crate::real::Native;

/// The optical depth of thick rays.
pub(in crate::identify) const SLOPE: f64 = 40.0;

/// The part of what an answer is made of that its rounding may be, and the answer still decide.
const DECIDES: f64 = 1.0 / 4.0;

/// Compares the opacity that came with an answer with 1 − T, which it returns.
pub(in crate::identify) fn check_opacity(
    rule: &Rule,
    answers: &Answers,
    (segments, step): (&Segments, f64),
    got: f64,
    check: &mut OpacityCheck,
) -> f64 {
    let composed = rule.composed(segments, step, Native::<f64>::new());
    let n = segments.count() as f64;
    let quantum = rule.output.quantum.unwrap_or(0.0);
    // What segments let through may be followed to no more than a grain each.
    let allowed = (answers.unit * 8.0 + answers.grain) * n;
    let allowed = allowed + answers.unit * 64.0 + answers.noise + quantum;
    let want = 1.0 - composed.passes;
    let off = (got - want).abs();
    check.answered += 1;
    check.agree += usize::from(off <= allowed);
    // A difference that is no number is no small one.
    check.largest = if off.is_finite() {
        check.largest.max(off)
    } else {
        f64::INFINITY
    };
    want
}

/// A place that a kernel works out is off by rounding, and values there by as much times the medium's slope, which adds up
/// to a unit times the optical depth times n.
pub(in crate::identify) fn of_places(rule: &Rule, answers: &Answers) -> Answers {
    Answers {
        unit: answers.unit * if rule.lattice.is_some() { SLOPE } else { 1.0 },
        ..answers.clone()
    }
}

/// An answer beside the rule's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::identify) struct Compared {
    pub(in crate::identify) got: f64,
    pub(in crate::identify) want: f64,
    /// Whether they differ by no more than rounding.
    pub(in crate::identify) agrees: bool,
    /// Whether rounding may not be most of it: else that they agree says nothing.
    pub(in crate::identify) decides: bool,
    pub(in crate::identify) digits: f64,
}

/// Answers, in the order of the channels, beside the rule's.
pub(in crate::identify) fn compare(
    rule: &Rule,
    answers: &Answers,
    segments: &Segments,
    step: f64,
    got: &[f64],
) -> Vec<Compared> {
    let format = Native::<f64>::new();
    let composed = rule.composed(segments, step, format);
    let n = segments.count() as f64;
    let cancels = rule.cancels(segments);
    let of_channel = |(channel, &got): (usize, &f64)| {
        let x = rule.radiance(&composed, segments, channel, format);
        let values = |of: &[Vec<f64>]| {
            let own = of.get(channel).into_iter().flatten();
            own.map(|c| c.abs()).fold(0.0, f64::max)
        };
        let bright = values(&segments.edges.emission).max(values(&segments.middles.emission));
        // Every segment rounds a few times, its opacity by a unit of 1; opacities above 1 make terms alternate that are
        // larger than anything given.
        let terms = composed.sizes(segments, channel);
        let largest = (bright * rule.largest_scale()).max(terms);
        let size = x.abs() + composed.factor.abs() * largest;
        let slack = answers.unit * (16.0 + 4.0 * n) * size + answers.noise * size;
        let slack = slack + answers.grain * n * size;
        let slack = slack + answers.unit * 8.0 * bright * cancels;
        let slack = if rule.whole == Whole::ByOpacity {
            // 1 − T is known to a unit of 1.
            slack + answers.unit * 16.0 * x.abs() * composed.factor.abs()
        } else {
            slack
        };
        let exact = Output {
            quantum: None,
            ..rule.output
        };
        let (low, high) = (exact.of(x - slack), exact.of(x + slack));
        let want = rule.output.of(x);
        let quantum = rule.output.quantum.unwrap_or(0.0) * 1.01;
        let rounding = quantum + 4.0 * answers.unit * want.abs();
        let agrees =
            (got >= low - rounding && got <= high + rounding) || (got.is_nan() && want.is_nan());
        let miss = (got - want).abs() / want.abs().max(got.abs()).max(1e-300);
        Compared {
            got,
            want,
            agrees,
            decides: slack <= DECIDES * size,
            digits: if !got.is_finite() && want.is_finite() {
                0.0
            } else if miss > 0.0 {
                (-miss.log10()).clamp(0.0, 17.0)
            } else {
                17.0
            },
        }
    };
    got.iter().enumerate().map(of_channel).collect()
}
