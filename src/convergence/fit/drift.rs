//! How far pairwise orders still have to go: what is left of a drift.
//!
//! With e = c·dᵖ(1 + g·d^q + …) the order of a pair of levels is p + g·s(q), where s(q) is the mean slope of d^q between them, and
//! two drifts (differences of neighbouring orders) tell q by their ratio, which for a constant ratio r of steps is r^q.
//! What is left of the last drift δ is then δ/(r^q − 1).

/// Where the next power lies nearer than this to the order, nothing at hand tells it from a logarithm.
const SLOW: f64 = 0.4;
/// The nearest that a next power counts for in a half-width, however much further away it seems.
const NEAREST: f64 = 0.25;
/// As much for orders that have just turned round: then the last drift is small because it passes through 0.
const NEAREST_AT_A_TURN: f64 = 0.05;
/// q is followed this many times its last change: with a logarithm it keeps falling.
const TREND: f64 = 2.0;
/// A q that rises by more than this from drift to drift belongs to orders about to turn round.
const RISE: f64 = 0.15;
/// A q this many times what it is now belonged to a term that is gone.
const OTHER_TERM: f64 = 3.0;
/// Two drifts smaller than this may be noise nobody has told of: it takes three to see a direction.
const SIZEABLE: f64 = 0.002;
/// q is looked for between these.
const POWERS: (f64, f64) = (0.01, 16.0);

/// The order of a pair of levels, and where it was measured.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local {
    /// The pairwise order.
    pub(super) order: f64,
    /// What floors and rounding may make of it.
    pub(super) noise: f64,
    /// log₂ of the coarser step.
    pub(super) coarse: f64,
    /// log₂ of the finer step.
    pub(super) fine: f64,
}

/// What pairwise orders do at the fine end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Drift {
    /// They go on to an order, which may be off by the width.
    Settling { order: f64, width: f64 },
    /// They go nowhere in particular: the last one may be off by the width.
    Still { width: f64 },
    /// They go on so slowly that where to is open: the next power lies `next` away, or it is a logarithm.
    Slow { next: f64 },
    /// They move away faster and faster.
    Growing,
}

/// Of pairwise orders, coarse to fine; `None` for fewer than three.
pub(super) fn drift(locals: &[Local]) -> Option<Drift> {
    let [coarser @ .., a, b, c] = locals else {
        return None;
    };
    let last = [*a, *b, *c];
    let drifts: Vec<f64> = locals
        .windows(2)
        .map(|pair| pair[0].order - pair[1].order)
        .collect();
    let (before, fine) = (a.order - b.order, b.order - c.order);
    let noise = (a.noise + b.noise, b.noise + c.noise);
    if before.abs() <= noise.0 || fine.abs() <= noise.1 {
        return Some(hidden(locals, &last));
    }
    if before * fine < 0.0 {
        return Some(unsteady(&last, &drifts));
    }
    let lowest = (before.abs() - noise.0) / (fine.abs() + noise.1);
    let highest = (before.abs() + noise.0) / (fine.abs() - noise.1);
    let sizeable = before.abs().max(fine.abs()) > SIZEABLE;
    if highest < ratio_of_drifts(&last, POWERS.0) && (sizeable || grows(&drifts)) {
        return Some(Drift::Growing);
    }
    let power = power(&last, before / fine);
    let change = match coarser.last() {
        None => 0.0,
        Some(d) if (d.order - a.order) * before <= 0.0 => return Some(unsteady(&last, &drifts)),
        Some(d) => match self::power(&[*d, *a, *b], (d.order - a.order) / before) {
            // What died out by then was another term.
            other if other > OTHER_TERM * power => 0.0,
            earlier => power - earlier,
        },
    };
    if change > RISE {
        return Some(turned(&last, &drifts));
    }
    if self::power(&last, lowest) + TREND * change >= SLOW {
        let left = fine * left_of_drift(&last, power.max(NEAREST));
        let width = left_of_drift(&last, NEAREST) * (fine.abs() + noise.1);
        let order = c.order - left;
        return Some(Drift::Settling { order, width });
    }
    if self::power(&last, highest) + TREND * change < SLOW && (sizeable || creeps(&last, &drifts)) {
        return Some(Drift::Slow { next: power });
    }
    Some(turned(&last, &drifts))
}

/// At least one of the last two drifts is no more than noise.
fn hidden(locals: &[Local], last: &[Local; 3]) -> Drift {
    let ratio = (last[2].coarse - last[2].fine).exp2();
    let left = left_of_drift(last, NEAREST);
    let finest = locals.windows(2).rev().take(2).enumerate();
    let widths = finest.map(|(age, pair)| {
        let size = (pair[0].order - pair[1].order).abs();
        // Three orders are too few to tell noise from a drift.
        if locals.len() > 3 && size <= pair[0].noise + pair[1].noise {
            size
        } else {
            left * size / ratio.powf(0.5 * age as f64)
        }
    });
    Drift::Still {
        width: widths.fold(0.0, f64::max),
    }
}

/// Drifts of both signs: orders that jitter, or that have turned round once.
fn unsteady(last: &[Local; 3], drifts: &[f64]) -> Drift {
    let finest = &drifts[drifts.len().saturating_sub(4)..];
    let turns = finest.windows(2).filter(|pair| pair[0] * pair[1] < 0.0);
    if turns.count() < 2 {
        return turned(last, drifts);
    }
    let sizes = drifts.iter().rev().take(2).map(|drift| drift.abs());
    Drift::Still {
        width: 2.0 * sizes.fold(0.0, f64::max),
    }
}

/// Orders that turn round have drifts that are small for a while, and far to go.
fn turned(last: &[Local; 3], drifts: &[f64]) -> Drift {
    let ratio = (last[2].coarse - last[2].fine).exp2();
    let sizes = drifts.iter().rev().map(|drift| drift.abs());
    let scaled = sizes
        .zip([1.0, 1.0, ratio.sqrt()])
        .map(|(size, by)| size / by);
    Drift::Still {
        width: left_of_drift(last, NEAREST_AT_A_TURN) * scaled.fold(0.0, f64::max),
    }
}

/// Three drifts that grow alike.
fn grows(drifts: &[f64]) -> bool {
    let [.., a, b, c] = drifts else { return false };
    let (first, second) = (b / a, c / b);
    first > 1.0 && second > 1.0 && first < 2.0 * second && second < 2.0 * first
}

/// Three drifts that shrink alike, and slowly.
fn creeps(last: &[Local; 3], drifts: &[f64]) -> bool {
    let [.., a, b, c] = drifts else { return false };
    let (first, second) = (a / b, b / c);
    let slow = 0.9..ratio_of_drifts(last, SLOW);
    slow.contains(&first) && slow.contains(&second) && (first / second).ln().abs() < 0.15
}

/// Mean slope of d^q between the two levels of a pair, with d in units of the step 2^unit.
fn slope(local: &Local, q: f64, unit: f64) -> f64 {
    let at = |x: f64| (q * (x - unit)).exp2();
    (at(local.coarse) - at(local.fine)) / (local.coarse - local.fine)
}

/// The first drift of three orders over the second, where the next power is q away.
fn ratio_of_drifts(orders: &[Local; 3], q: f64) -> f64 {
    let [a, b, c] = orders
        .each_ref()
        .map(|local| slope(local, q, orders[2].fine));
    (a - b) / (b - c)
}

/// What the last of three orders has to go, over the second drift: 1/(r^q − 1) where r is constant.
fn left_of_drift(orders: &[Local; 3], q: f64) -> f64 {
    let [_, b, c] = orders
        .each_ref()
        .map(|local| slope(local, q, orders[2].fine));
    c / (b - c)
}

/// q from the ratio of two drifts; 0 where they do not shrink.
fn power(orders: &[Local; 3], ratio: f64) -> f64 {
    let (mut low, mut high) = POWERS;
    if ratio <= ratio_of_drifts(orders, low) {
        return 0.0;
    }
    for _ in 0..60 {
        let middle = low + (high - low) / 2.0;
        if ratio_of_drifts(orders, middle) < ratio {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// p + g·d^q through three orders, as what it makes of the order of any pair; `None` where their drifts have no q.
pub(super) fn next_power(orders: &[Local; 3]) -> Option<impl Fn(&Local) -> f64 + use<>> {
    let [a, b, c] = *orders;
    let drift = b.order - c.order;
    let q = power(orders, (a.order - b.order) / drift);
    let slope = move |local: &Local| slope(local, q, c.fine);
    let factor = drift / (slope(&b) - slope(&c));
    (q > 0.0).then_some(move |local: &Local| c.order + factor * (slope(local) - slope(&c)))
}
