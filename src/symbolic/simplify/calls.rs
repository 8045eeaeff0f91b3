//! Functions of special arguments, and choices that are decided.

use crate::symbolic::{Branch, Expr, Function, Kind};

pub(super) fn call(function: Function, argument: &Expr) -> Option<Expr> {
    if argument.is(0) {
        return match function {
            Function::Exp | Function::Cos | Function::Cosh => Some(Expr::number(1)),
            Function::Ln => None,
            _ => Some(Expr::number(0)),
        };
    }
    if let Some(opposite) = opposite(argument) {
        match function {
            Function::Sin
            | Function::Tan
            | Function::Sinh
            | Function::Tanh
            | Function::Atan
            | Function::Erf => return Some(-opposite.call(function)),
            Function::Cos | Function::Cosh | Function::Abs => return Some(opposite.call(function)),
            Function::Exp | Function::Ln => {}
        }
    }
    match (function, argument.kind()) {
        (Function::Ln, _) if argument.is(1) => Some(Expr::number(0)),
        (Function::Ln, Kind::Call(Function::Exp, inner)) => Some(inner.clone()),
        (Function::Exp, Kind::Call(Function::Ln, inner)) if inner.facts().positive() => {
            Some(inner.clone())
        }
        (Function::Abs, _) if argument.facts().nonnegative => Some(argument.clone()),
        (Function::Abs, _) if argument.facts().nonpositive => Some(-argument),
        _ => None,
    }
}

/// −x for an argument that is written with a minus sign in front.
fn opposite(argument: &Expr) -> Option<Expr> {
    let negative = match argument.kind() {
        Kind::Number(q) => *q < 0,
        Kind::Product(factors) => factors[0].as_number().is_some_and(|q| *q < 0),
        _ => false,
    };
    negative.then(|| -argument)
}

pub(super) fn lesser(a: &Expr, b: &Expr) -> Option<Expr> {
    match (a.as_number(), b.as_number()) {
        (Some(x), Some(y)) => Some(if y < x { b.clone() } else { a.clone() }),
        _ => (a == b).then(|| a.clone()),
    }
}

pub(super) fn greater(a: &Expr, b: &Expr) -> Option<Expr> {
    match (a.as_number(), b.as_number()) {
        (Some(x), Some(y)) => Some(if y > x { b.clone() } else { a.clone() }),
        _ => (a == b).then(|| a.clone()),
    }
}

/// Branches whose conditions compare numbers are taken or dropped.
pub(super) fn piecewise(branches: &[Branch], otherwise: &Expr) -> Expr {
    let mut kept = Vec::new();
    let mut last = otherwise.clone();
    for branch in branches {
        let condition = &branch.condition;
        match (condition.left.as_number(), condition.right.as_number()) {
            (Some(left), Some(right)) => {
                if condition.relation.holds(left, right) {
                    last = branch.value.clone();
                    break;
                }
            }
            _ => kept.push(branch.clone()),
        }
    }
    let comparable = |b: &Branch| b.condition.left.facts().total && b.condition.right.facts().total;
    while kept
        .last()
        .is_some_and(|b| b.value == last && comparable(b))
    {
        kept.pop();
    }
    Expr::piecewise(kept, last)
}
