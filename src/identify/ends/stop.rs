//! Rays that end early: where, by what, and what becomes of the radiance.

use super::Lone;
use super::sum::by_sum;
use super::trial::{Early, Trial, simplest_threshold, trial};
use crate::identify::NotIdentified;
use crate::identify::rule::{Place, Stop, StopBy, Whole};
use crate::identify::session::Session;
use crate::identify::weights::Measured;

/// Segments of the rays that ask.
const SEGMENTS: usize = 64;
/// An end under this is one by rounding.
const LEAST: f64 = 1e-13;
/// Rounds of refinement.
const ROUNDS: usize = 14;
/// A bracket wider than this says no number.
const LOOSE: f64 = 1e-2;
/// Samples of a ray behind those that ask: where the last of all decides, nobody knows that it does.
const BEYOND: usize = 2;
/// Bracket's width that is fine enough.
const FINE: f64 = 1e-8;

/// A reading of what decides.
#[derive(Clone, Copy)]
struct Reading {
    by: StopBy,
    before: bool,
}

const READINGS: [Reading; 4] = [
    Reading {
        by: StopBy::Transmittance,
        before: false,
    },
    Reading {
        by: StopBy::Transmittance,
        before: true,
    },
    Reading {
        by: StopBy::Weight,
        before: false,
    },
    Reading {
        by: StopBy::Weight,
        before: true,
    },
];

impl Reading {
    /// Between what the threshold lies; `None` where the trial speaks against it.
    fn bracket(self, trial: &Trial) -> Option<(f64, f64)> {
        let of = match self.by {
            StopBy::Transmittance => &trial.after,
            StopBy::Weight => &trial.weights,
            StopBy::Sum => return None,
        };
        // The sample that decided, and those that did not.
        let decided = trial.last + usize::from(self.before);
        let low = *of.get(decided)?;
        let high = of[..decided].iter().copied().fold(f64::INFINITY, f64::min);
        (low < high).then_some((low, high))
    }

    fn of_all(self, trials: &[Trial]) -> Option<(f64, f64)> {
        let mut both = (0.0, f64::INFINITY);
        for trial in trials {
            let (low, high) = self.bracket(trial)?;
            both = (f64::max(both.0, low), f64::min(both.1, high));
        }
        (both.0 < both.1 * (1.0 + 1e-9)).then_some(both)
    }
}

/// Whether rays end early, and how.
pub(in crate::identify) fn early_end(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
) -> Result<Option<Early>, NotIdentified> {
    let length = 1.0;
    let n = lone.measurer.suitable(session, SEGMENTS);
    let ray = n as f64 * length;
    // No round depth: thresholds are round.
    let tau = lone.reference(length) * 16.37;
    let passes = lone.of(tau, length, ray).1;
    if (passes - 1.0).abs() <= 0.0 {
        return by_sum(session, lone);
    }
    if !(passes > 0.0 && passes < 1.0) {
        return Ok(None);
    }
    let thick = trial(session, lone, &vec![tau; n], length)?;
    let count = thick.after.len();
    // Narrow formats end where numbers do.
    let is_narrow = lone.measurer.answers.unit > 1e-4;
    let least = if lone.measurer.answers.is_coarse() || is_narrow {
        1e-5
    } else {
        LEAST
    };
    if thick.last + 2 >= count || thick.after[thick.last] < least {
        return Ok(None);
    }
    let mut trials = vec![thick];
    // A jump from above the end to far below it tells whether the sample that goes under still counts.
    let (low, high) = (
        trials[0].after[trials[0].last],
        trials[0].after[trials[0].last.saturating_sub(1)],
    );
    if let Some(taus) = jump(lone, n, length, low, high) {
        trials.push(trial(session, lone, &taus, length)?);
    }
    if let Some((level, error)) = cut(&trials, lone) {
        let bracket = (level - error, level + error);
        return Ok(Some(Early {
            stop: Stop {
                by: StopBy::Transmittance,
                under: simplest_threshold(bracket),
                before: false,
                cut: true,
                renormalised: false,
            },
            bracket,
        }));
    }
    let fine_enough = fine_enough(lone);
    let mut stuck = [false; READINGS.len()];
    for _ in 0..ROUNDS {
        // Every reading that is left is put to the test, until it breaks or is sharp.
        let open = READINGS.iter().enumerate().filter_map(|(k, reading)| {
            let (low, high) = reading.of_all(&trials)?;
            (!stuck[k] && high / low - 1.0 > fine_enough).then_some((k, reading, low, high))
        });
        let widest = open.max_by(|u, v| (u.3 / u.2).total_cmp(&(v.3 / v.2)));
        let Some((k, reading, low, high)) = widest else {
            break;
        };
        let taus = match reading.by {
            StopBy::Transmittance => fine(lone, n, length, low, high),
            StopBy::Weight => falling(lone, n, length, low, high),
            StopBy::Sum => None,
        };
        let Some(taus) = taus else {
            stuck[k] = true;
            continue;
        };
        let next = trial(session, lone, &taus, length)?;
        if next.last + 1 >= next.after.len() {
            stuck[k] = true;
            continue;
        }
        trials.push(next);
        let now = reading.of_all(&trials);
        stuck[k] = now.is_some_and(|now| now.1 / now.0 > 0.999 * (high / low) && high / low < 1.5);
    }
    let Some((reading, (low, high))) = reading(&trials) else {
        return Err(failed(&trials));
    };
    if high / low - 1.0 > LOOSE.max(fine_enough) {
        return Err(NotIdentified::new(format!(
            "rays end early, under {} between {low:.3e} and {high:.3e}",
            match reading.by {
                StopBy::Transmittance => "a transmittance",
                StopBy::Weight => "a weight",
                StopBy::Sum => "a sum",
            }
        )));
    }
    let under = simplest_threshold((low, high));
    let renormalised = renormalised(lone, &trials[0], tau, n, length)?;
    Ok(Some(Early {
        stop: Stop {
            by: reading.by,
            under,
            before: reading.before,
            cut: false,
            renormalised,
        },
        bracket: (low, high),
    }))
}

/// The transmittance at which it stays, where the last sample of every trial weighs less than its opacity says, by just
/// as much as leads there.
fn cut(trials: &[Trial], lone: &Lone<'_>) -> Option<(f64, f64)> {
    let mut levels = Vec::new();
    for trial in trials {
        let last = trial.last;
        let before = last.checked_sub(1).map_or(1.0, |k| trial.after[k]);
        let part = trial.seen.value / trial.weights[last];
        let error = trial.seen.error / trial.weights[last];
        let opacity = before - trial.after[last];
        let slack = 3.0 * error + 256.0 * lone.measurer.answers.unit / before;
        if part.is_nan() || part >= 1.0 - slack {
            return None;
        }
        levels.push((before - part * opacity, slack * opacity + 1e-15));
    }
    let (level, error) = *levels.iter().min_by(|u, v| u.1.total_cmp(&v.1))?;
    let agree = levels.iter().all(|(l, e)| (l - level).abs() <= e + error);
    (agree && levels.len() > 1).then_some((level, error))
}

/// A few segments to just above `high`, one to far below `low`, then thin ones.
fn jump(lone: &Lone<'_>, n: usize, length: f64, low: f64, high: f64) -> Option<Vec<f64>> {
    let ray = n as f64 * length;
    let above = (2.0 * high).min(1.0 - 1e-6);
    let lead = 1 + whole(-above.ln() / 0.4);
    if lead + 8 > n {
        return None;
    }
    let thin = lone.reference(length);
    let mut taus = vec![lone.invert(above.powf(1.0 / lead as f64), length, ray); lead];
    taus.push(lone.invert((low / above * 0.05).max(1e-12), length, ray));
    taus.resize(n, thin);
    Some(taus)
}

fn reading(trials: &[Trial]) -> Option<(Reading, (f64, f64))> {
    let mut all = READINGS.iter();
    all.find_map(|reading| Some((*reading, reading.of_all(trials)?)))
}

fn failed(trials: &[Trial]) -> NotIdentified {
    let rows = trials.iter().map(|t| {
        let at = |of: &[f64], k: usize| of.get(k).copied().unwrap_or(f64::NAN);
        vec![
            t.last as f64,
            at(&t.after, t.last),
            at(&t.after, t.last + 1),
            at(&t.weights, t.last),
        ]
    });
    NotIdentified::new("rays end early, by no transmittance and no weight of one sample").with_rows(
        &[
            "last sample",
            "T behind it",
            "T behind the next",
            "its weight",
        ],
        rows.collect(),
    )
}

/// Numbers from under `high` down to `low`, each the same part of the one before, but for two about the simplest threshold
/// that lies between: most thresholds are round.
fn levels(high: f64, low: f64, count: usize, within: f64) -> Vec<f64> {
    let guess = simplest_threshold((low, high));
    let (over, under) = (guess * (1.0 + within), guess * (1.0 - within));
    let even = |from: f64, to: f64, count: usize| {
        let step = (to / from).powf(1.0 / count.max(1) as f64);
        (1..=count).map(move |k| from * step.powf(k as f64))
    };
    if !(over < high && under > low && count > 4) {
        return even(high, low, count).collect();
    }
    // As many on either side as it is wide.
    let (above, below) = ((high / over).ln(), (under / low).ln());
    let above = whole(above / (above + below) * (count - 2) as f64).clamp(1, count - 2);
    let falling = even(high, over, above).chain([under]);
    falling.chain(even(under, low, count - 1 - above)).collect()
}

/// A few thick segments to just above the bracket, then thin ones through it.
fn fine(lone: &Lone<'_>, n: usize, length: f64, low: f64, high: f64) -> Option<Vec<f64>> {
    let ray = n as f64 * length;
    // Above 1 is where nothing is absorbed.
    let high = high.min(1.0 - 1e-9);
    let lead = 1 + whole(-high.ln() / 0.4);
    let rest = n.checked_sub(lead + BEYOND + 2).filter(|rest| *rest > 8)?;
    // One sample too many at the back of segments stands in front of all.
    let samples = lone.measurer.samples;
    let is_behind = samples.place == Place::Back && samples.sequence.extra.is_some();
    let ahead = lead + usize::from(is_behind && !samples.sequence.swapped);
    let lead_tau = lone.invert(high.powf(1.0 / ahead as f64), length, ray);
    let near = lone.measurer.near_end();
    let mut taus = Vec::new();
    if near != crate::identify::rule::End::Once {
        // A first sample that does not count once holds next to nothing.
        taus.push(1e-12 * lone.reference(length));
    }
    taus.extend(vec![lead_tau; lead]);
    // By a weight, the ray ends here: later ones are not as small.
    let least = f64::max(1e-12, 256.0 * lone.measurer.answers.unit);
    taus.push(least * lone.reference(length));
    // Each from where the one before has come.
    let mut passes = lone.of(lead_tau, length, ray).1.powf(ahead as f64);
    for level in levels(high, low, rest, within(lone)) {
        let tau = lone.invert((level / passes).min(1.0), length, ray);
        taus.push(tau);
        passes *= lone.of(tau, length, ray).1;
    }
    taus.resize(n, taus.last().copied().unwrap_or(lead_tau));
    Some(taus)
}

/// Weights that fall slowly through the bracket.
fn falling(lone: &Lone<'_>, n: usize, length: f64, low: f64, high: f64) -> Option<Vec<f64>> {
    let ray = n as f64 * length;
    let high = high.min(0.3);
    let mut passes = 1.0;
    let mut taus = Vec::new();
    let low = low.min(high);
    let all = levels(high, low, n.saturating_sub(BEYOND), within(lone));
    let beyond = (1..=BEYOND).map(|k| low * 0.9_f64.powf(k as f64));
    for target in all.into_iter().chain(beyond) {
        // w with T w = target.
        let tau = lone.with_weight(target / passes, length, ray)?;
        taus.push(tau);
        passes *= lone.of(tau, length, ray).1;
    }
    Some(taus)
}

/// How near to a threshold that is guessed it is asked: nearer than a bracket has to be.
fn within(lone: &Lone<'_>) -> f64 {
    fine_enough(lone) / 4.0
}

/// A bracket's width that is narrow enough.
fn fine_enough(lone: &Lone<'_>) -> f64 {
    FINE + 64.0 * lone.measurer.answers.unit
}

/// A number of segments.
fn whole(x: f64) -> usize {
    // A logarithm of what binary64 holds.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let count = x.ceil().clamp(0.0, 1e3) as usize;
    count
}

/// Whether weights of an even ray that ends early are divided by its opacity.
fn renormalised(
    lone: &Lone<'_>,
    trial: &Trial,
    tau: f64,
    n: usize,
    length: f64,
) -> Result<bool, NotIdentified> {
    if lone.measurer.answers.is_coarse() {
        return Ok(false);
    }
    let lit = |w: &Measured| {
        if w.value.abs() > 3.0 * w.error {
            w.value
        } else {
            0.0
        }
    };
    let found: Vec<f64> = trial.all.iter().map(lit).collect();
    let ray = n as f64 * length;
    let (weight, passes) = lone.of(tau, length, ray);
    let skipped = usize::from(lone.measurer.samples.sequence.late);
    let sequence = &lone.measurer.samples.sequence;
    let is_behind = lone.measurer.samples.place == Place::Back && sequence.extra.is_some();
    let seen = match (skipped == 1, is_behind) {
        (true, false) => 1.0,
        (true, true) | (false, false) => passes,
        (false, true) => passes * passes,
    };
    let count = found.iter().filter(|w| **w != 0.0).count();
    let end = passes.powi(i32::try_from(count).unwrap_or(i32::MAX));
    let whole = match lone.measurer.whole {
        Whole::One => 1.0,
        Whole::ByOpacity => 1.0 / (1.0 - end),
        Whole::TimesOpacity => 1.0 - end,
    };
    let factor = found[1] / (weight * seen * whole);
    let slack = 1e-6 + 64.0 * lone.measurer.answers.unit;
    let first = lone.measurer.samples.sequence.first;
    let is_plain = first == crate::identify::rule::End::Once;
    if !is_plain || (factor - 1.0).abs() <= slack {
        return Ok(false);
    }
    if (factor * (1.0 - end) - 1.0).abs() <= slack {
        return Ok(true);
    }
    Err(NotIdentified::new(format!(
        "the weights of a ray that ends early are multiplied by {factor:.9}"
    )))
}
