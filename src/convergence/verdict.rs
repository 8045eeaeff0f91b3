//! What a fit says of an expectation.

use super::Note;
use crate::method::Expected;
use serde::Serialize;
use std::fmt;

/// The widest half-width that still confirms an order.
pub const MAX_HALF_WIDTH: f64 = 0.25;

/// Orders below this do not count as convergence.
pub(crate) const NO_CONVERGENCE: f64 = 0.1;

/// What the errors of a ladder say, compared with the order expected.
///
/// Precedence; the first line that applies is the verdict ("trend": over the last up to four levels
/// above the floor, at least three, no pairwise order reaches 0.1; "interval": as far around an order as the
/// order of any pair lies from it). Where no floor is given and errors stop falling, the floor is the one that
/// they show:
///
/// | # | verdict | when |
/// |---|---|---|
/// | 1 | `NotFinite` | an error or a floor is NaN or infinite |
/// | 2 | `TooFewLevels` | fewer than 4 levels |
/// | 3 | `Exact`, `FloorLimited` | every \|e\| ≤ 30·floor (with floor 0: e = 0): `Exact` where all errors are 0 or `Exact` is expected, `Blind` on a blind case, otherwise `FloorLimited` |
/// | 4 | `Diverged` | beyond the floor's cut, errors rise above 30 floors again and grow up to the last level |
/// | 5 | `Diverged` | a window with order ≤ −0.1; without a window, a trend with net order ≤ −0.1; in both, the interval lies below 0 |
/// | 6 | `Oscillatory` | a sign change inside the window; without one, two among the last 4 usable levels, or five pairwise orders that rise and fall in turn by more than 0.1; `Blind` on a blind case |
/// | 7 | `Stalled` | a window with \|order\| < 0.1; without one, a trend with net order > −0.1, or five pairwise orders within ±0.35 with a net order within ±0.1 |
/// | 8 | `Blind` | the case is blind for the method |
/// | 9 | `PreAsymptotic` | errors rise above 30 floors again beyond the cut |
/// | 10 | `FloorLimited` | the floor cut the ladder, and no window is left or its half-width exceeds 0.25; or the half-width exceeds 0.25 by the floor's share of it |
/// | 11 | `PreAsymptotic` | no window, or a half-width above 0.25 |
/// | 12 | `Fitted` | nothing was expected, or theory does not say |
/// | 13 | `Confirmed` | the expected order lies within order ± half-width |
/// | 14 | `TooLow`, `TooHigh` | it lies above, below the interval (`TooLow` where `Exact` was expected) |
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
pub enum Verdict {
    /// The expected order lies inside the interval, which is narrow enough to mean something.
    Confirmed,
    /// The fitted order is lower than expected.
    TooLow,
    /// The fitted order is higher than expected: the case does not exercise the method.
    TooHigh,
    /// No asymptotic window yet, or too wide an interval: finer levels are needed.
    PreAsymptotic,
    /// The roundoff floor ends the ladder before an order shows: more precision is needed.
    FloorLimited,
    /// No error above the floor at any level.
    Exact,
    /// The error stays where it is, above the floor.
    Stalled,
    /// The error changes sign where it should be asymptotic.
    Oscillatory,
    /// The error grows as the step shrinks.
    Diverged,
    /// Fewer than four levels: nothing can be said.
    TooFewLevels,
    /// An error or a floor is NaN or infinite.
    NotFinite,
    /// The case hides the method's leading error: it neither passes nor fails.
    Blind,
    /// An order was fitted, and nothing was expected.
    Fitted,
}

impl Verdict {
    /// Whether a check passes: `Confirmed`, and `Exact` where `Exact` is expected.
    #[must_use]
    pub fn passes(self, expected: Option<Expected>) -> bool {
        match self {
            Verdict::Confirmed => true,
            Verdict::Exact => expected == Some(Expected::Exact),
            _ => false,
        }
    }

    /// Whether it is firm about an order: found in a window, with a narrow interval.
    #[must_use]
    pub fn is_of_an_order(self) -> bool {
        use Verdict::{Confirmed, Fitted, TooHigh, TooLow};
        matches!(self, Confirmed | TooLow | TooHigh | Fitted)
    }

    /// The verdict's name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Confirmed => "Confirmed",
            Verdict::TooLow => "TooLow",
            Verdict::TooHigh => "TooHigh",
            Verdict::PreAsymptotic => "PreAsymptotic",
            Verdict::FloorLimited => "FloorLimited",
            Verdict::Exact => "Exact",
            Verdict::Stalled => "Stalled",
            Verdict::Oscillatory => "Oscillatory",
            Verdict::Diverged => "Diverged",
            Verdict::TooFewLevels => "TooFewLevels",
            Verdict::NotFinite => "NotFinite",
            Verdict::Blind => "Blind",
            Verdict::Fitted => "Fitted",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// An order with its interval, as found in a window.
#[derive(Clone, Copy, Debug)]
pub struct Estimate {
    /// The fitted order.
    pub order: f64,
    /// Half of the interval.
    pub half_width: f64,
    /// The part of the half-width that comes from the floor.
    pub floor_share: f64,
    /// Errors of both signs stand in the window.
    pub sign_change: bool,
}

/// How the errors move over the last levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Trend {
    /// At an order of −0.1 or less.
    Growing,
    /// At an order between −0.1 and 0.1.
    Flat,
    /// At an order of 0.1 or more from some level to the next, or in no direction that shows.
    Converging,
    /// At orders that rise and fall in turn: [`alternate`].
    Swinging,
}

/// Levels whose pairwise orders all lie this near to 0 stay where they are, however they jitter …
const JITTER: f64 = 0.35;
/// … if there are this many such orders.
const JITTERING: usize = 5;

impl Trend {
    /// Of (log₂ step, log₂ |error|), coarse to fine. Five pairwise orders within ±0.35 that come to less than 0.1
    /// are `Flat`; otherwise the finest up to four levels decide, where no order reaches 0.1: `Growing` where an
    /// interval as wide as the largest distance of an order from that of all lies below 0. `Converging` where
    /// fewer than three are given, which is too little to call it anything else.
    #[must_use]
    pub fn of(points: &[(f64, f64)]) -> Trend {
        let order = |a: &(f64, f64), b: &(f64, f64)| (a.1 - b.1) / (a.0 - b.0);
        if let Some(finest) = points.len().checked_sub(JITTERING + 1)
            && let [first, .., last] = &points[finest..]
            && order(first, last).abs() < NO_CONVERGENCE
            && points[finest..]
                .windows(2)
                .all(|w| order(&w[0], &w[1]).abs() <= JITTER)
        {
            return Trend::Flat;
        }
        let tail = &points[points.len().saturating_sub(4)..];
        let orders: Vec<f64> = tail.windows(2).map(|w| order(&w[0], &w[1])).collect();
        let [first, _, .., last] = tail else {
            return Trend::Converging;
        };
        if orders.iter().any(|order| *order >= NO_CONVERGENCE) {
            return Trend::Converging;
        }
        let net = order(first, last);
        let width = orders.iter().map(|order| (order - net).abs());
        if net > -NO_CONVERGENCE {
            Trend::Flat
        } else if net + width.fold(0.0, f64::max) < 0.0 {
            Trend::Growing
        } else {
            Trend::Converging
        }
    }
}

/// Whether the last five pairwise orders rise and fall in turn by more than 0.1: the error has a coefficient that
/// swings from level to level.
#[must_use]
pub fn alternate(orders: &[f64]) -> bool {
    let Some(finest) = orders.len().checked_sub(JITTERING) else {
        return false;
    };
    let drifts = orders[finest..].windows(2).map(|pair| pair[1] - pair[0]);
    let drifts: Vec<f64> = drifts.collect();
    drifts.iter().all(|drift| drift.abs() > NO_CONVERGENCE)
        && drifts.windows(2).all(|pair| pair[0] * pair[1] < 0.0)
}

/// What happens beyond the usable levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beyond {
    /// There is nothing beyond: no level is at the floor.
    Nothing,
    /// All finer levels are at the floor.
    Floor,
    /// Errors exceed 30 floors again.
    Rise,
    /// … and grow up to the last level.
    Growth,
}

/// Everything a verdict rests on.
#[derive(Clone, Copy, Debug)]
pub struct Evidence {
    /// How many levels the ladder has.
    pub levels: usize,
    /// No error and no floor is NaN or infinite.
    pub finite: bool,
    /// No level stands above the floor.
    pub all_at_floor: bool,
    /// Every error is 0.
    pub all_zero: bool,
    /// What happens beyond the usable levels.
    pub beyond: Beyond,
    /// Trend of the usable levels.
    pub trend: Trend,
    /// Sign changes among the last four usable levels.
    pub late_sign_changes: usize,
    /// The order of the window, where there is one.
    pub estimate: Option<Estimate>,
}

/// The verdict by the table at [`Verdict`].
#[must_use]
pub fn judge(evidence: &Evidence, expected: Option<Expected>) -> Verdict {
    let blind = matches!(expected, Some(Expected::Blind { .. }));
    let unless_blind = |verdict| if blind { Verdict::Blind } else { verdict };
    if !evidence.finite {
        return Verdict::NotFinite;
    }
    if evidence.levels < super::window::MIN_WINDOW {
        return Verdict::TooFewLevels;
    }
    if evidence.all_at_floor {
        // Roundoff may hide an order as well as none; only who expects none may take it for that.
        return match expected {
            Some(Expected::Exact) => Verdict::Exact,
            _ if evidence.all_zero => unless_blind(Verdict::Exact),
            _ => unless_blind(Verdict::FloorLimited),
        };
    }
    let (trend, oscillates) = match evidence.estimate {
        Some(e) if e.order <= -NO_CONVERGENCE && e.order + e.half_width < 0.0 => {
            (Trend::Growing, e.sign_change)
        }
        Some(e) if e.order <= -NO_CONVERGENCE => (Trend::Converging, e.sign_change),
        Some(e) if e.order < NO_CONVERGENCE => (Trend::Flat, e.sign_change),
        Some(e) => (Trend::Converging, e.sign_change),
        None => (
            evidence.trend,
            evidence.late_sign_changes >= 2 || evidence.trend == Trend::Swinging,
        ),
    };
    if evidence.beyond == Beyond::Growth || trend == Trend::Growing {
        return Verdict::Diverged;
    }
    if oscillates {
        return unless_blind(Verdict::Oscillatory);
    }
    if trend == Trend::Flat {
        return Verdict::Stalled;
    }
    if blind {
        return Verdict::Blind;
    }
    if evidence.beyond == Beyond::Rise {
        return Verdict::PreAsymptotic;
    }
    let narrow = evidence.estimate.filter(|e| e.half_width <= MAX_HALF_WIDTH);
    match narrow {
        Some(estimate) => compare(estimate, expected),
        None if evidence.beyond == Beyond::Floor || floor_widens(evidence.estimate) => {
            Verdict::FloorLimited
        }
        None => Verdict::PreAsymptotic,
    }
}

/// Would the interval be narrow enough without the floor's share?
fn floor_widens(estimate: Option<Estimate>) -> bool {
    estimate.is_some_and(|e| e.half_width - e.floor_share <= MAX_HALF_WIDTH)
}

/// Where the expected order lies, seen from a narrow interval.
fn compare(estimate: Estimate, expected: Option<Expected>) -> Verdict {
    match expected {
        None | Some(Expected::Unknown) => Verdict::Fitted,
        Some(Expected::Blind { .. }) => Verdict::Blind,
        Some(Expected::Exact) => Verdict::TooLow,
        Some(Expected::Order(p)) => {
            if (p - estimate.order).abs() <= estimate.half_width {
                Verdict::Confirmed
            } else if estimate.order < p {
                Verdict::TooLow
            } else {
                Verdict::TooHigh
            }
        }
    }
}

/// Whether a missing floor may be what keeps a verdict from being better.
pub(super) fn floor_matters(verdict: Verdict) -> bool {
    matches!(
        verdict,
        Verdict::PreAsymptotic
            | Verdict::FloorLimited
            | Verdict::Stalled
            | Verdict::Oscillatory
            | Verdict::Diverged
    )
}

/// Adds the remark that no floor was given, where it may matter.
pub(super) fn remark_missing_floor(verdict: Verdict, floor_known: bool, notes: &mut Vec<Note>) {
    if !floor_known && floor_matters(verdict) {
        notes.push(Note::FloorUnknown);
    }
}
