//! Expressions: what is read, derived, decided and printed of them.

mod code;
mod coq;
mod decide;
mod enclose;
mod interval;
mod latex;
mod normal_form;
mod pieces;
mod program;
mod quotient;
mod read;
mod refute;
mod simplify;
mod taylor;

use volver::symbolic::Expr;

fn parse(text: &str) -> Expr {
    text.parse().unwrap_or_else(|e| panic!("{text}: {e}"))
}
