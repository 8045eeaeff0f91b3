//! Rays that end early: where, by what, and what becomes of the radiance.

use super::Lone;
use crate::identify::NotIdentified;
use crate::identify::number::simplest;
use crate::identify::rule::{Sequence, Stop, StopBy};
use crate::identify::session::Session;

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
/// Bracket's width that is fine enough.
const FINE: f64 = 1e-8;

/// A ray, and the last sample that counted on it.
struct Trial {
    /// T behind every sample, in order.
    after: Vec<f64>,
    /// The weight of every sample.
    weights: Vec<f64>,
    /// The position of the last one that counted.
    last: usize,
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
    let tau = lone.reference(length) * 16.0;
    let passes = lone.of(tau, length, ray).1;
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
    // A jump from little to nearly all tells whether the sample that goes under still counts.
    let mut jump = vec![lone.reference(length); n];
    jump[3] = lone.invert((thick.after[thick.last] * 1e-3).max(1e-12), length, ray);
    let jump = trial(session, lone, &jump, length)?;
    let mut trials = vec![thick, jump];
    for _ in 0..ROUNDS {
        let Some((reading, (low, high))) = reading(&trials) else {
            return Err(failed(&trials));
        };
        if high / low - 1.0 < FINE + 64.0 * lone.measurer.answers.unit {
            break;
        }
        let taus = match reading.by {
            StopBy::Transmittance => fine(lone, n, length, low, high),
            StopBy::Weight => falling(lone, n, length, low, high),
        };
        let Some(taus) = taus else { break };
        let next = trial(session, lone, &taus, length)?;
        if next.last + 1 >= next.after.len() {
            break;
        }
        let before = (low, high);
        trials.push(next);
        if reading.of_all(&trials) == Some(before) {
            break;
        }
    }
    let Some((reading, (low, high))) = reading(&trials) else {
        return Err(failed(&trials));
    };
    let under = simplest(low, high);
    // 0.05 is said as 1 − 0.95 where that has fewer digits.
    let opaque = 1.0 - simplest(1.0 - high, 1.0 - low);
    let is_shorter = format!("{:e}", 1.0 - opaque).len() < format!("{under:e}").len();
    let under = if (low..=high).contains(&opaque) && is_shorter {
        opaque
    } else {
        under
    };
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
fn trial(
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
    let (mut after, mut weights) = (Vec::new(), Vec::new());
    let mut passes = 1.0;
    for &k in &order {
        let (weight, through) = lone.of(taus[k], length, ray);
        weights.push(weight * passes);
        passes *= through;
        after.push(passes);
    }
    let lit = |k: &usize| w[*k].value.abs() > 3.0 * w[*k].error;
    let last = order.iter().rposition(lit).unwrap_or(0);
    Ok(Trial {
        after,
        weights,
        last,
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
    let mut taus = vec![1e-12 * lone.reference(length)];
    taus.extend(vec![lead_tau; lead]);
    taus.extend(vec![fine_tau; rest]);
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
        // α with T α = target.
        let opacity = target / passes;
        if !(opacity > 0.0 && opacity < 0.9) {
            return None;
        }
        let tau = lone.invert(1.0 - opacity, length, ray);
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
    let seen = if skipped == 1 { 1.0 } else { passes };
    let factor = found[1] / (weight * seen);
    let slack = 1e-6 + 64.0 * lone.measurer.answers.unit;
    let first = lone.measurer.samples.sequence.first;
    let is_plain = first == crate::identify::rule::End::Once;
    if lone.measurer.answers.is_coarse() || !is_plain || (factor - 1.0).abs() <= slack {
        return Ok(false);
    }
    let count = found.iter().filter(|w| **w != 0.0).count();
    let end = passes.powi(i32::try_from(count).unwrap_or(i32::MAX));
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
    let lit = |w: &crate::identify::weights::Measured| {
        if w.value.abs() > 3.0 * w.error {
            w.value
        } else {
            0.0
        }
    };
    Ok(w.iter().map(lit).collect())
}
