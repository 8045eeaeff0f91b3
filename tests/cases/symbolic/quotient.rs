//! Quotients worked by hand, and what must not be cancelled.

use volver::symbolic::{Expr, expand, quotient};

fn of(numerator: &str, denominator: &str) -> String {
    let (a, b): (Expr, Expr) = (numerator.parse().unwrap(), denominator.parse().unwrap());
    quotient(&a, &b).map_or_else(|| "none".into(), |q| q.to_string())
}

#[test]
fn common_factors_cancel() {
    for (numerator, denominator, expected) in [
        ("x^2 - 1", "x - 1", "1 + x"),
        ("x^2 + 1", "x - 1", "(1 + x^2)/(-1 + x)"),
        ("x^3*sin(x)^2", "x*sin(x)", "x^2*sin(x)"),
        ("exp(-2*x) + exp(-x)", "exp(-x)", "exp(-x) + 1"),
        ("exp(2*x) - 1", "exp(x) - 1", "1 + exp(x)"),
        ("1/(1 + x)^2", "1/(1 + x)", "1/(1 + x)"),
        ("x/(1 + x)", "x", "1/(1 + x)"),
        ("x", "x*sqrt(x)", "1/sqrt(x)"),
        ("x - x", "x", "0"),
        ("x", "x - x", "none"),
        ("sin(-x)", "sin(x)", "-1"),
        ("cos(-2*x)", "cos(2*x)", "1"),
        ("2*x*y + 2*x", "4*x", "1/2 + 1/2*y"),
        ("sqrt(x^2)", "x", "sqrt(x^2)/x"),
        ("1/x + 1/(1 + x)", "1", "1/x + 1/(1 + x)"),
    ] {
        let (value, expected) = (of(numerator, denominator), expected.to_string());
        let same = expected == "none"
            || value == expected
            || expand(&(value.parse::<Expr>().unwrap() - expected.parse().unwrap()))
                .unwrap()
                .is(0);
        assert!(
            same,
            "({numerator})/({denominator}) = {value}, not {expected}"
        );
    }
}

#[test]
fn emission_of_the_paper_s_medium() {
    let depth: Expr = "sin(l^2)/2".parse().unwrap();
    let radiance: Expr = "2 - (sin(l^2) + 2)*exp(-sin(l^2)/2)".parse().unwrap();
    let extinction = expand(&depth.differentiate("l")).unwrap();
    assert_eq!(extinction.to_string(), "l*cos(l^2)");
    let weight = &extinction * &(-&depth).exp();
    let emission = quotient(&radiance.differentiate("l"), &weight).unwrap();
    assert_eq!(emission.to_string(), "sin(l^2)");
}

#[test]
fn what_is_too_long_is_left() {
    let long: Expr = "(a + b + c + d + e + f)^40".parse().unwrap();
    assert_eq!(expand(&long), None);
}
