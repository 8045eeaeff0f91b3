//! Which order a kernel has to show on a case.

use super::asked::{Wanted, depth_rule};
use super::{Axis, Settings, Steps};
use crate::case::{Case, Structure};
use crate::kernel::{Declaration, FormKind, Quantity};
use crate::method::{Expected, Inner, Method, expected, expected_on};

/// The order of linear interpolation between grid points.
const GRID_ORDER: f64 = 2.0;

/// What is expected; `None` where nobody claims anything.
///
/// A method's order on a case follows from theory. An order that is only claimed counts on smooth cases, where it is
/// the least that may show; on all others theory does not say.
pub(super) fn of(
    declaration: &Declaration,
    settings: &Settings,
    wanted: &Wanted,
) -> Option<Expected> {
    let case = &wanted.case;
    let structure = case.structure();
    let general = |order: f64| {
        if is_smooth(&structure) {
            Expected::Order(order)
        } else {
            Expected::Unknown
        }
    };
    if let Some(order) = &settings.expect {
        return Some(general(order.to_f64()));
    }
    if settings.axis == Axis::Grid {
        // A kernel that looks up its grid says nothing of how: linear between points is what it is given.
        return Some(general(GRID_ORDER));
    }
    let is_other = wanted.quantity != Quantity::Radiance || wanted.background != 0.0;
    if is_other && let Some(method) = declaration.method {
        return Some(of_other(
            &method,
            wanted,
            (declaration, settings),
            &structure,
            &general,
        ));
    }
    match (declaration.method, declaration.order) {
        (Some(method), _) if declaration.form == FormKind::Volume => {
            // Breaks lie on nodes: those of a grid do, on ladders that the grid divides.
            Some(method.order())
        }
        // One sample stands for the wall, up to a step in front of it.
        (Some(_), _) if declaration.far_wall => Some(Expected::Order(1.0)),
        (Some(method), _) if settings.steps == Steps::Divide => {
            Some(expected_on(&method, case, &settings.ladder))
        }
        (Some(method), _) => Some(expected(&method, case)),
        (None, Some(order)) => Some(general(order)),
        (None, None) => None,
    }
}

/// What is expected of another quantity than the radiance of a method, or of one before a background.
///
/// A composite has the opacity that its weights add up to, which is a radiance like others, lets through as much of a
/// background as is left, and sums its depth by a rule. Of other methods, and of a mean depth, which may be taken at other
/// places than the samples, nobody knows how a kernel makes them: the order of the method is the least that may show.
fn of_other(
    method: &Method,
    wanted: &Wanted,
    (declaration, settings): (&Declaration, &Settings),
    structure: &Structure,
    general: &dyn Fn(f64) -> Expected,
) -> Expected {
    let of_samples = declaration.form != FormKind::Volume && !declaration.far_wall;
    match (wanted.quantity, method) {
        (Quantity::Radiance | Quantity::Opacity, Method::Composited(_)) if of_samples => {
            if settings.steps == Steps::Divide {
                expected_on(method, &wanted.case, &settings.ladder)
            } else {
                expected(method, &wanted.case)
            }
        }
        (Quantity::OpticalDepth | Quantity::Emission, Method::Composited(compositing))
            if of_samples =>
        {
            match depth_rule(compositing) {
                Some((_, rule)) => Inner::PerSegment(rule).expected(structure),
                None => Expected::Unknown,
            }
        }
        // One sample stands for the wall, up to a step in front of it.
        _ if declaration.far_wall => general(1.0),
        _ => declaration
            .claimed_order()
            .map_or(Expected::Unknown, general),
    }
}

/// Whether a method of any order shows at least that order on a case of that structure.
fn is_smooth(structure: &Structure) -> bool {
    structure.breaks.is_empty() && !structure.source_is_zero()
}
