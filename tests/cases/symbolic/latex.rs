//! Expressions beside the LaTeX that one would write, and what TeX cannot read.

use quickcheck::{Arbitrary, Gen, QuickCheck};
use rug::Rational;
use volver::symbolic::{Branch, Condition, Expr, Function, Relation};

fn latex(text: &str) -> String {
    let expr: Expr = text.parse().unwrap_or_else(|e| panic!("{text}: {e}"));
    expr.to_latex()
}

#[test]
fn mathematics_as_one_would_write() {
    for (text, expected) in [
        // Numbers and names.
        ("7", "7"),
        ("-7", "-7"),
        ("1/3", r"\frac{1}{3}"),
        ("-2/3", r"-\frac{2}{3}"),
        ("pi", r"\pi"),
        ("lambda", r"\lambda"),
        ("Omega_0", r"\Omega_{0}"),
        ("a_1", "a_{1}"),
        ("x12", "x_{12}"),
        ("sigma_max_t", r"\sigma_{\mathrm{max}, t}"),
        ("depth", r"\mathrm{depth}"),
        ("depth_tau", r"\mathrm{depth}_{\tau}"),
        ("x_", r"\mathrm{x\_}"),
        ("_", r"\mathrm{\_}"),
        // Sums.
        ("a + b", "a + b"),
        ("a - b", "a - b"),
        ("-a - b", "-a - b"),
        ("a - (b - c)", r"a - \left(b - c\right)"),
        ("a - 1/2", r"a - \frac{1}{2}"),
        ("2 - 3*x", "2 - 3 x"),
        // Products and quotients.
        ("2*x*y", "2 x y"),
        ("(a + b)*c", r"\left(a + b\right) c"),
        ("-(a + b)", r"-\left(a + b\right)"),
        ("a - 2*(b + c)", r"a - 2 \left(b + c\right)"),
        ("x/y", r"\frac{x}{y}"),
        ("1/x", r"\frac{1}{x}"),
        ("1/x^2", r"\frac{1}{x^{2}}"),
        ("x/y/z", r"\frac{x}{y z}"),
        ("a/b*c/d^2", r"\frac{a c}{b d^{2}}"),
        ("1/x/y", r"\frac{1}{x y}"),
        ("-3/2*x/y", r"-\frac{3 x}{2 y}"),
        ("x/2", r"\frac{x}{2}"),
        ("(a + b)/(c + d)", r"\frac{a + b}{c + d}"),
        (
            "2*(a + b)/(3*(c + d))",
            r"\frac{2 \left(a + b\right)}{3 \left(c + d\right)}",
        ),
        ("a - b/c", r"a - \frac{b}{c}"),
        ("x/sqrt(pi)", r"\frac{x}{\sqrt{\pi}}"),
        ("0*ln(x)", r"0 \ln\left(x\right)"),
        ("2*3^(1/3)", r"2 \cdot 3^{\frac{1}{3}}"),
        // Powers.
        ("x^3", "x^{3}"),
        ("-x^2", "-x^{2}"),
        ("(-x)^2", r"\left(-x\right)^{2}"),
        ("(a + b)^2", r"\left(a + b\right)^{2}"),
        ("(x^2)^3", r"\left(x^{2}\right)^{3}"),
        ("(1/x)^2", r"\left(\frac{1}{x}\right)^{2}"),
        ("(1/2)^(1/3)", r"\left(\frac{1}{2}\right)^{\frac{1}{3}}"),
        ("a_1^2", "a_{1}^{2}"),
        ("sqrt(x + 1)", r"\sqrt{x + 1}"),
        ("x^(3/2)", r"x^{\frac{3}{2}}"),
        ("sqrt(x)^3", r"\sqrt{x}^{3}"),
        // Functions.
        ("exp(-t/2)", r"e^{-\frac{t}{2}}"),
        ("exp(x)^2", r"\left(e^{x}\right)^{2}"),
        ("exp(x) + e", r"\exp\left(x\right) + e"),
        ("sin(x)^2", r"\sin\left(x\right)^{2}"),
        (
            "x*cos(2*x)*ln(x)",
            r"x \cos\left(2 x\right) \ln\left(x\right)",
        ),
        (
            "tan(x) + atan(x)",
            r"\tan\left(x\right) + \arctan\left(x\right)",
        ),
        ("sinh(x)", r"\sinh\left(x\right)"),
        ("cosh(x)", r"\cosh\left(x\right)"),
        ("tanh(x)", r"\tanh\left(x\right)"),
        ("erf(x)", r"\operatorname{erf}\left(x\right)"),
        ("2*abs(x - 1)", r"2 \left|x - 1\right|"),
        ("min(x, 2)^2", r"\min\left(x, 2\right)^{2}"),
        ("max(a, b + 1)", r"\max\left(a, b + 1\right)"),
        // Branches.
        (
            "piecewise(x < 1/2, x, x >= 3, -1, 1 - x)",
            r"\begin{cases} x, & x < \frac{1}{2} \\ -1, & x \ge 3 \\ 1 - x, & \text{otherwise} \end{cases}",
        ),
        (
            "piecewise(x <= 1, 2, 3) + y",
            r"\left(\begin{cases} 2, & x \le 1 \\ 3, & \text{otherwise} \end{cases}\right) + y",
        ),
        (
            "-piecewise(x > 1, 2, 3)/y",
            r"-\frac{\begin{cases} 2, & x > 1 \\ 3, & \text{otherwise} \end{cases}}{y}",
        ),
        // The integral of the emission sin s² with the extinction s cos s².
        (
            "2-(sin(lambda^2)+2)*exp(-sin(lambda^2)/2)",
            r"2 - \left(\sin\left(\lambda^{2}\right) + 2\right) e^{-\frac{\sin\left(\lambda^{2}\right)}{2}}",
        ),
    ] {
        assert_eq!(latex(text), expected, "{text}");
    }
}

#[test]
fn any_name_is_text() {
    for (name, expected) in [
        ("", r"\mathrm{}"),
        ("λ", r"\mathrm{λ}"),
        ("7", r"\mathrm{7}"),
        ("a b", r"\mathrm{a b}"),
        (
            r"}^\{%",
            r"\mathrm{\}\text{\textasciicircum}\backslash \{\%}",
        ),
        ("a_#", r"\mathrm{a\_\#}"),
    ] {
        assert_eq!(Expr::symbol(name).to_latex(), expected, "{name}");
    }
}

/// An expression of any kind.
#[derive(Clone, Debug)]
struct Any(Expr);

impl Arbitrary for Any {
    fn arbitrary(g: &mut Gen) -> Self {
        Any(any(g, 4))
    }
}

fn any(g: &mut Gen, depth: usize) -> Expr {
    let choice = if depth == 0 { 0 } else { u8::arbitrary(g) % 8 };
    let part = |g: &mut Gen| any(g, depth - 1);
    match choice {
        0 => match u8::arbitrary(g) % 3 {
            0 => Expr::number((i8::arbitrary(g), 1 + u32::from(u8::arbitrary(g) % 4))),
            1 => Expr::pi(),
            _ => {
                let names = ["x", "e", "lambda", "a_1", "sigma_max", "_", "^{", "b_"];
                Expr::symbol(g.choose(&names).unwrap_or(&"x"))
            }
        },
        1 => Expr::sum([part(g), part(g), part(g)]),
        2 | 3 => Expr::product([part(g), part(g), part(g)]),
        4 => {
            let exponent = Rational::from((i8::arbitrary(g) % 4, 1 + u8::arbitrary(g) % 3));
            part(g).pow(exponent)
        }
        5 => part(g).call(*g.choose(&Function::ALL).unwrap_or(&Function::Exp)),
        6 => part(g).min(&part(g)).max(&part(g)),
        _ => Expr::piecewise(
            vec![Branch {
                condition: Condition {
                    left: part(g),
                    relation: Relation::Less,
                    right: part(g),
                },
                value: part(g),
            }],
            part(g),
        ),
    }
}

/// Why TeX would refuse the text: what does not close, or a second exponent on one base.
fn refusal(text: &str) -> Option<String> {
    let mut open: Vec<String> = Vec::new();
    let mut rest = text;
    let mut last_was_script = None;
    while let Some(c) = rest.chars().next() {
        let close = |open: &mut Vec<String>, wanted: &str| {
            let found = open.pop();
            (found.as_deref() != Some(wanted)).then(|| format!("{found:?} at {rest}"))
        };
        let script_before = last_was_script.take();
        let mut length = c.len_utf8();
        let mut refused = None;
        if rest.starts_with(r"\left") {
            open.push("left".into());
            length = 6;
        } else if rest.starts_with(r"\right") {
            refused = close(&mut open, "left");
            length = 7;
        } else if rest.starts_with(r"\begin{cases}") {
            open.push("cases".into());
            length = 13;
        } else if rest.starts_with(r"\end{cases}") {
            refused = close(&mut open, "cases");
            length = 11;
        } else if c == '\\' {
            length = 2;
        } else if c == '^' || c == '_' {
            refused = (script_before == Some(c)).then(|| format!("double script at {rest}"));
            open.push(c.into());
            length = 2;
        } else if c == '{' {
            open.push("{".into());
        } else if c == '}' {
            match open.pop().as_deref() {
                Some("{") => {}
                Some("^") => last_was_script = Some('^'),
                Some("_") => last_was_script = Some('_'),
                found => refused = Some(format!("{found:?} at {rest}")),
            }
        }
        if refused.is_some() {
            return refused;
        }
        rest = rest.get(length..)?;
    }
    (!open.is_empty()).then(|| format!("{open:?}"))
}

#[test]
fn tex_can_read_all_of_it() {
    fn check(Any(expr): Any) -> bool {
        refusal(&expr.to_latex()).is_none_or(|why| panic!("{expr}: {why}"))
    }
    assert!(refusal("e^{x}^{2}").is_some());
    assert!(refusal(r"\left(x").is_some());
    assert!(refusal(r"\frac{\left(x}{\right)}").is_some());
    QuickCheck::new()
        .tests(1000)
        .quickcheck(check as fn(Any) -> bool);
}
