//! Which order a kernel has to show on a case.

use super::{Axis, Settings, Steps};
use crate::case::{Case, Structure, SymbolicCase};
use crate::kernel::{Declaration, FormKind};
use crate::method::{Expected, expected, expected_on};

/// The order of linear interpolation between grid points.
const GRID_ORDER: f64 = 2.0;

/// What is expected; `None` where nobody claims anything.
///
/// A method's order on a case follows from theory. An order that is only claimed counts on smooth cases, where it is
/// the least that may show; on all others theory does not say.
pub(super) fn of(
    declaration: &Declaration,
    settings: &Settings,
    case: &SymbolicCase,
) -> Option<Expected> {
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

/// Whether a method of any order shows at least that order on a case of that structure.
fn is_smooth(structure: &Structure) -> bool {
    structure.breaks.is_empty() && !structure.source_is_zero()
}
