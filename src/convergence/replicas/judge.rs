//! What replicas say of an expectation.

use super::StochasticFit;
use crate::convergence::verdict::{MAX_HALF_WIDTH, NO_CONVERGENCE, Verdict};
use crate::convergence::window::MIN_WINDOW;
use crate::method::Expected;

/// A bias dominates where it exceeds the standard deviation by this many standard errors.
const DOMINANT: f64 = 3.0;

/// The verdict of finite errors.
pub(super) fn judge(fit: &StochasticFit, expected: Option<Expected>) -> Verdict {
    let blind = matches!(expected, Some(Expected::Blind { .. }));
    if fit.levels.len() < MIN_WINDOW {
        return Verdict::TooFewLevels;
    }
    if fit.levels.iter().all(|l| !l.above_floor && !l.biased) {
        return if blind {
            Verdict::Blind
        } else {
            Verdict::Exact
        };
    }
    if let (Some(bias), Some(finest)) = (fit.bias, fit.levels.last()) {
        let dominates = finest.mean.abs() - DOMINANT * finest.standard_error > finest.deviation;
        if dominates && bias.order < NO_CONVERGENCE {
            return no_convergence(bias.order);
        }
    }
    let cut = fit.levels.iter().any(|l| !l.above_floor);
    let Some(deviation) = fit.deviation else {
        return if blind {
            Verdict::Blind
        } else {
            Verdict::FloorLimited
        };
    };
    if deviation.order < NO_CONVERGENCE {
        return no_convergence(deviation.order);
    }
    if blind {
        return Verdict::Blind;
    }
    if (deviation.high - deviation.low) / 2.0 > MAX_HALF_WIDTH {
        return if cut {
            Verdict::FloorLimited
        } else {
            Verdict::PreAsymptotic
        };
    }
    match expected {
        None | Some(Expected::Unknown) => Verdict::Fitted,
        Some(Expected::Order(p)) if p > deviation.high => Verdict::TooLow,
        Some(Expected::Order(p)) if p < deviation.low => Verdict::TooHigh,
        Some(Expected::Order(_)) => Verdict::Confirmed,
        Some(Expected::Exact) => Verdict::TooLow,
        Some(Expected::Blind { .. }) => Verdict::Blind,
    }
}

/// `Stalled` or `Diverged`, by the sign of what is left of the order.
fn no_convergence(order: f64) -> Verdict {
    if order <= -NO_CONVERGENCE {
        Verdict::Diverged
    } else {
        Verdict::Stalled
    }
}
