//! The order of a deterministic method from its signed errors.

mod changeover;
mod drift;
mod input;
mod levels;
mod logarithm;
mod parity;
mod regression;
mod remarks;
mod tail;
mod uncertain;

pub use input::FitError;
pub(super) use input::check_steps;
pub use uncertain::fit_uncertain;

use super::Note;
use super::sample::{Sample, serialize_float};
use super::verdict::{Beyond, Evidence, Trend, Verdict, alternate, judge, remark_missing_floor};
use super::window::Window;
use crate::method::Expected;
use input::check;
use levels::{Levels, running_maximum};
use regression::Asymptote;
use rug::Float;
use serde::Serialize;

/// An error of at most this many floors is taken for roundoff.
pub const FLOOR_MARGIN: u32 = 30;

/// Two neighbouring levels with finite, nonzero errors.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
pub struct Pair {
    /// Index of the coarser level; the finer one is the next.
    pub coarse: usize,
    /// ln|eᵢ/eᵢ₊₁| / ln(dᵢ/dᵢ₊₁).
    pub order: f64,
    /// Both levels stand above the floor.
    pub above_floor: bool,
    /// Both levels lie in the window.
    pub in_window: bool,
    /// The error changes sign between the two.
    pub sign_change: bool,
}

/// Where the roundoff floor ended the ladder.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
pub struct FloorCut {
    /// Index of the first level dropped; everything finer is dropped too.
    pub level: usize,
    /// Its step.
    pub step: f64,
    /// The floor there: the largest of this level's and of all coarser ones.
    #[serde(serialize_with = "serialize_float")]
    #[cfg_attr(
        feature = "studies",
        schemars(schema_with = "super::sample::float_schema")
    )]
    pub floor: Float,
}

/// An order of accuracy with its interval, and what that says.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
pub struct Fit {
    /// What the errors say of the expectation.
    pub verdict: Verdict,
    /// The order p: fitted in the window; without a window, the last pairwise order above the floor.
    /// `None` with fewer than two usable levels.
    pub order: Option<f64>,
    /// Half-width of the order's interval. Without a window it is a spread, not an interval:
    /// the largest distance of the last three usable pairwise orders from the last, and at least
    /// twice that of the last two; for one pair alone, |p|.
    pub half_width: Option<f64>,
    /// log₂ c in |e| = c·dᵖ.
    pub log2_constant: Option<f64>,
    /// The levels the order was fitted in.
    pub window: Option<Window>,
    /// Largest floor of all levels; 0 where none is known.
    #[serde(serialize_with = "serialize_float")]
    #[cfg_attr(
        feature = "studies",
        schemars(schema_with = "super::sample::float_schema")
    )]
    pub floor: Float,
    /// Where the floor ended the ladder, if it did.
    pub cut: Option<FloorCut>,
    /// Pairwise orders, coarse to fine.
    pub pairs: Vec<Pair>,
    /// Remarks.
    pub notes: Vec<Note>,
}

/// Fits |e| = c·dᵖ in the asymptotic window of a ladder, and judges it.
///
/// `samples` are ordered from coarse to fine; steps are in the units of the ray, errors and floors
/// in those of the radiance.
///
/// 1. The floor at a level is the running maximum of the floors up to it. The first level with
///    |e| ≤ 30·floor is dropped *and everything finer*: an exact zero always is. Levels above are usable.
///    Where no floor is given, no order shows, and the last two errors are no smaller than three or more levels
///    before, the floor is the one that they show: the errors have stopped falling there ([`Note::StopsFalling`]).
/// 2. The window is the longest fine-side run of at least 4 usable levels whose pairwise orders
///    pᵢ agree with the last one within 0.02; if none, within 0.05; if none, within 0.1; if none, within 0.25.
/// 3. Two drifts δᵢ = pᵢ − pᵢ₊₁ tell how far away the next power of the error is: δᵢ₋₁/δᵢ = r^q for steps of a constant
///    ratio r, and q is found for any others. δ/(r^q − 1) is what is left of the last drift δ. So
///
///    - q ≥ 0.4, after its own trend: the order is p̂ = pₘ − δ/(r^q − 1), with pₘ the last pairwise order, and the half-width
///      δ/(r^¼ − 1), as if the next power were only ¼ away;
///    - q < 0.4: the order is p *up to a logarithm* where e = d^p·(c₁ − c₂·ln d) explains the last five pairs and a second
///      power does not ([`Note::Logarithm`]), with half of what is left of the drift as half-width; otherwise no order
///      ([`Note::SlowDrift`]);
///    - drifts that grow towards the fine levels: no order ([`Note::GrowingDrift`]);
///    - drifts within what floors allow, or too small or unsteady to tell q: least squares of log|e| on log d gives p̂. Its half-width
///      is max(max|pᵢ − p̂|, |p̂ − pₘ| + w), with w twice the larger of the last two drifts where orders jitter; what a
///      next power ¼ away leaves of them where roundoff hides the last; and what one 1/20 away leaves where orders have
///      turned round once, which makes drifts small for a while. Orders that agree within 0.1 at best and move one way,
///      or within 0.25 at best, are no plateau then, and have no window.
///
///    (Σ floor/|e|)/ln r over the last two levels, and the rounding of the logarithms, are added.
/// 4. The verdict follows the table at [`Verdict`]. Two powers with the change-over inside the ladder, and two sequences by
///    parity of n, are remarked ([`Note::GivesWay`], [`Note::TwoSequences`]).
///
/// Of seeded ladders with next powers ¼ to 2 away, logarithms, sign changes, changes of power, and floors flat, rising and
/// given, at most 1 interval in 1,000 narrow enough for a verdict excluded the order, in each family; of those whose next power is ½
/// or more away 99 % had one (`tests/orders/convergence/fit/families.rs`; figures in `docs/trust.md`).
///
/// It does not promise that a plateau is the last one: an order shows as far as the ladder reaches.
///
/// # Errors
///
/// [`FitError`] where steps are not positive and strictly decreasing, a floor is negative, or the
/// expected order is not finite. NaN and infinite errors are no input errors but a verdict.
pub fn fit(samples: &[Sample], expected: Option<Expected>) -> Result<Fit, FitError> {
    check(samples, expected)?;
    let given = Levels::new(samples);
    let trend = Trend::of(&given.points[..given.usable]);
    let asymptote = Asymptote::of(&given);
    // Errors that stay where they are need no floor that they stop at.
    let shows_nothing = asymptote.regression().is_none() && trend != Trend::Flat;
    let above = if shows_nothing {
        given.above_own_floor()
    } else {
        None
    };
    let (levels, own_floor) = match above {
        Some((levels, level)) => (levels, Some(level)),
        None => (given, None),
    };
    let asymptote = match own_floor {
        Some(_) => Asymptote::of(&levels),
        None => asymptote,
    };
    let regression = asymptote.regression();
    let window = regression.map(|r| r.window);
    let mut pairs = levels.pairs();
    for pair in &mut pairs {
        pair.in_window = window.is_some_and(|w| (w.first..w.last).contains(&pair.coarse));
    }
    let usable: Vec<Pair> = pairs.iter().filter(|p| p.above_floor).copied().collect();
    let orders: Vec<f64> = usable.iter().map(|p| p.order).collect();
    let evidence = Evidence {
        levels: samples.len(),
        finite: samples
            .iter()
            .all(|s| s.error.is_finite() && s.floor.is_finite()),
        all_at_floor: levels.at_floor.iter().all(|at| *at),
        all_zero: samples.iter().all(|s| s.error.is_zero()),
        beyond: match own_floor {
            Some(_) => Beyond::Floor,
            None => levels.beyond(),
        },
        trend: match own_floor {
            // Without an order before the floor, growth beyond it is all there is.
            Some(_) if regression.is_some() || trend != Trend::Growing => {
                Trend::of(&levels.points[..levels.usable])
            }
            _ if trend == Trend::Converging && alternate(&orders) => Trend::Swinging,
            _ => trend,
        },
        late_sign_changes: usable
            .iter()
            .filter(|p| p.sign_change && p.coarse + 4 >= levels.usable)
            .count(),
        estimate: regression.map(|r| r.estimate),
    };
    let verdict = judge(&evidence, expected);

    let (order, half_width, log2_constant) = match regression {
        Some(r) => (
            Some(r.estimate.order),
            Some(r.estimate.half_width),
            Some(r.log2_constant),
        ),
        None => last_order(&orders, levels.points[..levels.usable].last()),
    };
    let floors = running_maximum(samples.iter().map(|s| s.floor.clone()));
    let floor = floors.into_iter().last();
    let floor = floor.unwrap_or_else(|| Float::new(53));
    let mut notes = remarks::remarks(&levels, asymptote, &pairs, own_floor);
    if own_floor.is_none() {
        remark_missing_floor(verdict, !floor.is_zero(), &mut notes);
    }
    Ok(Fit {
        verdict,
        order,
        half_width,
        log2_constant,
        window,
        cut: levels.cut().map(|level| FloorCut {
            level,
            step: samples[level].step,
            floor: levels.floors[level].clone(),
        }),
        floor,
        pairs,
        notes,
    })
}

/// What is left to report without a window: the last order, its spread, its constant.
fn last_order(
    orders: &[f64],
    finest: Option<&(f64, f64)>,
) -> (Option<f64>, Option<f64>, Option<f64>) {
    let (Some(last), Some(finest)) = (orders.last(), finest) else {
        return (None, None, None);
    };
    let distance = |p: &f64| (p - last).abs();
    let spread = orders
        .iter()
        .rev()
        .take(3)
        .map(distance)
        .fold(0.0, f64::max);
    let width = match orders {
        [.., previous, _] => spread.max(2.0 * distance(previous)),
        _ => last.abs(),
    };
    (Some(*last), Some(width), Some(finest.1 - last * finest.0))
}
