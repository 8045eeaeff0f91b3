//! Where errors of a high order end: something else is larger than discretization.

use super::{Line, Measured};
use crate::convergence::Fit;
use crate::method::Expected;
use serde::Serialize;

/// Orders from here on reach rounding on ladders that lower orders need.
const HIGH: f64 = 2.5;
/// Pairwise orders below this fall no more.
const FALLING: f64 = 0.5;

/// From where on levels do not show the order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
pub struct Beyond {
    /// Segments of the finest level that still shows discretization.
    pub n: u64,
    /// What takes over.
    pub by: TakesOver,
}

/// What is larger than discretization at fine levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[cfg_attr(feature = "studies", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum TakesOver {
    /// Rounding, as much as the format allows.
    Rounding,
    /// More than rounding, which stays where it is: a series that ends, a table, a constant of fewer digits.
    Other,
}

impl Line {
    /// From where on it does not show its order, of an order of three or more.
    #[must_use]
    pub fn beyond(&self) -> Option<Beyond> {
        let Measured::Fitted { fit, samples } = &self.measured else {
            return None;
        };
        let order = match self.expected {
            Some(Expected::Order(order)) => Some(order),
            Some(_) => None,
            None => self.measured.order().map(|(order, _)| order),
        };
        order.filter(|order| *order > HIGH)?;
        let (level, by) = match &fit.cut {
            Some(cut) => (cut.level.checked_sub(1)?, TakesOver::Rounding),
            None => (levels_off(fit)?, TakesOver::Other),
        };
        samples.get(level)?.n.map(|n| Beyond { n, by })
    }
}

/// The level from which on errors stay, where they fell before by a high order.
fn levels_off(fit: &Fit) -> Option<usize> {
    let stay = fit
        .pairs
        .iter()
        .rev()
        .take_while(|pair| pair.order < FALLING);
    let first = stay.last()?.coarse;
    let mut before = fit.pairs.iter().take_while(|pair| pair.coarse < first);
    before.any(|pair| pair.order > HIGH).then_some(first)
}
