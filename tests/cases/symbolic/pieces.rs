//! Where expressions are cut, and what they are between.

use rug::Rational;
use volver::symbolic::{Expr, Piece, PiecesError, ZeroTest, pieces, zero_test};

fn cut(text: &str, to: i32) -> Result<Vec<Piece>, PiecesError> {
    let expr: Expr = text.parse().unwrap();
    pieces(&[expr], "x", &Rational::new(), &Rational::from(to))
}

/// The pieces as text: "from..to: expression".
fn shown(text: &str, to: i32) -> Vec<String> {
    cut(text, to)
        .unwrap_or_else(|e| panic!("{text}: {e}"))
        .into_iter()
        .map(|piece| {
            let [from, to] =
                [piece.from, piece.to].map(|p| p.exact.map_or("?".into(), |e| e.to_string()));
            format!("{from}..{to}: {}", piece.exprs[0].simplify())
        })
        .collect()
}

#[test]
fn branches_are_told_apart() {
    for (text, to, expected) in [
        ("x^2", 1, &["0..1: x^2"][..]),
        (
            "abs(x - 1/3)",
            1,
            &["0..1/3: -(x - 1/3)", "1/3..1: x - 1/3"],
        ),
        ("abs(x)", 1, &["0..1: x"]),
        ("abs(x^2 + 1)", 1, &["0..1: x^2 + 1"]),
        ("min(x, 1/2)", 1, &["0..1/2: x", "1/2..1: 1/2"]),
        ("max(x, 1/2)", 1, &["0..1/2: 1/2", "1/2..1: x"]),
        (
            "piecewise(x < 1/2, 1, x < 3/4, 2, 3)",
            1,
            &["0..1/2: 1", "1/2..3/4: 2", "3/4..1: 3"],
        ),
        ("piecewise(x > 1/2, 1, 3)", 1, &["0..1/2: 3", "1/2..1: 1"]),
        ("piecewise(2 <= x, 1, 3)", 1, &["0..1: 3"]),
        (
            "piecewise(2*x^2 < 1, 1, 3)",
            1,
            &["0..sqrt(1/2): 1", "sqrt(1/2)..1: 3"],
        ),
        (
            "piecewise(x < sqrt(1/3), x, 2)",
            1,
            &["0..sqrt(1/3): x", "sqrt(1/3)..1: 2"],
        ),
        (
            "min(6, max(0, 12*x^2 - 3))",
            1,
            &["0..1/2: 0", "1/2..sqrt(3/4): 12*x^2 - 3", "sqrt(3/4)..1: 6"],
        ),
        (
            "max(0, 8 - 32*abs(x - 1/2))",
            1,
            &[
                "0..1/4: 0",
                "1/4..1/2: 8 + 32*(x - 1/2)",
                "1/2..3/4: 8 - 32*(x - 1/2)",
                "3/4..1: 0",
            ],
        ),
        // The same place twice, in two guises.
        (
            "min(1, 2*x^2)*piecewise(x < sqrt(1/2), 1, 2)",
            1,
            &["0..sqrt(1/2): 2*x^2", "sqrt(1/2)..1: 2"],
        ),
        // A root that no closed form is known of.
        ("max(cos(x), x)", 1, &["0..?: cos(x)", "?..1: x"]),
        ("abs(sin(x))", 4, &["0..?: sin(x)", "?..4: -sin(x)"]),
    ] {
        assert_eq!(shown(text, to), expected, "{text}");
    }
}

#[test]
fn places_are_inside_their_brackets() {
    let all = cut("abs(x^2 - 2)", 2).unwrap();
    let (low, high) = &all[0].to.bracket;
    assert!(Rational::from(low * low) < 2 && Rational::from(high * high) > 2);
    assert!(Rational::from(high - low) < Rational::from((1, 1_u64 << 40)));
    assert_eq!(all[0].to.exact, Some("sqrt(2)".parse().unwrap()));
}

#[test]
fn what_only_touches_is_not_guessed() {
    // (x − √(1/3))² written out is 0 without a change of sign at an irrational place.
    let error = cut("piecewise(x^2 - 2*x*sqrt(1/3) + 1/3 > 0, 1, 2)", 1).unwrap_err();
    assert!(matches!(error, PiecesError::Undecided { .. }), "{error}");
    let error = cut("abs(sin(1000*x))", 1).unwrap_err();
    assert_eq!(error, PiecesError::TooMany);
}

#[test]
fn roots_of_squares_are_zero_tested_by_sign() {
    let range = |from: i32| [("x".to_string(), Rational::from(from), Rational::from(2))];
    let expr: Expr = "sqrt((1 + x)^2) - 1 - x".parse().unwrap();
    assert_eq!(zero_test(&expr, &range(-1)), ZeroTest::Proved);
    assert!(matches!(zero_test(&expr, &range(-2)), ZeroTest::Refuted(_)));
}
