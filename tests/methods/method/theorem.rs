//! Which orders have a theorem behind them.

use volver::case::manufacture::manufacture;
use volver::case::{Case, HomogeneousSlab, SineSquared, catalogue};
use volver::method::Method;

fn theorem_on<C: Case>(method: &str, case: &C) -> Option<&'static str> {
    let method: Method = method.parse().unwrap();
    method
        .theorem(&case.structure())
        .map(|theorem| theorem.name)
}

#[test]
fn orders_have_the_theorem_that_is_about_them() {
    let proved = [
        (
            "riemann-left/riemann-left",
            Some("nested_riemann_first_order"),
        ),
        ("trapezoid/trapezoid", Some("nested_trapezoid_second_order")),
        ("simpson/simpson", Some("nested_simpson_fourth_order")),
        ("simpson/trapezoid", Some("nested_bound")),
        ("gauss-3/boole", Some("nested_bound")),
        (
            "simpson/simpson/linear",
            Some("linear_exponential_first_order"),
        ),
        ("simpson/simpson/quadratic", None),
        ("simpson-pairs-parabola/simpson", None),
        ("front-to-back/middle/expm1", None),
    ];
    for (method, name) in proved {
        assert_eq!(theorem_on(method, &SineSquared), name, "{method}");
    }
}

#[test]
fn another_order_than_the_theorems_has_none() {
    // The depth of a constant medium is exact: order 2 is the outer rule's, the theorem says min(1, 2).
    let slab = HomogeneousSlab {
        length: 2.into(),
        extinction: 1.into(),
        emission: 1.into(),
    };
    assert_eq!(theorem_on("riemann-left/trapezoid", &slab), None);
    assert_eq!(
        theorem_on("trapezoid/trapezoid", &slab),
        Some("nested_trapezoid_second_order")
    );
}

#[test]
fn breaks_are_beyond_the_theorems() {
    let kink = catalogue::find("kink-off-node").unwrap().unwrap();
    let kink = manufacture(&kink).unwrap().remove(0).case;
    assert_eq!(theorem_on("riemann-left/riemann-left", &kink), None);
}
