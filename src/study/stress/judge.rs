//! What is said of a run, from what befell its numbers.

use super::cell::Digits;
use super::exact::Exact;
use super::promise::Promise;
use super::range::Rounding;
use super::verdict::Verdict;
use super::watched::Events;
use rug::Float;

/// A run in a watched format.
#[derive(Clone, Debug)]
pub(super) struct Ran {
    /// `Q_f`, not finite where it is not.
    pub(super) radiance: Float,
    /// What befell it.
    pub(super) events: Events,
    /// What was added and changed nothing, relative to `Q_f`, at most.
    pub(super) lost: f64,
    /// What befell C, τ and τ d.
    pub(super) of_inputs: Events,
    /// The largest τ d.
    pub(super) thickest: Float,
    /// C or τ below 0 somewhere.
    pub(super) negative_medium: bool,
    /// Opacities are τ d and make the transmittance.
    pub(super) linear: bool,
    /// A sample may lie on another side of a jump.
    pub(super) diverged: bool,
}

/// `|Q_f − Q|/|Q|`; `None` where one is no number, or Q alone is 0.
pub(in crate::study) fn relative_error(found: &Float, exact: &Float) -> Option<f64> {
    if !found.is_finite() || !exact.is_finite() {
        return None;
    }
    // Exact: both are binary fractions of far fewer bits.
    let difference = Float::with_val(4096, found - exact);
    if difference.is_zero() {
        return Some(0.0);
    }
    if exact.is_zero() {
        return None;
    }
    Some((difference / exact).abs().to_f64())
}

/// Correct digits of that relative error.
pub(in crate::study) fn digits(error: f64) -> Digits {
    if error == 0.0 {
        Digits::Exact
    } else {
        Digits::Of(Promise::digits(error))
    }
}

/// How far roundoff strays in n operations where its signs are random (Higham and Mary 2019), with room; half of
/// the value at most.
fn stray(n: u64, rounding: &Rounding) -> f64 {
    let unit = if rounding.is_absolute() {
        rounding.log2_quantum.exp2()
    } else {
        rounding.unit
    };
    (8.0 * (n as f64).sqrt() * unit).min(0.5)
}

/// The verdict, `None` where digits speak for themselves.
pub(super) fn verdict(
    ran: &Ran,
    exact: &Exact,
    promise: &Promise,
    rounding: &Rounding,
    n: u64,
) -> Option<Verdict> {
    of_range(ran.of_inputs)
        .or_else(|| of_linear_opacities(ran))
        .or_else(|| of_range(ran.events))
        .or_else(|| of_signs(ran))
        .or_else(|| exact.underflows.then_some(Verdict::OracleUnderflow))
        .or_else(|| ran.diverged.then_some(Verdict::BranchDiverged))
        .or_else(|| of_small_numbers(ran, exact, promise, rounding, n))
}

/// Beyond the format's ends.
fn of_range(events: Events) -> Option<Verdict> {
    [
        (Events::INVALID, Verdict::NotANumber),
        (Events::INFINITE, Verdict::Infinite),
        (Events::OVERFLOW, Verdict::Overflow),
        (Events::SATURATED, Verdict::Saturated),
    ]
    .into_iter()
    .find_map(|(event, verdict)| events.has(event).then_some(verdict))
}

fn of_linear_opacities(ran: &Ran) -> Option<Verdict> {
    if !ran.linear {
        return None;
    }
    if ran.thickest > 2 {
        Some(Verdict::Oscillating)
    } else if ran.thickest > 1 {
        Some(Verdict::NegativeTransmittance)
    } else {
        None
    }
}

fn of_signs(ran: &Ran) -> Option<Verdict> {
    if ran.radiance.is_nan() {
        return Some(Verdict::NotANumber);
    }
    if ran.radiance < 0 {
        return Some(Verdict::NegativeRadiance);
    }
    ran.negative_medium.then_some(Verdict::NegativeMedium)
}

fn of_small_numbers(
    ran: &Ran,
    exact: &Exact,
    promise: &Promise,
    rounding: &Rounding,
    n: u64,
) -> Option<Verdict> {
    let error = relative_error(&ran.radiance, &exact.approximation);
    if error == Some(0.0) {
        return None;
    }
    let error = error.unwrap_or(f64::INFINITY);
    let stray = stray(n, rounding);
    if ran.events.has(Events::VANISHED) && error > stray {
        return Some(Verdict::Absorbed);
    }
    // What a constant has lost is lost to all n segments.
    let inputs = ran.of_inputs | ran.events;
    let of_inputs = inputs.has(Events::INPUT_UNDERFLOW) && error > stray;
    let matters = if rounding.is_absolute() {
        error >= 0.5
    } else {
        promise.underflow > promise.roundoff.min(1.0)
    };
    if of_inputs || (inputs.has(Events::UNDERFLOW) && matters) {
        return Some(Verdict::Underflow);
    }
    // What Neumaier's sum loses it finds again.
    let shows = error > stray && error > ran.lost / 16.0;
    (ran.lost > stray && shows).then_some(Verdict::Stalled)
}
