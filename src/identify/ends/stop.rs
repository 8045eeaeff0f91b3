//! Rays that end early: where, by what, and what becomes of the radiance.

use super::Lone;
use super::sum::by_sum;
use crate::identify::NotIdentified;
use crate::identify::number::simplest;
use crate::identify::rule::{Place, Sequence, Stop, StopBy, Whole};
use crate::identify::session::Session;
use crate::identify::weights::Measured;

/// An early end, between these.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::identify) struct Early {
    pub(in crate::identify) stop: Stop,
    pub(in crate::identify) bracket: (f64, f64),
}

/// Segments of the rays that ask.
const SEGMENTS: usize = 64;
/// An end under this is one by rounding.
const LEAST: f64 = 1e-13;
/// Rounds of refinement.
const ROUNDS: usize = 14;
/// A bracket wider than this says no number.
const LOOSE: f64 = 1e-2;
/// Bracket's width that is fine enough.
const FINE: f64 = 1e-8;

/// A ray, and the last sample that counted on it.
pub(super) struct Trial {
    /// T behind every sample, in order.
    after: Vec<f64>,
    /// The weight of every sample.
    pub(super) weights: Vec<f64>,
    /// What all samples up to each weigh by themselves.
    pub(super) sums: Vec<f64>,
    /// The position of the last one that counted.
    pub(super) last: usize,
    /// What it was seen to weigh.
    pub(super) seen: Measured,
}

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
    let fine_enough = FINE + 64.0 * lone.measurer.answers.unit;
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
    let renormalised = renormalised(session, lone, tau, n, length)?;
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

/// The simplest threshold of a bracket: 0.05 is said as 1 − 0.95 where that has fewer digits.
pub(super) fn simplest_threshold((low, high): (f64, f64)) -> f64 {
    let under = simplest(low, high);
    // 1/255 and its like.
    let part = 1.0 / (1.0 / under).round();
    if (low..=high).contains(&part) && part >= 1.0 / 65_536.0 && high / low - 1.0 < 1e-4 {
        return part;
    }
    let opaque = 1.0 - simplest(1.0 - high, 1.0 - low);
    let is_shorter = format!("{:e}", 1.0 - opaque).len() < format!("{under:e}").len();
    if (low..=high).contains(&opaque) && is_shorter {
        opaque
    } else {
        under
    }
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

/// Which sample of a ray is the last that counts.
pub(super) fn trial(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
    taus: &[f64],
    length: f64,
) -> Result<Trial, NotIdentified> {
    let n = taus.len();
    let ray = n as f64 * length;
    let sequence = lone.measurer.samples.sequence;
    // Samples in the order in which they are taken, whatever end that is.
    let w = lone.measurer.weights(session, taus, length)?;
    let order = order(&sequence, n);
    let (mut after, mut weights, mut sums) = (Vec::new(), Vec::new(), Vec::new());
    let mut sum = 0.0;
    // One sample too many stands in front of all at the back of segments.
    let is_behind = lone.measurer.samples.place == Place::Back && sequence.extra.is_some();
    let mut passes = if is_behind && !sequence.swapped {
        lone.of(taus[0], length, ray).1
    } else {
        1.0
    };
    for &k in &order {
        let (weight, through) = lone.of(taus[k], length, ray);
        weights.push(weight * passes);
        sum += weight / lone.law.scale.0;
        sums.push(sum);
        passes *= through;
        after.push(passes);
    }
    let lit = |k: &usize| w[*k].value.abs() > 3.0 * w[*k].error;
    let last = order.iter().rposition(lit).unwrap_or(0);
    let seen = w[order[last]];
    Ok(Trial {
        after,
        weights,
        sums,
        last,
        seen,
    })
}

/// Positions of samples along the order, counted from where the march begins.
fn order(sequence: &Sequence, n: usize) -> Vec<usize> {
    let forward = Sequence {
        swapped: false,
        extra: None,
        ..*sequence
    };
    let all = forward.order(n, false, false);
    let all = all.into_iter().filter_map(|i| usize::try_from(i).ok());
    let all = all.filter(|i| *i < n);
    if sequence.swapped {
        // `weights` has turned the ray: the first is where the march begins.
        let all: Vec<usize> = all.collect();
        let turned = all.iter().rev().map(|i| n - 1 - i);
        return turned.collect();
    }
    all.collect()
}

/// A few thick segments to just above the bracket, then thin ones through it.
fn fine(lone: &Lone<'_>, n: usize, length: f64, low: f64, high: f64) -> Option<Vec<f64>> {
    let ray = n as f64 * length;
    // Above 1 is where nothing is absorbed.
    let high = high.min(1.0 - 1e-9);
    let lead = 1 + whole(-high.ln() / 0.4);
    let rest = n.checked_sub(lead + 1).filter(|rest| *rest > 8)?;
    let step = (low / high).powf(1.0 / (rest - 1) as f64);
    let lead_tau = lone.invert(high.powf(1.0 / lead as f64), length, ray);
    let fine_tau = lone.invert(step, length, ray);
    let near = lone.measurer.near_end();
    let mut taus = Vec::new();
    if near != crate::identify::rule::End::Once {
        // A first sample that does not count once holds next to nothing.
        taus.push(1e-12 * lone.reference(length));
    }
    taus.extend(vec![lead_tau; lead]);
    taus.resize(n, fine_tau);
    Some(taus)
}

/// Weights that fall slowly through the bracket.
fn falling(lone: &Lone<'_>, n: usize, length: f64, low: f64, high: f64) -> Option<Vec<f64>> {
    let ray = n as f64 * length;
    let high = high.min(0.3);
    let ratio = (low / high).powf(1.0 / (n - 2) as f64);
    let (mut passes, mut target) = (1.0, high);
    let mut taus = Vec::new();
    for _ in 0..n {
        // w with T w = target.
        let tau = lone.with_weight(target / passes, length, ray)?;
        taus.push(tau);
        passes *= lone.of(tau, length, ray).1;
        target *= ratio;
    }
    Some(taus)
}

/// A number of segments.
fn whole(x: f64) -> usize {
    // A logarithm of what binary64 holds.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let count = x.ceil().clamp(0.0, 1e3) as usize;
    count
}

/// Whether weights of a ray that ends early are divided by its opacity.
fn renormalised(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
    tau: f64,
    n: usize,
    length: f64,
) -> Result<bool, NotIdentified> {
    let found = trial_weights(session, lone, &vec![tau; n], length)?;
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
    if lone.measurer.answers.is_coarse() || !is_plain || (factor - 1.0).abs() <= slack {
        return Ok(false);
    }
    if (factor * (1.0 - end) - 1.0).abs() <= slack {
        return Ok(true);
    }
    Err(NotIdentified::new(format!(
        "the weights of a ray that ends early are multiplied by {factor:.9}"
    )))
}

fn trial_weights(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
    taus: &[f64],
    length: f64,
) -> Result<Vec<f64>, NotIdentified> {
    let w = lone.measurer.weights(session, taus, length)?;
    let lit = |w: &Measured| {
        if w.value.abs() > 3.0 * w.error {
            w.value
        } else {
            0.0
        }
    };
    Ok(w.iter().map(lit).collect())
}
