//! Source code beside what one would write.

use rug::Rational;
use volver::symbolic::code::{Definition, Language, source};
use volver::symbolic::{Expr, Program};

fn program(text: &str, inputs: &[&str]) -> Program {
    let expr: Expr = text.parse().unwrap_or_else(|e| panic!("{text}: {e}"));
    Program::new(&[expr], inputs).unwrap()
}

/// What stands between the lines that begin and end the function.
fn inside(language: Language, text: &str) -> Vec<String> {
    let program = program(text, &["a", "b", "c"]);
    let definition = Definition {
        name: "f",
        doc: "",
        program: &program,
    };
    let code = source(language, "", &[], &[definition]);
    let lines = code.lines().map(str::trim);
    let lines = lines.skip_while(|line| !line.contains(" f("));
    let lines = lines.skip(1).take_while(|line| *line != "}");
    let unused = |line: &&str| line.starts_with("(void)") || line.starts_with("let _");
    lines.filter(|line| !unused(line)).map(Into::into).collect()
}

#[test]
fn operations_keep_their_order() {
    for (text, expected) in [
        ("a - (b - c)", "a - (b - c)"),
        ("a - b - c", "a - b - c"),
        ("a + (b + c)", "a + b + c"),
        ("a - (b + c)", "a - (b + c)"),
        ("a/(b*c)", "a / (b * c)"),
        ("a/b/c", "a / b / c"),
        ("a*b/c", "a * b / c"),
        ("a/b*c", "a / b * c"),
        ("(a + b)*c", "(a + b) * c"),
        ("a*(b + c)", "a * (b + c)"),
        ("a + b*c", "a + b * c"),
        ("-a^2", "-(a * a)"),
        ("(-a)^3/b", "t1 * t1 * t1 / b"),
        ("-a/b", "-(a / b)"),
        ("1/a", "1.0 / a"),
        ("b*(1/a)^-2", "b / (t1 * t1)"),
        ("-(-a + b)", "-(-a + b)"),
        ("exp(-a/2)", "exp(-0.5 * a)"),
        ("sqrt(a)*ln(b)", "sqrt(a) * log(b)"),
        ("abs(a)", "fabs(a)"),
        ("ln(1 + a)", "log1p(a)"),
        ("exp(a) - 1", "expm1(a)"),
        ("min(a, b + c)", "lesser(a, b + c)"),
        ("pi*a", "3.141592653589793 * a"),
        ("piecewise(a < b, c, 2)", "a < b ? c : a >= b ? 2.0 : NAN"),
    ] {
        let lines = inside(Language::C, text);
        let expected = format!("return {expected};");
        assert_eq!(lines.last(), Some(&expected), "{text}: {lines:?}");
    }
}

#[test]
fn what_is_needed_twice_has_a_name() {
    assert_eq!(
        inside(
            Language::C,
            "piecewise(a*b <= 1/3, sin(a + b), c)*cos(a + b)"
        ),
        [
            "const double t1 = a * b;",
            "const double t2 = a + b;",
            "const double t3 = t1 <= 1.0 / 3.0 ? sin(t2) : t1 > 1.0 / 3.0 ? c : NAN;",
            "return t3 * cos(t2);",
        ]
    );
}

#[test]
fn numbers_are_rounded_once() {
    let power = "1".to_string() + &"0".repeat(400);
    for (text, expected) in [
        ("7", "7.0"),
        ("-7", "-7.0"),
        ("1/2", "0.5"),
        ("1/3", "1.0 / 3.0"),
        ("-2/3", "-2.0 / 3.0"),
        ("1e-5", "1e-5"),
        ("0.1", "0.1"),
        ("10^30", "1e30"),
        ("2^53 + 1", "9007199254740992.0"),
        ("1/(2^53 + 1)", "1.1102230246251564e-16"),
        ("1/2^53", "1.0 / 9007199254740992.0"),
        (&power, "INFINITY"),
        (&format!("-{power}"), "-INFINITY"),
        (&format!("1/{power}"), "0.0"),
    ] {
        let lines = inside(Language::C, text);
        assert_eq!(lines, [format!("return {expected};")], "{text}");
    }
    assert_eq!(inside(Language::C, "a/(1/3)"), ["return 3.0 * a;"]);
    assert_eq!(
        inside(Language::C, "a*b - 1/3"),
        ["return a * b - 1.0 / 3.0;"]
    );
}

#[test]
fn python_and_rust_have_their_own_ways() {
    for (text, python, rust) in [
        ("a/3", "a / 3.0", "a / 3.0"),
        ("a/b", "_div(a, b)", "a / b"),
        ("a/(b*c) + 1", "_div(a, b * c) + 1.0", "a / (b * c) + 1.0"),
        ("exp(-a/2)", "_exp(-0.5 * a)", "f64::exp(-0.5 * a)"),
        ("erf(a)", "math.erf(a)", "libm::erf(a)"),
        ("pi*a", "math.pi * a", "std::f64::consts::PI * a"),
        ("abs(-a)", "abs(-a)", "f64::abs(-a)"),
    ] {
        let python = format!("return {python}");
        assert_eq!(inside(Language::Python, text), [python], "{text}");
        assert_eq!(inside(Language::Rust, text), [rust], "{text}");
    }
}

#[test]
fn whole_files() {
    let program = program("max(x, lambda)/lambda", &["x", "lambda", "E"]);
    let third = Rational::from((1, 3));
    let definition = Definition {
        name: "ratio",
        doc: "A ratio.",
        program: &program,
    };
    let file = |language| {
        source(
            language,
            "Made by hand.\n\\",
            &[("LENGTH", &third)],
            &[definition],
        )
    };
    assert_eq!(
        file(Language::Python),
        r#"# Made by hand.
# \ .

import math

LENGTH = 1.0 / 3.0


def _max(a, b):
    """The greater of the two; NaN where one of them is."""
    return b if b > a else a if a >= b else math.nan


def _div(a, b):
    """a/b, infinite or NaN where b is 0."""
    try:
        return a / b
    except ZeroDivisionError:
        if a == 0.0 or math.isnan(a):
            return math.nan
        return math.copysign(math.inf, a) * math.copysign(1.0, b)


def ratio(x: float, lambda_: float, E: float) -> float:
    """A ratio."""
    return _div(_max(x, lambda_), lambda_)
"#
    );
    assert_eq!(
        file(Language::Rust),
        r"// Made by hand.
// \ .

pub const LENGTH: f64 = 1.0 / 3.0;

/// The greater of the two; NaN where one of them is.
fn greater(a: f64, b: f64) -> f64 {
    if b > a {
        b
    } else if a >= b {
        a
    } else {
        f64::NAN
    }
}

/// A ratio.
#[allow(non_snake_case)]
pub fn ratio(x: f64, lambda: f64, E: f64) -> f64 {
    let _ = E;
    greater(x, lambda) / lambda
}
"
    );
    assert!(file(Language::C).ends_with(
        r"
const double LENGTH = 1.0 / 3.0;

// The greater of the two; NaN where one of them is.
static double greater(double a, double b) {
    return b > a ? b : a >= b ? a : NAN;
}

// A ratio.
double ratio(double x, double lambda, double E) {
    (void)E;
    return greater(x, lambda) / lambda;
}
"
    ));
}

#[test]
fn names_give_way() {
    let inputs = [
        "lambda", "lambda_", "double", "type", "exp", "expf", "t1", "D", "f", "__", "x'", "", "_",
    ];
    let exprs: Vec<Expr> = inputs.iter().map(|name| Expr::symbol(name)).collect();
    let program = Program::new(&[Expr::sum(exprs).sqrt().exp()], &inputs).unwrap();
    let definition = Definition {
        name: "f",
        doc: "",
        program: &program,
    };
    let one = Rational::from(1);
    let parameters = |language, separator: &str| {
        let code = source(language, "", &[("D", &one), ("f", &one)], &[definition]);
        let line = code.lines().find(|line| line.contains(" f_(")).unwrap();
        let (_, rest) = line.split_once('(').unwrap();
        let (parameters, _) = rest.split_once(')').unwrap();
        parameters.replace("double ", "").replace(separator, "")
    };
    assert_eq!(
        parameters(Language::C, ""),
        "lambda, lambda_, double_, type, exp_, expf_, t1, D_, f__, ___, x_, ____, _"
    );
    assert_eq!(
        parameters(Language::Python, ": float"),
        "lambda__, lambda_, double, type, exp, expf, t1, D_, f__, __, x_, ___, _"
    );
    assert_eq!(
        parameters(Language::Rust, ": f64"),
        "lambda, lambda_, double, type_, exp, expf, t1, D_, f__, __, x_, ___, ____"
    );
}

#[test]
fn comments_stay_comments() {
    let program = program("a", &["a"]);
    let definition = Definition {
        name: "f",
        doc: "\"\"\"\nx = 1\rx = 2\\",
        program: &program,
    };
    let head = "*/ ??/\nb \u{202e}\\ \n\nc";
    let c = source(Language::C, head, &[], &[definition]);
    assert!(c.starts_with("// */ ??/ .\n// b  \\ .\n//\n// c\n\n#include"));
    assert!(c.contains("\n// \"\"\"\n// x = 1 x = 2\\ .\ndouble f("));
    let python = source(Language::Python, head, &[], &[definition]);
    let doc = r#"    """\"\"\"
    x = 1 x = 2\\ .
    """
"#;
    assert!(python.contains(doc), "{python}");
}

#[test]
fn only_the_first_output_counts() {
    let exprs: Vec<Expr> = ["sin(a)", "cos(a) + 1/a"]
        .iter()
        .map(|text| text.parse().unwrap())
        .collect();
    for (outputs, value) in [(&exprs[..], "f64::sin(a)"), (&[], "f64::NAN")] {
        let program = Program::new(outputs, &["a"]).unwrap();
        let definition = Definition {
            name: "f",
            doc: "",
            program: &program,
        };
        let code = source(Language::Rust, "", &[], &[definition]);
        assert!(code.ends_with(&format!("    {value}\n}}\n")), "{code}");
        assert_eq!(code.matches("f64::").count(), 1);
    }
}

#[test]
fn languages_have_names() {
    for language in Language::ALL {
        assert_eq!(language.to_string().parse(), Ok(language));
    }
    assert_eq!(
        "cobol".parse::<Language>().unwrap_err().to_string(),
        "unknown language 'cobol' (allowed: c, python, rust)"
    );
}
