//! Orders of levels.

use super::measured::{Level, TENTH};
use super::norms::Norms;
use crate::convergence::{Fit, Sample, Verdict, fit};
use crate::image::Image;
use crate::method::Expected;
use rug::Float;

/// Of the errors of the others a fit takes this part for the floor, which cuts at 30 floors.
const FLOOR: f64 = 1.0 / (30.0 * TENTH);
/// What rounding in binary64 leaves of a difference, relative to the brightest pixel.
pub(super) const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Whether an order was found, or that there is nothing left to be one of.
pub(super) fn is_settled(fit: Option<&Fit>) -> bool {
    fit.is_some_and(|fit| fit.verdict.is_of_an_order() || fit.verdict == Verdict::Exact)
}

/// Whether there are differences, and all of them are rounding.
pub(super) fn changes_nothing(differences: &[Level]) -> bool {
    let is_rounding = |level: &Level| level.all.values > 0 && level.all.max <= level.others;
    !differences.is_empty() && differences.iter().all(is_rounding)
}

pub(super) fn brightest(image: Option<&Image>) -> f64 {
    let values = image.into_iter().flat_map(|image| &image.values);
    values.fold(0.0, |most: f64, value| most.max(value.abs()))
}

/// The order of L2 over smooth pixels.
pub(super) fn fitted(levels: &[Level], expected: Option<f64>) -> Option<Fit> {
    let samples: Vec<Sample> = levels
        .iter()
        .map(|level| Sample {
            n: Some(level.count as u64),
            step: level.size,
            error: Float::with_val(53, level.smooth.l2),
            floor: Float::with_val(53, FLOOR * level.others),
        })
        .collect();
    fit(&samples, expected.map(Expected::Order)).ok()
}

/// Orders of max, L1 and L2 over all pixels, between the two finest levels.
pub(super) fn orders(levels: &[Level]) -> [Option<f64>; 3] {
    let [.., before, last] = levels else {
        return [None; 3];
    };
    let ratio = (last.count as f64 / before.count as f64).ln();
    let order = |of: fn(&Norms) -> f64| {
        let order = (of(&before.all) / of(&last.all)).ln() / ratio;
        order.is_finite().then_some(order)
    };
    [order(|n| n.max), order(|n| n.l1), order(|n| n.l2)]
}
