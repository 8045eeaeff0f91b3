//! Against derivatives made symbolically and evaluated in MPFR.

use quickcheck::QuickCheck;
use rug::Rational;
use volver::real::{Format, Mpfr, Native, Real};
use volver::symbolic::{Expr, Program, Range, Taylor, taylor};

const ORDER: usize = 8;

/// f⁽ᵏ⁾(x) rᵏ/k!, k = 0 … [`ORDER`], with 200 bits.
fn exact(expr: &Expr, at: &Rational, reach: &Rational) -> Vec<f64> {
    let format = Mpfr { bits: 200 };
    let mut derivative = expr.clone();
    let mut scale = Rational::from(1);
    (0..=ORDER)
        .map(|k| {
            if k > 0 {
                derivative = derivative.differentiate("x").simplify();
                scale *= reach / Rational::from(k);
            }
            let program = Program::new(std::slice::from_ref(&derivative), &["x"]).unwrap();
            let value = program.bind(format).at(&[&format.ratio(at)]).remove(0);
            (value * &format.ratio(&scale)).to_float().to_f64()
        })
        .collect()
}

fn series(expr: &str, from: &Rational, to: &Rational) -> Taylor {
    let expr: Expr = expr.parse().unwrap();
    let program = Program::new(&[expr], &["x"]).unwrap();
    let panel = Range::new(Range::around(from).low, Range::around(to).high);
    let reach = Native::<f64>::new().ratio(&(Rational::from(to - from) / 2));
    taylor(&program, &Taylor::variable(panel, reach), ORDER).remove(0)
}

const FUNCTIONS: [&str; 16] = [
    "x^3 - 2*x + 1/3",
    "exp(-x^2)",
    "ln(2 + x)",
    "sqrt(1 + x)",
    "sin(5*x)*cos(x)",
    "tan(x/2)",
    "sinh(x) + cosh(2*x)",
    "tanh(3*x)",
    "atan(4*x)",
    "erf(2*x)",
    "1/(1 + 4*x^2)",
    "exp(x) - 1",
    "ln(1 + x)",
    "(1 + x)^(3/2)",
    "abs(x + 1/4)*pi",
    "max(x, 2*x - 3)/(3 - x)",
];

#[test]
fn every_coefficient_of_every_number_in_the_panel_is_enclosed() {
    let property = |which: usize, start: u16, width: u8, inside: u8| {
        let text = FUNCTIONS[which % FUNCTIONS.len()];
        let expr: Expr = text.parse().unwrap();
        let from = Rational::from((i64::from(start) % 1000, 1000));
        let to = Rational::from(&from + &Rational::from((i64::from(width) + 1, 400)));
        let at = Rational::from(&to - &from) * Rational::from((i64::from(inside), 255)) + &from;
        let reach = Rational::from(&to - &from) / 2;
        let found = series(text, &from, &to);
        // An expression of one branch where the test looks.
        let smooth: Expr = text
            .replace("abs(x + 1/4)", "(x + 1/4)")
            .replace("max(x, 2*x - 3)", "x")
            .parse()
            .unwrap();
        let exact = exact(&smooth, &at, &reach);
        drop(expr);
        exact.iter().enumerate().all(|(k, value)| {
            let range = found.coefficient(k);
            let slack = value.abs() * f64::EPSILON;
            range.low <= value + slack && value - slack <= range.high
        })
    };
    QuickCheck::new()
        .tests(2000)
        .quickcheck(property as fn(usize, u16, u8, u8) -> bool);
}

#[test]
fn over_one_number_the_enclosure_is_tight() {
    for text in FUNCTIONS {
        let at = Rational::from((3, 8));
        let near = Rational::from(&at + &Rational::from((1, 1_u64 << 46)));
        let smooth: Expr = text
            .replace("abs(x + 1/4)", "(x + 1/4)")
            .replace("max(x, 2*x - 3)", "x")
            .parse()
            .unwrap();
        let exact = exact(&smooth, &at, &Rational::from((1, 1_u64 << 47)));
        let found = series(text, &at, &near);
        for (k, value) in exact.iter().enumerate() {
            let range = found.coefficient(k);
            let width = range.high - range.low;
            let scale = 2_f64.powi(-47).powi(i32::try_from(k).unwrap());
            let allowed = 1e-9 * (value.abs() + scale);
            assert!(width <= allowed, "{text}, {k}: {range:?} around {value}");
        }
    }
}

#[test]
fn what_may_not_be_defined_has_no_bound() {
    let (from, to) = (Rational::from(-1), Rational::from(1));
    for text in ["1/x", "ln(x)", "sqrt(x)", "tan(2*x)", "x^(-2)"] {
        let found = series(text, &from, &to);
        assert_eq!(found.coefficient(3), Range::ENTIRE, "{text}");
    }
    // Values are those of either branch, derivatives any.
    let kink = series("abs(x)", &from, &to);
    assert!(kink.coefficient(0).high <= 1.001 && kink.coefficient(0).low >= -1.001);
    assert_eq!(kink.coefficient(1), Range::ENTIRE);
}

#[test]
fn polynomials_end() {
    let found = series("3*x^2 + 1", &Rational::new(), &Rational::from(2));
    assert!(found.len() <= 3);
    let second = found.coefficient(2);
    // 3 r² with r = 1.
    let width = second.high - second.low;
    assert!(second.low <= 3.0 && 3.0 <= second.high, "{second:?}");
    assert!(width < 1e-13, "{second:?}");
}

/// An interval times itself has products of both signs; a square has none.
#[test]
fn a_square_is_nowhere_below_zero() {
    let (from, to) = (Rational::from(-1), Rational::from(2));
    let square = series("x^2", &from, &to).coefficient(0);
    assert!(square.low >= 0.0 && square.high >= 4.0, "{square:?}");
    let bell = series("exp(-(30*x)^2)", &from, &to).coefficient(0);
    assert!(bell.low >= 0.0 && bell.high < 1.0 + 1e-10, "{bell:?}");
}

/// e^900 is no number of binary64, but above all of them.
#[test]
fn beyond_the_range_there_is_still_a_bound() {
    let (from, to) = (Rational::from(9), Rational::from(10));
    let large = series("exp(100*x)", &from, &to).coefficient(0);
    assert!(large.low >= f64::MAX / 2.0 && large.high == f64::INFINITY);
    let sigmoid = series("1/(1 + exp(100*x))", &from, &to).coefficient(0);
    assert!(sigmoid.magnitude() < 1e-300, "{sigmoid:?}");
}
