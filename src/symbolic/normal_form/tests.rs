//! Identities, what is none, and what is not used because it fails somewhere.

use super::{Reduction, reduce};
use crate::symbolic::Expr;

fn of(text: &str) -> Reduction {
    reduce(&text.parse().unwrap_or_else(|e| panic!("{text}: {e}")))
}

/// I′ of I = (λ³ + 3λ)⁶ e^(−λ) sin⁶ 3λ / ((1 + λ)(2 + cos wλ)) by its logarithmic derivative, with 3 or
/// something else in its place.
fn derivative_identity(three: i32) -> Expr {
    let radiance: Expr = "((l^3 + 3*l)^6*exp(-l)*sin(3*l)^6)/((1 + l)*(2 + cos(w*l)))"
        .parse()
        .unwrap();
    let logarithmic: Expr = format!(
        "6*(3*l^2 + {three})/(l^3 + 3*l) - 1 + 18*cos(3*l)/sin(3*l) - 1/(1 + l) \
         + w*sin(w*l)/(2 + cos(w*l))"
    )
    .parse()
    .unwrap();
    radiance.differentiate("l") - radiance * logarithmic
}

#[test]
fn a_long_identity_is_decided() {
    assert_eq!(reduce(&derivative_identity(3)), Reduction::Zero);
    let wrong = reduce(&derivative_identity(4));
    assert!(matches!(wrong, Reduction::Nonzero { .. }), "{wrong:?}");
}

#[test]
fn identities() {
    for (text, zero) in [
        ("sin(x)^2 + cos(x)^2 - 1", true),
        ("sin(2*x) - 2*sin(x)*cos(x)", true),
        ("sin(2*x) - 2*sin(x)*sin(x)", false),
        ("1/(1+x) + x/(1+x) - 1", true),
        ("sqrt(x)*sqrt(x) - x", true),
        ("1/(1 + 1/(1+x)) - (1+x)/(2+x)", true),
        ("exp(x - 2*ln(y)) - exp(x)/y^2", true),
        ("tan(x) - sin(x)/cos(x)", true),
        ("1 + tan(x)^2 - 1/cos(x)^2", true),
        ("1 - tanh(x)^2 - 1/cosh(x)^2", true),
        ("sqrt(x^2) - x", false),
        ("abs(x) - x", false),
        ("abs(x)^2 - x^2", true),
        ("abs(-x) - abs(x)", true),
        ("ln(x*y) - ln(x) - ln(y)", false),
        ("ln(x^2) - 2*ln(x)", false),
        ("ln(6) - ln(2) - ln(3)", true),
        ("ln(1/x) + ln(x)", true),
        ("ln(exp(x)) - x", true),
        ("atan(tan(x)) - x", false),
        ("sin(x + pi) + sin(x)", true),
        ("cos(pi/2)", true),
        ("sin(5*pi/2) - 1", true),
        ("6*sqrt(3/4) - 3*sqrt(3)", true),
        ("sqrt(1/3) - sqrt(3)/3", true),
        ("sqrt(6) - sqrt(2)*sqrt(3)", true),
        ("x^(1/3)^3 - x", false),
        ("(x^(1/3))^3 - x", true),
        ("sqrt(4*x + 4) - 2*sqrt(1 + x)", true),
        ("erf(-x) + erf(x)", true),
        ("atan(x - y) + atan(y - x)", true),
        ("(x^2 - y^2)/(x - y) - x - y", true),
        ("exp(x) - exp(y)", false),
        ("1/sqrt(x) - sqrt(x)/x", true),
        ("sinh(2*x) - 2*sinh(x)*cosh(x)", true),
        ("exp(x/2)^2 - exp(x)", true),
        ("sqrt(exp(2*x)) - exp(x)", true),
    ] {
        let reduction = of(text);
        assert_eq!(reduction == Reduction::Zero, zero, "{text}: {reduction:?}");
    }
    assert_eq!(of("1/(x - x)"), Reduction::DivisionByZero);
    assert_eq!(of("ln(x - x)"), Reduction::DivisionByZero);
    assert_eq!(of("min(x, 1)"), Reduction::Branches);
    assert_eq!(of("(a+b+c+d+f+g)^30"), Reduction::TooLarge);
}
