//! Expressions over boxes.

use super::parse;
use quickcheck::QuickCheck;
use rug::Rational;
use volver::symbolic::{EncloseError, Expr, Interval, enclose_range};

fn over(text: &str, from: (i64, i64), to: (i64, i64)) -> Result<Interval, EncloseError> {
    let x = Interval::hull(53, &from.into(), &to.into());
    parse(text).enclose(53, &|name| (name == "x").then(|| x.clone()))
}

fn hull(from: (i64, i64), to: (i64, i64)) -> Interval {
    Interval::hull(53, &from.into(), &to.into())
}

#[test]
fn ranges() {
    for (text, from, to, expected) in [
        ("x^2", (-1, 1), (2, 1), ((0, 1), (4, 1))),
        ("x - x", (0, 1), (1, 1), ((-1, 1), (1, 1))),
        ("abs(x) - 1", (-3, 1), (2, 1), ((-1, 1), (2, 1))),
        ("min(x, 1/2)", (0, 1), (2, 1), ((0, 1), (1, 2))),
        ("max(x, 1/2)", (0, 1), (2, 1), ((1, 2), (2, 1))),
        ("1 - 1/x", (1, 2), (1, 1), ((-1, 1), (0, 1))),
        ("3*x^3/2", (-1, 1), (2, 1), ((-3, 2), (12, 1))),
        ("sqrt(x)", (1, 4), (4, 1), ((1, 2), (2, 1))),
        ("piecewise(x < 1/2, 3, x)", (0, 1), (1, 4), ((3, 1), (3, 1))),
        ("piecewise(x < 1/2, 3, x)", (1, 2), (1, 1), ((1, 2), (1, 1))),
        ("piecewise(x < 1/2, 3, x)", (0, 1), (1, 1), ((0, 1), (3, 1))),
        (
            "piecewise(x <= 1/2, 3, x)",
            (0, 1),
            (1, 2),
            ((3, 1), (3, 1)),
        ),
        ("piecewise(x > 1/2, 3, x)", (0, 1), (1, 2), ((0, 1), (1, 2))),
        (
            "piecewise(x >= 1/2, 3, x)",
            (1, 2),
            (1, 1),
            ((3, 1), (3, 1)),
        ),
        // What is not taken need not be defined.
        (
            "piecewise(x > 0, 1/x, 7)",
            (-2, 1),
            (-1, 1),
            ((7, 1), (7, 1)),
        ),
        (
            "piecewise(x < 9, 7, zeta)",
            (0, 1),
            (1, 1),
            ((7, 1), (7, 1)),
        ),
        // The middle branch cannot be taken.
        (
            "piecewise(x < 1/2, 0, 3 < 2, 1/0^x0, 1)",
            (0, 1),
            (1, 1),
            ((0, 1), (1, 1)),
        ),
        (
            "piecewise(1/3 < 1/3, 1, 2)",
            (0, 1),
            (1, 1),
            ((2, 1), (2, 1)),
        ),
        ("piecewise(x <= x, 1, 2)", (0, 1), (1, 1), ((1, 1), (1, 1))),
    ] {
        let text = text.replace("1/0^x0", "zeta");
        let result = over(&text, from, to);
        assert_eq!(result, Ok(hull(expected.0, expected.1)), "{text}");
    }
}

#[test]
fn undefined_parts_are_named() {
    for (text, from, to, part, certain) in [
        ("2 + 1/x", (-1, 1), (1, 1), "1/x", false),
        ("2 + 1/x", (0, 1), (0, 1), "1/x", true),
        ("ln(x)*0", (-2, 1), (-1, 1), "ln(x)", true),
        ("ln(x)", (0, 1), (1, 1), "ln(x)", false),
        ("sqrt(x - 2)", (0, 1), (1, 1), "sqrt(x - 2)", true),
        ("tan(x)", (1, 1), (2, 1), "tan(x)", false),
        // What is certain outweighs what comes first.
        ("1/x + ln(x - 9)", (-1, 1), (1, 1), "ln(x - 9)", true),
        (
            "piecewise(x < 0, 1/0^1, x)",
            (-1, 1),
            (1, 1),
            "ln(-1)",
            false,
        ),
        (
            "piecewise(x < 0, ln(-1), ln(-2))",
            (-1, 1),
            (1, 1),
            "ln(-1)",
            true,
        ),
        (
            "piecewise(x < 0, ln(-1), ln(-2))",
            (1, 1),
            (2, 1),
            "ln(-2)",
            true,
        ),
        (
            "piecewise(ln(-1) < x, 1, 2)",
            (1, 1),
            (2, 1),
            "ln(-1)",
            true,
        ),
        (
            "piecewise(x < 0, 1, ln(-1) < x, 1, 2)",
            (-1, 1),
            (2, 1),
            "ln(-1)",
            false,
        ),
    ] {
        let text = text.replace("1/0^1", "ln(-1)");
        let error = over(&text, from, to).unwrap_err();
        let part = parse(part).to_string();
        assert_eq!(error, EncloseError::NotDefined { part, certain }, "{text}");
    }
    let name = "y".to_owned();
    let error = over("x + 2*y", (0, 1), (1, 1)).unwrap_err();
    assert_eq!(error, EncloseError::UnknownSymbol { name });
    assert_eq!(error.to_string(), "y has no value");
    let error = over("1/x", (0, 1), (1, 1)).unwrap_err();
    assert_eq!(
        error.to_string(),
        "1/x is not known to be defined everywhere"
    );
}

#[test]
fn shared_failures_end_soon() {
    let mut expr = parse("1/x");
    for _ in 0..60 {
        expr = &expr + &expr.exp();
        expr = expr.min(&expr.exp());
    }
    let x = hull((-1, 1), (1, 1));
    assert!(matches!(
        Expr::enclose(&parse("1/x").min(&expr), 53, &|_| Some(x.clone())),
        Err(EncloseError::NotDefined { .. })
    ));
}

#[test]
fn expressions_contain_their_values() {
    fn check(from: i16, width: u16, place: u8) -> bool {
        let from = Rational::from((from, 4099));
        let width = Rational::from((width, 30_011));
        let at = &from + &width * Rational::from((place, 255));
        let to = Rational::from(&from + &width);
        for text in [
            "x^3 - 2*x + 1/3",
            "exp(-x^2)*sin(5*x) - x/7",
            "(sin(x^2) + 2)*exp(-sin(x^2)/2)",
            "piecewise(x < 1/2, x^2, x < 2, 3 - x, cos(x))",
            "max(x, 1 - x)*min(abs(x), 2)",
            "tanh(x)/(1 + x^2) + atan(x)^3*erf(x)",
            "sqrt(1 + x^2)^3 - cosh(x) + sinh(x)/pi",
        ] {
            let expr = parse(text);
            let exact = Interval::point(400, &at);
            let exact = expr.enclose(400, &|_| Some(exact.clone())).unwrap();
            let derivative = expr.differentiate("x");
            for bits in [24, 53] {
                let range = Interval::hull(bits, &from, &to);
                let natural = expr.enclose(bits, &|_| Some(range.clone())).unwrap();
                let tighter = enclose_range(&expr, &derivative, "x", &range).unwrap();
                for result in [natural, tighter] {
                    let inside = result.lower() <= exact.upper() && exact.lower() <= result.upper();
                    assert!(
                        inside,
                        "{text} on {range} at {at}: {result:.20} {exact:.30}"
                    );
                }
            }
        }
        true
    }
    QuickCheck::new()
        .tests(400)
        .quickcheck(check as fn(i16, u16, u8) -> bool);
}

#[test]
fn mean_values_are_tighter_and_know_jumps() {
    let range = hull((1, 1), (17, 16));
    let of = |text: &str, range: &Interval| {
        let expr = parse(text);
        enclose_range(&expr, &expr.differentiate("x"), "x", range).unwrap()
    };
    assert!(of("x - x^2", &range).width() < 0.071);
    assert!(over("x - x^2", (1, 1), (17, 16)).unwrap().width() > 0.18);
    // The derivative of a jump does not show it.
    let jump = of("piecewise(x < 1/2, 0, 1)", &hull((0, 1), (1, 1)));
    assert_eq!(jump, hull((0, 1), (1, 1)));
    // Kinks are no jumps: |x| is known by itself, its derivative has a pole at 0.
    let kink = of("abs(x)", &hull((-1, 1), (1, 1)));
    assert_eq!(kink, hull((0, 1), (1, 1)));
    let kink = of("max(x, 0) - x", &hull((-1, 1), (1, 1)));
    assert!(*kink.lower() <= 0 && *kink.upper() >= 1);
}
