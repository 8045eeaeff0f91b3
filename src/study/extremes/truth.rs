//! What a kernel should answer, without rounding.

use super::scenario::{emission, largest_extinction, last_extinction, rectified};
use crate::case::{Case, Fresh};
use crate::kernel::{Declaration, DepthWeights, Quantity};
use crate::method::Method;
use crate::real::{Mpfr, MpfrReal, Real};
use crate::study::stress::{Kind, Medium, ORACLE_BITS, Scenario, exact};
use rug::Float;

/// The length that renderers give the last segment to make a wall of it.
const WALL_LENGTH: u64 = 10_000_000_000;
/// A wall of that depth is opaque to more digits than formats have.
const OPAQUE: u32 = 100;

/// The right answers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Truth {
    /// Of the medium: τ below 0 counts as 0. `None` where that is not known, or there is none.
    pub(super) exact: Option<Float>,
    /// Whether there is one, known or not.
    pub(super) exists: bool,
    /// Of τ below 0 as it is, where it is.
    pub(super) amplified: Option<Float>,
    /// What the declared method gives, without rounding; else the truth.
    pub(super) of_method: Option<Float>,
}

pub(super) fn truth(scenario: &Scenario, quantity: Quantity, declaration: &Declaration) -> Truth {
    let medium = &scenario.medium;
    let positive = rectified(medium);
    let of = |medium: &Medium| of_medium(medium, quantity, declaration);
    let exact = of(positive.as_ref().unwrap_or(medium));
    let method = declaration
        .method
        .filter(|_| quantity == Quantity::Radiance && !declaration.far_wall);
    let of_method = match method {
        Some(method) => by_method(positive.as_ref().unwrap_or(medium), &method, scenario.n),
        None => exact.clone(),
    };
    let amplified = positive.is_some().then(|| match method {
        Some(method) => by_method(medium, &method, scenario.n),
        None => of(medium),
    });
    // Behind a wall nothing is seen of it.
    let amplified = amplified
        .flatten()
        .filter(|all| Some(all) != of_method.as_ref());
    Truth {
        exists: exact.is_some() || exists(medium, quantity, declaration),
        exact,
        amplified,
        of_method,
    }
}

/// What a method gives on n segments; `None` where it cannot run.
fn by_method(medium: &Medium, method: &Method, n: u64) -> Option<Float> {
    if let Ok(kind) = Kind::of(method) {
        return Some(exact(medium, method, kind, n).ok()?.approximation);
    }
    let nodes = Fresh::new(medium, Mpfr { bits: ORACLE_BITS });
    Some(method.radiance(&nodes, n).ok()?.to_float())
}

fn of_medium(medium: &Medium, quantity: Quantity, declaration: &Declaration) -> Option<Float> {
    let end = MpfrReal::from(Float::with_val(ORACLE_BITS, medium.length()));
    let depth: Float = medium.optical_depth(&end)?.into();
    let opacity = if declaration.far_wall {
        before_wall(medium)?
    } else {
        Float::with_val(ORACLE_BITS, -(-depth.clone()).exp_m1())
    };
    match quantity {
        Quantity::Radiance => Some(opacity * emission(medium)),
        Quantity::Opacity => Some(opacity),
        Quantity::OpticalDepth => Some(depth),
        // A sum over samples, which no rule has exactly.
        Quantity::ExpectedDepth | Quantity::Emission => None,
    }
}

/// Whether an answer that is not known is a number: a mean depth has none where nothing absorbs.
fn exists(medium: &Medium, quantity: Quantity, declaration: &Declaration) -> bool {
    let is_mean = quantity == Quantity::ExpectedDepth
        && declaration.expected_depth == DepthWeights::ByOpacity;
    !is_mean || largest_extinction(medium) != 0
}

/// 1 − T of a ray that ends at a wall of its last sample; `None` where the wall is neither opaque nor clear.
fn before_wall(medium: &Medium) -> Option<Float> {
    let last = last_extinction(medium);
    if last == 0 {
        return Some(Float::new(ORACLE_BITS));
    }
    let is_opaque = last * WALL_LENGTH >= OPAQUE;
    is_opaque.then(|| Float::with_val(ORACLE_BITS, 1))
}
