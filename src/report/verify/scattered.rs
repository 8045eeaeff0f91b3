//! The words for a kernel that draws random numbers: its error has two parts.

use super::empty::NONE;
use crate::convergence::{ErrorPart, OrderInterval, StochasticFit};

/// What the letters in a row of a terminal mean.
pub(super) const LETTERS: &str =
    "s scatter: the standard deviation over seeds, b bias: the mean error, the larger first";

/// The parts, the larger first.
fn parts(fit: &StochasticFit) -> [ErrorPart; 2] {
    match fit.larger {
        ErrorPart::Scatter => [ErrorPart::Scatter, ErrorPart::Bias],
        ErrorPart::Bias => [ErrorPart::Bias, ErrorPart::Scatter],
    }
}

/// "s 1.50±0.11", "b 2.01±0.30", the larger part first; "b <0.9" where an end is open, "b ?" where a bias is seen and no
/// order of it.
pub(super) fn short(fit: &StochasticFit) -> [String; 2] {
    parts(fit).map(|part| {
        let letter = match part {
            ErrorPart::Scatter => "s",
            ErrorPart::Bias => "b",
        };
        let order = of(fit, part, 2).replace(" ± ", "±");
        if order == NONE {
            order
        } else {
            format!("{letter} {order}")
        }
    })
}

/// "scatter 1.500 ± 0.110; bias 2.012 ± 0.301", the larger part first.
pub(super) fn both(fit: &StochasticFit) -> String {
    let named = parts(fit).map(|part| {
        let name = match part {
            ErrorPart::Scatter => "scatter",
            ErrorPart::Bias => "bias",
        };
        (name, of(fit, part, 3))
    });
    let named = named.iter().filter(|(_, order)| order != NONE);
    let named: Vec<String> = named
        .map(|(name, order)| format!("{name} {order}"))
        .collect();
    if named.is_empty() {
        NONE.into()
    } else {
        named.join("; ")
    }
}

fn of(fit: &StochasticFit, part: ErrorPart, digits: usize) -> String {
    match fit.order_of(part) {
        Some(OrderInterval {
            order, low, high, ..
        }) => {
            let half_width = (high - low) / 2.0;
            match (low.is_finite(), high.is_finite()) {
                (true, true) => format!("{order:.digits$} ± {half_width:.digits$}"),
                (false, true) => format!("<{high:.1}"),
                (true, false) => format!(">{low:.1}"),
                (false, false) => "?".into(),
            }
        }
        None if part == ErrorPart::Bias && fit.bias_may_stay => "?".into(),
        None => NONE.into(),
    }
}

/// How large the errors of every level are: the larger part of each.
pub(super) fn sizes(fit: &StochasticFit) -> Vec<f64> {
    let size = fit.levels.iter().map(|level| {
        let bias = if level.biased { level.mean.abs() } else { 0.0 };
        level.deviation.max(bias)
    });
    size.collect()
}
