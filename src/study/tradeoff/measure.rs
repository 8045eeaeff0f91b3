//! How long something takes.

use super::clock::now;
use serde::Serialize;
use std::hint::black_box;
use std::time::Duration;

/// One measurement takes at least so long: a clock's own few hundred nanoseconds are nothing beside it.
const LEAST: Duration = Duration::from_micros(60);
/// More than so many runs are not made at once.
const MOST_RUNS: u32 = 1 << 20;

/// Nanoseconds of one run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Timing {
    /// The median of all measurements.
    pub median: f64,
    /// Half of the range that the middle half of the measurements fills.
    pub spread: f64,
    /// How many measurements.
    pub repeats: usize,
}

impl Timing {
    /// The median of measurements in nanoseconds; `None` without any.
    #[must_use]
    pub fn of(mut measurements: Vec<f64>) -> Option<Timing> {
        measurements.retain(|time| time.is_finite());
        measurements.sort_by(f64::total_cmp);
        Some(Timing {
            median: quantile(&measurements, 0.5)?,
            spread: (quantile(&measurements, 0.75)? - quantile(&measurements, 0.25)?) / 2.0,
            repeats: measurements.len(),
        })
    }
}

/// Between the sorted values, linearly.
fn quantile(sorted: &[f64], share: f64) -> Option<f64> {
    let place = share * sorted.len().checked_sub(1)? as f64;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // An index.
    let index = place as usize;
    let low = *sorted.get(index)?;
    let high = *sorted.get(index + 1).unwrap_or(&low);
    Some(low + (high - low) * (place - index as f64))
}

/// How often `work` has to run for one measurement: found by running it, which warms it up too.
pub(super) fn runs_a_measurement(mut work: impl FnMut()) -> u32 {
    work();
    let mut runs = 1;
    loop {
        let time = elapsed(runs, &mut work);
        if time >= LEAST || runs >= MOST_RUNS {
            return runs;
        }
        let missing = LEAST.as_secs_f64() / time.as_secs_f64().max(1e-8);
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)] // Below MOST_RUNS.
        let factor = (missing * 1.2).clamp(2.0, 1e4).ceil() as u32;
        runs = runs.saturating_mul(factor).min(MOST_RUNS);
    }
}

/// Nanoseconds a run, of so many runs.
pub(super) fn nanoseconds(runs: u32, mut work: impl FnMut()) -> f64 {
    elapsed(runs, &mut work).as_secs_f64() * 1e9 / f64::from(runs.max(1))
}

fn elapsed(runs: u32, work: &mut impl FnMut()) -> Duration {
    let start = now();
    for _ in 0..runs {
        black_box(&mut *work)();
    }
    now().saturating_sub(start)
}
