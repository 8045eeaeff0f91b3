//! The order that theory gives a method on a case.

/// What theory says of a method's error on a case as the step d → 0.
///
/// An order belongs to a method *on a case*: see [`expected`](super::expected).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Expected {
    /// |e| = O(d^p). An order of 0 says that the method does not converge.
    Order(f64),
    /// No discretization error at all.
    Exact,
    /// The leading error coefficient vanishes on this case: it shows another order than the method
    /// has, and neither passes nor fails it.
    Blind {
        /// The method's order on cases in general.
        general: f64,
        /// The order this case shows.
        here: f64,
    },
    /// Theory does not say: whatever is measured neither confirms nor contradicts it.
    Unknown,
}
