//! Where a ray ended early: the transmittances that would have ended it there.

use super::march::steps;
use super::{Accuracy, Recipe, Watched, WatchedLevel};
use crate::real::Native;

/// Transmittances at which rays are known to be ended, the usual ones first.
pub(super) const USUAL: [f64; 12] = [
    1.0 / 255.0,
    1.0 / 256.0,
    0.01,
    0.001,
    0.05,
    0.02,
    0.005,
    1e-4,
    1e-5,
    1e-6,
    0.1,
    1e-8,
];

/// The thresholds under which a transmittance ends a ray just where the kernel's value says: from `low`
/// (excluded) to `high`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Thresholds {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Thresholds {
    const ANY: Thresholds = Thresholds {
        low: 0.0,
        high: f64::INFINITY,
    };

    fn and(self, other: Thresholds) -> Option<Thresholds> {
        let low = self.low.max(other.low);
        let high = self.high.min(other.high);
        (low < high).then_some(Thresholds { low, high })
    }

    fn contain(self, threshold: f64) -> bool {
        self.low < threshold && threshold <= self.high
    }
}

/// What becomes of one level under a recipe without a stop.
struct Ended {
    /// The whole ray gives the value.
    whole: bool,
    /// Some beginning of it does, the whole ray included.
    thresholds: Option<Thresholds>,
}

fn ended(recipe: &Recipe, level: &WatchedLevel, scale: f64, accuracy: Accuracy) -> Ended {
    let steps = steps(recipe, &level.ray, Native::<f64>::new());
    let last = steps.len();
    let (mut radiance, mut transmittance) = (0.0, 1.0);
    let mut thresholds: Option<Thresholds> = None;
    let mut whole = false;
    let tolerance = accuracy.tolerances(level, scale);
    for (k, step) in steps.iter().enumerate() {
        let before = transmittance;
        radiance += step.adds * transmittance;
        transmittance *= step.passes;
        let agrees = (level.value - radiance).abs() <= tolerance(radiance);
        if !agrees {
            continue;
        }
        // A ray that ends here has T under the threshold now, and had not before.
        let is_last = k + 1 == last;
        let low = if is_last { 0.0 } else { transmittance };
        whole = whole || is_last;
        thresholds = Some(match thresholds {
            None => Thresholds { low, high: before },
            Some(wider) => Thresholds {
                low: wider.low.min(low),
                high: wider.high.max(before),
            },
        });
    }
    Ended { whole, thresholds }
}

/// How many channels a recipe without a stop explains, and with the stop that explains most.
pub(super) struct Explained {
    pub(super) plain: usize,
    /// Only where it explains more.
    pub(super) stopped: Option<(usize, f64)>,
}

/// Over the first `levels` levels of all channels.
pub(super) fn explained(
    recipe: &Recipe,
    watched: &[Watched],
    levels: usize,
    accuracy: Accuracy,
) -> Explained {
    let mut plain = 0;
    let mut all: Vec<Thresholds> = Vec::new();
    for one in watched {
        let mut whole = true;
        let mut together = Some(Thresholds::ANY);
        for level in one.levels.iter().take(levels) {
            let ended = ended(recipe, level, one.scale, accuracy);
            whole = whole && ended.whole;
            together = together
                .zip(ended.thresholds)
                .and_then(|(together, here)| together.and(here));
            if !whole && together.is_none() {
                break;
            }
        }
        plain += usize::from(whole);
        all.extend(together);
    }
    let stopped = best(&all).filter(|(count, _)| *count > plain);
    Explained { plain, stopped }
}

/// The threshold that most allow: a usual one if there is one, else the middle of what they leave.
fn best(all: &[Thresholds]) -> Option<(usize, f64)> {
    let count = |threshold: f64| all.iter().filter(|one| one.contain(threshold)).count();
    // A threshold that most allow is the highest that one of them allows.
    let highest = all
        .iter()
        .map(|one| one.high)
        .filter(|high| high.is_finite());
    let most = highest.map(|high| (count(high), high)).max_by(|a, b| {
        let same = a.0.cmp(&b.0);
        same.then(b.1.total_cmp(&a.1))
    });
    let (most, high) = most?;
    let usual = USUAL.into_iter().find(|usual| count(*usual) == most);
    let threshold = usual.unwrap_or_else(|| {
        let allowing = all.iter().filter(|one| one.contain(high));
        let low = allowing.map(|one| one.low).fold(0.0, f64::max);
        roundest(low, high)
    });
    Some((most, threshold))
}

/// The number above `low` and up to `high` that has the fewest digits.
fn roundest(low: f64, high: f64) -> f64 {
    let middle = f64::midpoint(low, high);
    let round = |digits: usize| format!("{middle:.digits$e}").parse::<f64>().ok();
    let mut rounded = (0..16).filter_map(round);
    rounded
        .find(|round| low < *round && *round <= high)
        .unwrap_or(high)
}
