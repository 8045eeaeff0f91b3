//! Programs against hand-written closures, and what is shared in them.

use rug::{Float, Rational};
use volver::real::{Format, Mpfr, MpfrReal, Native};
use volver::symbolic::{Expr, Operation, Program};

fn program(outputs: &[&str], inputs: &[&str]) -> Program {
    let outputs: Vec<Expr> = outputs.iter().map(|text| text.parse().unwrap()).collect();
    Program::new(&outputs, inputs).unwrap()
}

fn value(text: &str, x: f64) -> f64 {
    let program = program(&[text], &["x"]);
    program.bind(Native::<f64>::new()).at(&[&x])[0]
}

#[test]
fn every_operation_is_the_scalar_s_own() {
    let x = 0.7_f64;
    for (text, expected) in [
        ("x + 2", x + 2.0),
        ("x - 2", x - 2.0),
        ("2 - x", 2.0 - x),
        ("3*x", 3.0 * x),
        ("x/3", x / 3.0),
        ("2/3*x", 2.0 / 3.0 * x),
        ("-x", -x),
        ("1/x", 1.0 / x),
        ("1/x^3", 1.0 / (x * x * x)),
        ("5/x^3*exp(x)", 5.0 * (1.0 / (x * x * x) * x.exp())),
        ("exp(x)/x", x.exp() / x),
        ("x^5", x * x * (x * x) * x),
        ("x^0", 1.0),
        ("sqrt(x)", x.sqrt()),
        ("x^(3/2)", x.sqrt() * x.sqrt() * x.sqrt()),
        ("x^(1/3)", (1.0 / 3.0 * x.ln()).exp()),
        ("exp(x)", x.exp()),
        ("ln(x)", x.ln()),
        ("ln(1 + x)", x.ln_1p()),
        ("ln(x + 1 + x^2)", (x + x * x).ln_1p()),
        ("exp(x) - 1", x.exp_m1()),
        ("1 - exp(-x)", -(-x).exp_m1()),
        ("3 - 3*exp(-x)", -3.0 * (-x).exp_m1()),
        ("x + 2 - 2*exp(x)", x - 2.0 * x.exp_m1()),
        ("3 - 2*exp(-x)", 3.0 - 2.0 * (-x).exp()),
        ("sin(x)", x.sin()),
        ("cos(x)", x.cos()),
        ("tan(x)", x.tan()),
        ("sinh(x)", x.sinh()),
        ("cosh(x)", x.cosh()),
        ("tanh(x)", x.tanh()),
        ("atan(x)", x.atan()),
        ("erf(x)", libm::erf(x)),
        ("abs(x - 2)", 2.0 - x),
        ("min(x, 1/2)", 0.5),
        ("min(1/2, x)", 0.5),
        ("max(x, 1/2)", x),
        ("max(1/2, x)", x),
        ("pi*x", std::f64::consts::PI * x),
        ("piecewise(x < 1/2, 1, x < 3/4, 2, 3)", 2.0),
        ("piecewise(x >= 7/8, 1, x > 3/4, 2, 3)", 3.0),
        ("piecewise(x <= 7/8, ln(x - 2), 3)", f64::NAN),
        ("piecewise(x > 7/8, ln(x - 2), 3)", 3.0),
        ("piecewise(ln(x - 2) < 1, 2, 3)", f64::NAN),
        ("min(1, ln(x - 2))", f64::NAN),
        ("max(ln(x - 2), 1)", f64::NAN),
        ("7", 7.0),
    ] {
        let value = value(text, x);
        assert!(
            value.to_bits() == expected.to_bits() || value.is_nan() && expected.is_nan(),
            "{text}: {value} is not {expected}"
        );
    }
}

#[test]
fn what_occurs_twice_is_computed_once() {
    let program = program(
        &[
            "sin(x^2)*exp(-sin(x^2)/2)",
            "cos(x^2)*sin(x^2)",
            "exp(-sin(x^2)/2)",
        ],
        &["x"],
    );
    let count = |wanted: fn(&Operation) -> bool| {
        let all = program.instructions().iter();
        all.filter(|instruction| wanted(&instruction.operation))
            .count()
    };
    assert_eq!(count(|op| matches!(op, Operation::SinCos(_))), 1);
    assert_eq!(count(|op| matches!(op, Operation::Call(..))), 1);
    // x², the scaled sine, and the two products.
    assert_eq!(program.instructions().len(), 6);
}

#[test]
fn slices_and_single_places_agree() {
    let program = program(&["sin(x*y) + y", "x - 1/3", "1/7", "y"], &["x", "y"]);
    let format = Mpfr { bits: 90 };
    let bound = program.bind(format);
    let xs: Vec<MpfrReal> = (0..150).map(|i| format.fraction(i, 150)).collect();
    let ys: Vec<MpfrReal> = (0..150).map(|i| format.fraction(150 - i, 7)).collect();
    let mut columns = vec![Vec::new(); 4];
    bound.run(&[&xs, &ys], &mut columns);
    for (i, (x, y)) in xs.iter().zip(&ys).enumerate() {
        let single = bound.at(&[x, y]);
        for (column, single) in columns.iter().zip(&single) {
            assert_eq!(column[i], *single, "place {i}");
        }
    }
    assert_eq!(columns[3], ys);
    assert!(columns.iter().all(|column| column.len() == 150));
}

#[test]
fn constants_have_the_precision_of_the_format() {
    let program = program(&["x/10 + 1/3 + pi"], &["x"]);
    for bits in [53, 400] {
        let format = Mpfr { bits };
        let value = program.bind(format).at(&[&format.int(1)])[0].clone();
        let exact = Float::with_val(1000, rug::float::Constant::Pi) + Rational::from((13, 30));
        let error = Float::with_val(64, exact - value.as_float()).abs();
        assert!(
            error < Float::with_val(64, 1) >> (bits - 4),
            "{bits}: {error}"
        );
    }
}

#[test]
fn unknown_names_are_refused() {
    let expr: Expr = "x + w".parse().unwrap();
    let error = Program::new(&[expr], &["x", "s"]).unwrap_err();
    assert_eq!(error.to_string(), "unknown name 'w' (allowed: x, s)");
}
