//! Closed forms beside the integral.

use rug::Rational;
use volver::case::manufacture::{ManufactureError, manufacture};
use volver::case::{Case, Description, Formulas, SymbolicCase, catalogue};
use volver::confirm::confirm;

#[test]
fn the_catalogue_agrees_with_its_integrals() {
    for name in catalogue::names() {
        for made in manufacture(&catalogue::find(name).unwrap().unwrap()).unwrap() {
            assert_eq!(confirm(&made), Ok(()), "{name}");
        }
    }
}

/// As if a proof were wrong: the checks of one case on the closed forms of another.
#[test]
fn a_closed_form_that_is_not_the_integral_is_refused_whatever_was_proved() {
    let text = "name = 'a'\nlength = 2\ndepth = 'lambda'\nemission_of_depth = '1'";
    let made = manufacture(&Description::read(text).unwrap()).unwrap();
    let formulas = made[0].case.formulas().clone();
    let with = |depth: &str, radiance: &str| {
        let formulas = Formulas {
            optical_depth: Some(depth.parse().unwrap()),
            radiance: Some(radiance.parse().unwrap()),
            ..formulas.clone()
        };
        let mut made = made[0].clone();
        made.case =
            SymbolicCase::new("a", Rational::from(2), formulas, made.case.structure()).unwrap();
        made
    };
    let right = "1 - exp(-lambda)";
    assert_eq!(confirm(&with("lambda", right)), Ok(()));
    for (depth, radiance, wrong) in [
        ("piecewise(lambda < 2, lambda, 0)", right, "t(D)"),
        (
            "lambda",
            "piecewise(lambda < 2, 1 - exp(-lambda), 0)",
            "I(D)",
        ),
        ("lambda", "1 - exp(-lambda) + 1e-12", "I(D)"),
    ] {
        let error = confirm(&with(depth, radiance)).unwrap_err();
        let ManufactureError::Contradicted(contradiction) = &error else {
            panic!("{error}");
        };
        assert_eq!(contradiction.quantity, wrong);
        assert!(contradiction.is_proved);
        assert!(error.to_string().contains("a fault of volver"), "{error}");
    }
}
