//! The least form that formulas of λ have.

use super::{Form, Values};
use crate::case::Transfer;
use crate::symbolic::{CompileError, Expr, KeptProgram, Program, expand};
use rug::Rational;
use std::sync::Arc;

/// The form of C and τ, of `lambda` and without branches, between two places.
pub(super) fn form(
    formulas: Vec<Transfer<Expr>>,
    from: &Rational,
    to: &Rational,
) -> Result<Form, CompileError> {
    let formulas: Vec<Transfer<Expr>> = formulas
        .into_iter()
        .map(|of_one| Transfer {
            emission: of_one.emission.simplify(),
            extinction: of_one.extinction.simplify(),
        })
        .collect();
    if formulas.iter().all(|of_one| of_one.extinction.is(0)) {
        return Ok(Form::Vacuum);
    }
    let at = |place: &Rational| -> Option<Vec<Values>> {
        let value = |line: &Line| Rational::from(&line.slope * place) + &line.at_zero;
        formulas
            .iter()
            .map(|of_one| {
                Some(Transfer {
                    emission: value(&line(&of_one.emission)?),
                    extinction: value(&line(&of_one.extinction)?),
                })
            })
            .collect()
    };
    if let Some((front, back)) = at(from).zip(at(to)) {
        return Ok(if front == back {
            Form::Constant(front)
        } else {
            Form::Linear { front, back }
        });
    }
    let outputs: Vec<Expr> = formulas
        .iter()
        .flat_map(|of_one| [of_one.emission.clone(), of_one.extinction.clone()])
        .collect();
    let program = Program::new(&outputs, &["lambda"])?;
    Ok(Form::Smooth {
        formulas,
        program: Arc::new(KeptProgram::new(program)),
    })
}

/// a + b λ.
struct Line {
    at_zero: Rational,
    slope: Rational,
}

fn line(expr: &Expr) -> Option<Line> {
    let slope = expr.differentiate("lambda").simplify();
    let slope = number(&slope)?;
    let at_zero = expr.substitute("lambda", &Expr::number(0)).simplify();
    let at_zero = number(&at_zero)?;
    Some(Line { at_zero, slope })
}

fn number(expr: &Expr) -> Option<Rational> {
    if let Some(q) = expr.as_number() {
        return Some(q.clone());
    }
    expand(expr)?.as_number().cloned()
}
