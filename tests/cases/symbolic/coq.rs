//! Terms beside what one would write for Coq, and what has none.

use volver::symbolic::{CoqError, Expr};

fn coq(text: &str) -> Result<String, CoqError> {
    let expr: Expr = text.parse().unwrap();
    expr.to_coq()
}

#[test]
fn terms_bind_as_the_expression_does() {
    let cases = [
        ("lambda", "lambda"),
        ("-lambda", "- lambda"),
        ("1/3", "1 / 3"),
        ("-1/3*lambda", "-1 / 3 * lambda"),
        ("2 - lambda/2", "2 - 1 / 2 * lambda"),
        ("(1 + lambda)^2", "(1 + lambda) ^ 2"),
        ("sin(lambda)^2", "sin lambda ^ 2"),
        ("sin(lambda^2)", "sin (lambda ^ 2)"),
        ("exp(-lambda)", "exp (- lambda)"),
        ("ln(cosh(lambda))", "ln (cosh lambda)"),
        ("1/(1 + lambda)", "1 / (1 + lambda)"),
        ("1/(1 + lambda)^2", "1 / (1 + lambda) ^ 2"),
        ("lambda/(2*pi)", "lambda / (2 * PI)"),
        ("-1/lambda", "- 1 / lambda"),
        ("1/sqrt(pi)", "1 / sqrt PI"),
        ("sqrt(1 + lambda)*lambda", "sqrt (1 + lambda) * lambda"),
        ("2*(lambda - 3)", "2 * (lambda - 3)"),
        (
            "lambda*(1 - lambda)/(2 + lambda)",
            "lambda * (1 - lambda) / (2 + lambda)",
        ),
        ("(lambda^2)^3", "(lambda ^ 2) ^ 3"),
        ("1 - (-2)*lambda", "1 + 2 * lambda"),
    ];
    for (text, term) in cases {
        assert_eq!(coq(text).as_deref(), Ok(term), "{text}");
    }
}

#[test]
fn what_is_not_smooth_has_no_term() {
    for text in [
        "abs(lambda)",
        "1 + min(lambda, 2)",
        "piecewise(lambda < 1, 2, 3)",
    ] {
        assert!(
            matches!(coq(text), Err(CoqError::Branches { .. })),
            "{text}"
        );
    }
    let error = coq("1 + lambda^(3/2)").unwrap_err();
    assert_eq!(
        error,
        CoqError::FractionalPower {
            part: "lambda^(3/2)".into()
        }
    );
}
