//! What theory expects of some methods on a case, and the theorems behind it.

use crate::case::Case;
use crate::case::manufacture::Manufactured;
use crate::method::{Expected, Method, expected};

/// Methods that say the most with the fewest lines: `volver study` takes all of them.
const METHODS: [&str; 7] = [
    "riemann-left/riemann-left",
    "trapezoid/trapezoid",
    "simpson/trapezoid",
    "simpson/simpson",
    "gauss-3/boole",
    "simpson/simpson/linear",
    "front-to-back/middle/expm1",
];

/// A method's name, the order expected of it, and the theorem behind that.
pub(super) struct Order {
    pub(super) method: &'static str,
    pub(super) expected: String,
    pub(super) theorem: Option<&'static str>,
}

/// What theory expects of each of the methods on the case.
pub(super) fn orders(case: &Manufactured) -> Vec<Order> {
    let structure = case.case.structure();
    let methods = METHODS
        .iter()
        .filter_map(|name| Some((*name, name.parse().ok()?)));
    let order = |(name, method): (&'static str, Method)| Order {
        method: name,
        expected: match expected(&method, &case.case) {
            Expected::Order(order) => order.to_string(),
            Expected::Exact => "exact".into(),
            Expected::Blind { general, here } => format!("{general} (shows {here})"),
            Expected::Unknown => "unknown".into(),
        },
        theorem: method
            .theorem(&structure)
            .filter(|_| case.meets_theorems())
            .map(|theorem| theorem.name),
    };
    methods.map(order).collect()
}
