//! Functions of intervals that are as good as one number: taken once, at the lower bound, and widened by what they can
//! change over the rest. At both bounds they would cost twice as much.

use crate::symbolic::Interval;
use rug::Float;
use rug::float::Round;

/// The lower bound and the width of an interval of `bits` that is shorter than 2^(−bits/2).
fn narrow(x: &Interval) -> Option<(&Float, Float)> {
    let width = Float::with_val_round(64, x.upper() - x.lower(), Round::Up).0;
    let short = Float::with_val(64, 1) >> (x.bits() / 2);
    (x.lower().is_finite() && width < short).then_some((x.lower(), width))
}

/// One unit of rounding of numbers with so many bits, and more.
fn unit(bits: u32) -> Float {
    Float::with_val(64, 4) >> bits
}

fn up(x: &Float, y: &Float) -> Float {
    Float::with_val_round(64, x + y, Round::Up).0
}

/// value ± off.
fn around(value: &Float, off: &Float) -> Interval {
    let bits = value.prec();
    let lower = Float::with_val_round(bits, value - off, Round::Down).0;
    let upper = Float::with_val_round(bits, value + off, Round::Up).0;
    Interval::exactly(&lower).union(&Interval::exactly(&upper))
}

/// e^x with e^(l + w) = e^l e^w and e^w ≤ 1 + 2w for w ≤ 1.
pub(super) fn exp(x: &Interval) -> Option<Interval> {
    let bits = x.bits();
    let (lower, width) = narrow(x)?;
    let value = Float::with_val_round(bits, lower.exp_ref(), Round::Down).0;
    if value.is_zero() || !value.is_finite() {
        return None;
    }
    // Rounded down, the value is less than a unit off, which the unit here covers four times.
    let part = up(&(width << 1_u32), &unit(bits));
    let off = Float::with_val_round(64, &value * &part, Round::Up).0;
    let upper = Float::with_val_round(bits, &value + &off, Round::Up).0;
    Some(Interval::exactly(&value).union(&Interval::exactly(&upper)))
}

/// Both, which change by no more than x does.
pub(super) fn sin_cos(x: &Interval) -> Option<(Interval, Interval)> {
    let bits = x.bits();
    let (lower, width) = narrow(x)?;
    let (sin, cos) = lower.clone().sin_cos(Float::new(bits));
    let wide = |value: &Float| {
        let rounding = Float::with_val_round(64, value * unit(bits), Round::AwayZero)
            .0
            .abs();
        around(value, &up(&rounding, &width))
    };
    Some((wide(&sin), wide(&cos)))
}
