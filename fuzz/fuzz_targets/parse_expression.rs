//! What is read is printed as text that reads as the same; simplifying and differentiating neither panic
//! nor blow it up.

#![no_main]

use libfuzzer_sys::fuzz_target;
use volver::symbolic::{Expr, Problem};

/// Different nodes, and the parts of all of them.
fn size(expr: &Expr) -> usize {
    let nodes = expr.nodes();
    nodes.iter().map(|node| 1 + node.parts().len()).sum()
}

/// Printed text may be longer than what was read, so that a limit is in the way, but never wrong.
fn read_again(expr: &Expr) {
    let text = expr.to_string();
    match text.parse::<Expr>() {
        Ok(again) => assert_eq!(again, *expr, "{text}"),
        Err(error) => assert!(
            matches!(
                error.problem,
                Problem::DivisionByZero
                    | Problem::ZeroToTheZero
                    | Problem::TooLong { .. }
                    | Problem::TooManyTokens
                    | Problem::TooDeep
                    | Problem::NumberTooLarge
            ),
            "{text}: {error}"
        ),
    }
}

fuzz_target!(|text: &str| {
    let expr: Expr = match text.parse() {
        Ok(expr) => expr,
        Err(error) => {
            assert_eq!(error.caret().lines().count(), 2);
            assert!(error.column <= text.chars().count() + 1);
            return;
        }
    };
    read_again(&expr);
    let simple = expr.simplify();
    assert!(simple.nodes().len() <= 4 * size(&expr) + 16);
    let derivative = expr.differentiate("x");
    assert!(derivative.nodes().len() <= 8 * size(&expr) + 16);
});
