//! Which methods are recipes.

use volver::diagnosis::{OpacityModel, Places, Recipe};

#[test]
fn methods_that_composite_are_recipes() {
    let of = |name: &str| Recipe::of_method(&name.parse().unwrap());
    assert_eq!(of("front-to-back/front/expm1"), Some(Recipe::default()));
    assert_eq!(of("tree/front/subtraction"), Some(Recipe::default()));
    let unattenuated = of("front-to-back/back/linear/depths").unwrap();
    assert_eq!(unattenuated.opacity, OpacityModel::Unattenuated);
    assert_eq!(unattenuated.places, Places::Back);
    assert_eq!(of("trapezoid/trapezoid").unwrap().places, Places::Ends);
    assert_eq!(of("simpson/trapezoid"), None);
    assert_eq!(of("trapezoid/trapezoid/linear"), None);
    let left = of("riemann-left/riemann-left/linear").unwrap();
    assert_eq!(left.opacity, OpacityModel::Linear);
    let stopped = of("front-to-back/middle/linear/stop=1:255").unwrap();
    assert_eq!(stopped.stop, Some(1.0 / 255.0));
}
