//! Identities stand, whatever is not one falls.

use super::parse;
use rug::Rational;
use volver::symbolic::{Interval, refute_zero};

fn range(name: &str, from: i32, to: i32) -> (String, Rational, Rational) {
    (name.to_owned(), from.into(), to.into())
}

#[test]
fn identities_are_not_refuted() {
    for text in [
        "0",
        "x - x",
        "sin(x)^2 + cos(x)^2 - 1",
        "exp(x + y) - exp(x)*exp(y)",
        "ln(x*y) - ln(x) - ln(y)",
        "tanh(x) - sinh(x)/cosh(x)",
        "abs(x) - max(x, -x)",
        "piecewise(x < 1/2, x, 1 - x) - min(x, 1 - x)",
        "atan(x) + atan(1/x) - pi/2",
        "1/(x - x)",
    ] {
        assert_eq!(refute_zero(&parse(text), &[]), None, "{text}");
    }
}

#[test]
fn what_is_not_zero_is_refuted() {
    for text in [
        "1",
        "x",
        "x - 5/8",
        "sin(pi*x/3) - cos(pi*y)",
        "sin(x)^2 + cos(x)^2 - 1 + 1/10^40",
        "exp(x + y) - exp(x)*exp(y)*(1 + z/10^60)",
        "piecewise(x < 1/2, 0, x < 501/1000, 1/10^9, 0)",
        "piecewise(y < 1/2, 0, y < 501/1000, x, 0)",
        "sqrt(x - 1)",
        "1/(2*x - 5/4) - 7",
        "a + b + c + d + e + f + g + h + i + j + k + l - m - n - o",
    ] {
        let expr = parse(text);
        let witness = refute_zero(&expr, &[]).unwrap_or_else(|| panic!("{text}"));
        assert!(!witness.value.contains_zero());
        let again = expr.enclose(256, &|name| {
            let (_, q) = witness.at.iter().find(|(known, _)| known == name)?;
            Some(Interval::point(256, q))
        });
        assert!(again.unwrap().intersection(&witness.value).is_some());
    }
}

#[test]
fn points_are_in_their_ranges() {
    // Only defined far from the usual range.
    let expr = parse("sqrt(x - 10)*y");
    assert_eq!(refute_zero(&expr, &[]), None);
    let ranges = [range("x", 12, 10), range("y", -3, -2)];
    let witness = refute_zero(&expr, &ranges).unwrap();
    assert_eq!(witness.at[0], ("x".to_owned(), Rational::from(11)));
    assert_eq!(witness.at[1], ("y".to_owned(), Rational::from((-8, 3))));
    assert!(witness.value.is_negative());
    let single = refute_zero(&parse("x - 1"), &[range("x", 1, 1)]);
    assert_eq!(single, None);
}
