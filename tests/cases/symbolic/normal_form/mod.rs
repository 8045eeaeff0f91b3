//! Identities, near misses, and random expressions.

mod evaluate;
mod random;

use super::parse;
use volver::symbolic::{Expr, Function, Reduction, reduce};

fn is_identically_zero(expr: &Expr) -> bool {
    reduce(expr) == Reduction::Zero
}

#[test]
fn ten_identities() {
    let d = |text: &str| parse(text).differentiate("x").to_string();
    for (left, right, equal) in [
        ("sin(x)^2 + cos(x)^2", "1", true),
        ("sin(2*x)", "2*sin(x)*cos(x)", true),
        ("sin(2*x)", "2*sin(x)*sin(x)", false),
        (&d("ln(1 + x^2)"), "2*x/(1 + x^2)", true),
        ("1/(1 + x) + x/(1 + x)", "1", true),
        ("sqrt(x)*sqrt(x)", "x", true),
        (&d("sqrt(1 + x)"), "1/2/sqrt(1 + x)", true),
        ("1/(1 + 1/(1 + x))", "(1 + x)/(2 + x)", true),
        ("exp(x - 2*ln(y))", "exp(x)/y^2", true),
        (&d("exp(-x)"), "exp(-x)", false),
    ] {
        let difference = parse(left) - parse(right);
        let reduction = reduce(&difference);
        assert_eq!(
            reduction == Reduction::Zero,
            equal,
            "{left} = {right}: {reduction:?}"
        );
    }
}

/// f′ − f·(ln f)′ of a product of powers, with `three` in one place: 0 only for 3.
fn logarithmic_derivative(three: i32) -> Expr {
    let f = parse("((l^3+3*l)^6*exp(-l)*sin(3*l)^6)/((1+l)*(2+cos(w*l)))");
    let rate = parse(&format!(
        "6*(3*l^2+{three})/(l^3+3*l) - 1 + 18*cos(3*l)/sin(3*l) - 1/(1+l) + w*sin(w*l)/(2+cos(w*l))"
    ));
    f.differentiate("l") - f * rate
}

#[test]
fn a_product_of_powers_has_its_logarithmic_derivative() {
    for (three, zero) in [(3, true), (4, false)] {
        let reduction = reduce(&logarithmic_derivative(three));
        assert_eq!(reduction == Reduction::Zero, zero, "{reduction:?}");
    }
}

#[test]
fn identities() {
    for text in [
        "sin(x + pi) + sin(x)",
        "cos(x + pi/2) + sin(x)",
        "sin(pi/6) - 1/2",
        "cos(pi/12) - (sqrt(6) + sqrt(2))/4",
        "sin(5*pi/12)*4 - sqrt(6) - sqrt(2)",
        "tan(-3*pi/4) - 1",
        "cos(7*pi/5) + cos(2*pi/5)",
        "sin(ln(1 + x^2)/y)^2 + cos(ln(1 + x^2)/y)^2 - 1",
        "cosh(sin(x))^2 - sinh(sin(x))^2 - 1",
        "tanh(2*x) - 2*tanh(x)/(1 + tanh(x)^2)",
        "tan(2*x) - 2*tan(x)/(1 - tan(x)^2)",
        "(x^(1/3))^3 - x",
        "sqrt(x)*x^(1/3) - x^(5/6)",
        "1/sqrt(x) - sqrt(x)/x",
        "sqrt(8) - 2*sqrt(2)",
        "sqrt(2)*sqrt(3) - sqrt(6)",
        "(27/8)^(2/3) - 9/4",
        "sqrt(1018081) - 1009",
        "sqrt(4*x + 4) - 2*sqrt(1 + x)",
        "sqrt(x^2) - abs(x)",
        "sqrt(1/(1 + x)) - 1/sqrt(1 + x)",
        "sqrt(exp(2*x)) - exp(x)",
        "abs(x)^2 - x^2",
        "1/abs(x) - abs(x)/x^2",
        "abs(-2*x*y) - 2*abs(x)*abs(y)",
        "abs(1 - x) - abs(x - 1)",
        "abs(exp(sin(x))) - exp(sin(x))",
        "abs(sqrt(x)) - sqrt(x)",
        "erf(-x) + erf(x)",
        "atan(1 - x) + atan(x - 1)",
        "erf(0) + atan(x - x)",
        "ln(exp(sin(x))) - sin(x)",
        "ln(2*exp(x)) - x - ln(2)",
        "ln(12) - 2*ln(2) - ln(3)",
        "ln(4*x) - 2*ln(2) - ln(x)",
        "ln(1/x) + ln(x)",
        "ln(sqrt(1 + x)) - ln(1 + x)/2",
        "exp(ln(x)/2) - sqrt(x)",
        "exp(ln(2)*3 + x) - 8*exp(x)",
        "exp(x/(1 + x)) - exp(1 - 1/(1 + x))",
        "exp(1/(1 + x))*exp(x/(1 + x)) - exp(1)",
        "exp(x^2/(1 + x))*exp((2*x + 1)/(1 + x)) - exp(x)*exp(1)",
        "cos(pi/(1 + x) + pi*x/(1 + x)) + 1",
        "ln(x/(1 + x) + 1/(1 + x))",
        "abs(x^2/(1 + x) + x/(1 + x)) - abs(x)",
        "sqrt(x^2/(1 + x) + x/(1 + x)) - sqrt(x)",
        "exp(ln(x)/(1 + x) + x*ln(x)/(1 + x)) - x",
        "erf(x/(1 + x)) - erf(1 - 1/(1 + x))",
        "1/(1 + 1/(1 + 1/(1 + x))) - (x + 2)/(2*x + 3)",
        "1/(x^2 + 2*x + 1) - 1/(1 + x)^2",
        "1/(1 + sqrt(x)) - (1 - sqrt(x))/(1 - x)",
        "1/(x*(1 + x)^2*(x - y)^-1) - (x - y)/(x*(1 + x)^2)",
        "exp(1/sin(x))*exp(-1/sin(x)) - 1",
        "ln(exp(1/sin(x))) - 1/sin(x)",
        "x^0 - 1",
        "10^40*x/10^40 - x",
    ] {
        assert_eq!(reduce(&parse(text)), Reduction::Zero, "{text}");
    }
}

/// None of these is 0 everywhere where it is defined, or it isn't known to be.
#[test]
fn near_misses() {
    for text in [
        "sqrt(x^2) - x",
        "(x^2)^(1/2) + x",
        "(x^4)^(1/4) - x",
        "sqrt(x*y) - sqrt(x)*sqrt(y)",
        "sqrt((x - 1)^2) - x + 1",
        "ln(x*y) - ln(x) - ln(y)",
        "ln(a*b) - ln(a) - ln(b)",
        "abs(x) - x",
        "abs(x) + x",
        "abs(x + y) - abs(x) - abs(y)",
        "abs(x)^3 - x^3",
        "atan(tan(x)) - x",
        "exp(x) - exp(y)",
        "exp(1) - 2718281828459045/1000000000000000",
        "pi - 355/113",
        "sin(x + 355/113) + sin(x)",
        "sin(x + pi/2) + sin(x)",
        "cos(-x) + cos(x)",
        "erf(x) - erf(y)",
        "erf(x) - atan(x)",
        "ln(x) - x",
        "ln(1 + x^2) - 2*ln(1 + x)",
        "10^40*x/(10^40 + 1) - x",
        "9223372036854775807*x + x - 9223372036854775807*x",
        "4294967296^2*x",
        "x/9223372036854775807 - x/9223372036854775806",
        "(x/9223372036854775807)*(x/9223372036854775807)",
        "(-1 - 9223372036854775807)*x + (-1 - 9223372036854775807)*x",
    ] {
        let reduction = reduce(&parse(text));
        assert!(
            matches!(reduction, Reduction::Nonzero { .. }),
            "{text}: {reduction:?}"
        );
    }
}

#[test]
fn nested_arguments_change_nothing() {
    let pythagoras = parse("sin(x)^2 + cos(x)^2 - 1");
    for inner in [
        "exp(x)",
        "1/(1 + x^2)",
        "sqrt(1 + sin(x))",
        "ln(x)",
        "pi/7",
        "atan(abs(x))",
        "tan(x)",
    ] {
        let nested = pythagoras.substitute("x", &parse(inner));
        assert!(is_identically_zero(&nested), "{nested}");
    }
    let mut deep = parse("x");
    for _ in 0..30 {
        deep = (deep.clone() / parse("2")).call(Function::Sin);
    }
    assert!(is_identically_zero(&pythagoras.substitute("x", &deep)));
}

#[test]
fn divisions_by_zero_are_seen() {
    for text in [
        "1/(sin(x)^2 + cos(x)^2 - 1)",
        "(x - x)/(y - y)",
        "ln(x - x)",
        "tan(pi/2)",
        "(1/(1 + x) - (2 + x)/((1 + x)*(2 + x)))^-1",
        "(sin(2*x) - 2*sin(x)*cos(x))^(-1/2)",
    ] {
        assert_eq!(reduce(&parse(text)), Reduction::DivisionByZero, "{text}");
    }
}

#[test]
fn branches_are_left_to_the_caller() {
    for text in [
        "min(x, 1)",
        "x - max(x, y)",
        "exp(piecewise(x < 1, x, 1)) - 1",
    ] {
        assert_eq!(reduce(&parse(text)), Reduction::Branches);
    }
}

#[test]
fn work_is_bounded() {
    let wide = "(a + b + c + d + e + f + g + h)";
    for text in [
        format!("{wide}^40"),
        format!("1/({wide}^9 + 1) - 1/({wide}^9 + 2)"),
        "exp(1000*ln(1 + x + y)) - 1".into(),
        "(1 + x)^1000*(1 + y)^1000".into(),
        "(10^300*x + 1)^1000 - (10^300*x + 2)^1000".into(),
        "((x^1000 + 1)^1000 + 1)^1000".into(),
        "sin(x)^500*cos(y)^500".into(),
    ] {
        assert_eq!(reduce(&parse(&text)), Reduction::TooLarge, "{text}");
    }
    // Single terms have any power.
    let power = "((x^1000)^1000)^1000";
    assert!(is_identically_zero(&parse(&format!(
        "{power}/x - {power}*x^-1"
    ))));
    assert!(is_identically_zero(&parse(&format!(
        "sqrt({power}) - (x^1000)^500*((x^1000)^999)^500"
    ))));
}

#[test]
fn depth_is_no_danger() {
    for opening in [
        "exp(",
        "ln(",
        "sin(",
        "tan(",
        "tanh(",
        "erf(",
        "abs(",
        "sqrt(",
        "1/(1 + ",
        "sqrt(1 + ",
        "abs(x - ",
        "exp(sin(x)*",
        "ln(y*",
        "tan(1/",
        "1/exp(1/",
        "sqrt(1/",
    ] {
        let deep = |inner: &str| {
            let closing = opening.matches('(').count() - opening.matches(')').count();
            parse(&(opening.repeat(45) + inner + &")".repeat(45 * closing)))
        };
        let difference = deep("(x + y)") - deep("(y + x)");
        let reduction = reduce(&difference);
        let small = opening != "tan(1/";
        assert_eq!(
            reduction == Reduction::Zero,
            small,
            "{opening}: {reduction:?}"
        );
        assert!(small || reduction == Reduction::TooLarge);
    }
}
