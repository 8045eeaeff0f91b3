//! Rays that end where what samples weigh by themselves sums to a threshold.

use super::Lone;
use super::trial::{Early, Trial, simplest_threshold, trial};
use crate::identify::NotIdentified;
use crate::identify::rule::{End, Stop, StopBy};
use crate::identify::session::Session;

/// Segments of the rays that ask, each of length 1.
const SEGMENTS: usize = 64;
/// What one sample weighs of the first ray, and the one that takes the sum across the threshold.
const FIRST: f64 = 1.0 / 8.0;
const ACROSS: f64 = 0.5;
/// Rounds of refinement.
const ROUNDS: usize = 8;
/// Bracket's width that is fine enough.
const FINE: f64 = 1e-8;

/// The end by a sum; `None` where no ray of small sums ends.
pub(super) fn by_sum(
    session: &mut Session<'_>,
    lone: &Lone<'_>,
) -> Result<Option<Early>, NotIdentified> {
    let sequence = &lone.measurer.samples.sequence;
    let is_plain = sequence.first == End::Once
        && sequence.last == End::Once
        && sequence.extra.is_none()
        && !sequence.swapped
        && !sequence.late;
    let n = lone.measurer.suitable(session, SEGMENTS);
    let Some(tau) = lone.with_weight(FIRST, 1.0, n as f64).filter(|_| is_plain) else {
        return Ok(None);
    };
    let first = trial(session, lone, &vec![tau; n], 1.0)?;
    if first.last + 2 >= first.sums.len() || first.last == 0 {
        return Ok(None);
    }
    let failed = || {
        let rows = vec![vec![first.last as f64, first.sums[first.last]]];
        NotIdentified::new("rays end early, and not by what samples weigh")
            .with_rows(&["last sample", "sum up to it"], rows)
    };
    // A jump across the threshold tells what becomes of the sample that crosses it.
    let (low, high) = (first.sums[first.last - 1], first.sums[first.last + 1]);
    let lead = first.last + 1;
    let across = lone.with_weight(ACROSS * lone.law.scale.0, 1.0, n as f64);
    let mut taus = leading(lone, lead, low, n).ok_or_else(failed)?;
    taus.push(across.ok_or_else(failed)?);
    taus.resize(n, tau);
    let jump = trial(session, lone, &taus, 1.0)?;
    let crossing = match jump.last {
        last if last == lead => Some(jump.seen.value / jump.weights[lead]),
        last if last + 1 == lead => None,
        _ => return Err(failed()),
    };
    let slack = 1e-9 + 256.0 * lone.measurer.answers.unit;
    let stop = |under, before, cut| Stop {
        by: StopBy::Sum,
        under,
        before,
        cut,
        renormalised: false,
    };
    if let Some(part) = crossing.filter(|part| *part < 1.0 - slack) {
        let before = jump.sums[lead - 1];
        let level = before + part * (jump.sums[lead] - before);
        let bracket = (level * (1.0 - slack), level * (1.0 + slack));
        // Where the whole first ray agrees: what it takes to the threshold is all that there is.
        if !(low..=high).contains(&level) {
            return Err(failed());
        }
        return Ok(Some(Early {
            stop: stop(simplest_threshold(bracket), false, true),
            bracket,
        }));
    }
    let is_before = crossing.is_none();
    let bracket = |trial: &Trial| {
        let decided = trial.last + usize::from(is_before);
        let high = trial.sums.get(decided).copied();
        high.map(|high| (decided.checked_sub(1).map_or(0.0, |k| trial.sums[k]), high))
    };
    let (mut low, mut high) = bracket(&first).ok_or_else(failed)?;
    for _ in 0..ROUNDS {
        if high / low - 1.0 <= FINE + 64.0 * lone.measurer.answers.unit {
            break;
        }
        let steps = n - lead - 2;
        let Some(mut taus) = leading(lone, lead, low, n) else {
            break;
        };
        let fine = (high - low) / steps as f64 * 1.1;
        let fine = lone.with_weight(fine * lone.law.scale.0, 1.0, n as f64);
        taus.resize(n, fine.ok_or_else(failed)?);
        let next = trial(session, lone, &taus, 1.0)?;
        let Some((new_low, new_high)) = bracket(&next) else {
            return Err(failed());
        };
        (low, high) = (low.max(new_low), high.min(new_high));
        if low >= high {
            return Err(failed());
        }
    }
    Ok(Some(Early {
        stop: stop(simplest_threshold((low, high)), is_before, false),
        bracket: (low, high),
    }))
}

/// Samples that weigh together a little less than `sum`.
fn leading(lone: &Lone<'_>, count: usize, sum: f64, n: usize) -> Option<Vec<f64>> {
    let each = sum * (1.0 - 1e-12) / count as f64 * lone.law.scale.0;
    Some(vec![lone.with_weight(each, 1.0, n as f64)?; count])
}
