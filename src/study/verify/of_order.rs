//! Methods of an order, each with another leading error.

use crate::method::Method;

/// Methods by their order: those that renderers use and textbooks have, each with another leading error.
const METHODS: [(f64, &[&str]); 4] = [
    (
        1.0,
        &[
            "front-to-back/front/expm1",
            "front-to-back/back/expm1",
            "riemann-left/riemann-left",
        ],
    ),
    (
        2.0,
        &[
            "front-to-back/middle/expm1",
            "trapezoid/trapezoid",
            "midpoint/midpoint",
        ],
    ),
    (4.0, &["simpson/simpson", "gauss-2/gauss-2"]),
    (6.0, &["boole/boole", "gauss-3/gauss-3"]),
];

/// The methods of that order; none where there is none.
#[must_use]
pub fn methods(order: f64) -> Vec<Method> {
    let names = METHODS
        .iter()
        .find(|(own, _)| (own - order).abs() < f64::EPSILON);
    let names = names.map_or(&[][..], |(_, names)| names);
    names.iter().filter_map(|name| name.parse().ok()).collect()
}
