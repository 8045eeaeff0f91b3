//! An order asserted of kernels that have it, and that have not.

use volver::assert::{OrderError, confirm_order};
use volver::assert_order;
use volver::kernel::BuiltIn;
use volver::real::FormatName;

fn built_in(method: &str) -> BuiltIn {
    BuiltIn::new(method.parse().unwrap(), FormatName::F64)
}

#[test]
fn the_right_order_passes() {
    assert_order!(built_in("trapezoid/trapezoid"), 2);
    assert_order!(built_in("front-to-back/front/expm1"), 1);
}

#[test]
#[should_panic(expected = "TooLow")]
fn an_order_too_high_panics_with_the_report() {
    assert_order!(built_in("front-to-back/front/expm1"), 2);
}

#[test]
fn an_order_that_is_none_is_refused() {
    let mut kernel = built_in("trapezoid/trapezoid");
    for order in [0.0, -1.0, f64::NAN] {
        let refused = confirm_order(&mut kernel, order);
        assert!(matches!(refused, Err(OrderError::Order { .. })));
    }
}
