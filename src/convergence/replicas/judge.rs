//! What replicas say of an expectation.

use super::bias::Bias;
use super::scatter::Scatter;
use super::{ErrorPart, OrderInterval, StochasticFit};
use crate::convergence::verdict::{MAX_HALF_WIDTH, NO_CONVERGENCE, Verdict};
use crate::convergence::window::MIN_WINDOW;
use crate::method::Expected;

/// The verdict of finite errors.
pub(super) fn judge(
    fit: &StochasticFit,
    scatter: &Scatter,
    bias: &Bias,
    expected: Option<Expected>,
) -> Verdict {
    let blind = matches!(expected, Some(Expected::Blind { .. }));
    let unless_blind = |verdict| if blind { Verdict::Blind } else { verdict };
    if fit.levels.len() < MIN_WINDOW {
        return Verdict::TooFewLevels;
    }
    if fit.levels.iter().all(|l| !l.above_floor && !l.biased) {
        return unless_blind(Verdict::Exact);
    }
    if let Some(verdict) =
        stays(scatter.interval).or_else(|| stays(bias.interval.filter(|_| bias.seen)))
    {
        return verdict;
    }
    if blind {
        return Verdict::Blind;
    }
    let unsettled = if fit.levels.iter().any(|l| !l.above_floor) {
        Verdict::FloorLimited
    } else {
        Verdict::PreAsymptotic
    };
    // Of a stochastic method there is nothing to confirm where no seed has any effect.
    if fit.levels.iter().all(|l| l.deviation == 0.0) {
        return unsettled;
    }
    let narrow = |part| fit.order_of(part).filter(is_narrow);
    match expected {
        None | Some(Expected::Unknown | Expected::Blind { .. }) => {
            narrow(fit.larger).map_or(unsettled, |_| Verdict::Fitted)
        }
        Some(Expected::Exact) => narrow(fit.larger).map_or(unsettled, |_| Verdict::TooLow),
        Some(Expected::Order(p)) => {
            if scatter.is_below(p) || bias.is_below(p) {
                Verdict::TooLow
            } else if bias.may_stay() {
                unsettled
            } else if is_confirmed(fit, scatter, p) {
                Verdict::Confirmed
            } else if is_higher(fit, scatter, p) {
                Verdict::TooHigh
            } else {
                unsettled
            }
        }
    }
}

fn is_narrow(interval: &OrderInterval) -> bool {
    interval.half_width() <= MAX_HALF_WIDTH
}

/// A part that does not converge: `Stalled` or `Diverged`, by the sign of what is left of its order.
fn stays(part: Option<OrderInterval>) -> Option<Verdict> {
    let part = part.filter(is_narrow)?;
    if part.order <= -NO_CONVERGENCE {
        Some(Verdict::Diverged)
    } else if part.order < NO_CONVERGENCE {
        Some(Verdict::Stalled)
    } else {
        None
    }
}

/// The order of the error is the lower one of its parts. The scatter may show it while a larger bias has a higher order.
fn is_confirmed(fit: &StochasticFit, scatter: &Scatter, p: f64) -> bool {
    let shows = |part: Option<OrderInterval>| part.is_some_and(|i| is_narrow(&i) && i.holds(p));
    let finest_agree = scatter
        .finest
        .is_some_and(|(low, high)| low <= p && p <= high);
    let scatter_shows = shows(fit.deviation) && finest_agree;
    match fit.larger {
        ErrorPart::Scatter => scatter_shows,
        ErrorPart::Bias => {
            let is_higher = fit.bias.is_some_and(|bias| bias.low > p);
            shows(fit.bias) || is_higher && scatter_shows
        }
    }
}

/// All parts that are seen have higher orders.
fn is_higher(fit: &StochasticFit, scatter: &Scatter, p: f64) -> bool {
    let scatters = fit.levels.last().is_some_and(|level| level.above_floor);
    let scatter_is = scatter.is_above(p) || !scatters && fit.larger == ErrorPart::Bias;
    scatter_is && fit.bias.is_none_or(|bias| bias.low > p)
}
