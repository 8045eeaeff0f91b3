//! Derivatives.

use super::{Branch, Expr, Function, Kind};
use crate::symbolic::hash::HashMap;
use rug::Rational;

impl Expr {
    /// The derivative by `symbol`, all other symbols held constant.
    ///
    /// A branch is differentiated by itself: what happens where branches meet, a kink or a jump, is not
    /// in the result. So it is with |x| at 0 and with min and max where both are equal.
    #[must_use]
    pub fn differentiate(&self, symbol: &str) -> Expr {
        let mut derivatives: HashMap<&Expr, Expr> = HashMap::default();
        for node in self.nodes() {
            let derivative = of_node(node, symbol, &derivatives);
            derivatives.insert(node, derivative);
        }
        derivatives.remove(self).unwrap_or_else(|| Expr::number(0))
    }
}

/// The derivative of a node whose parts are differentiated already.
fn of_node(node: &Expr, symbol: &str, derivatives: &HashMap<&Expr, Expr>) -> Expr {
    let d = |part: &Expr| {
        derivatives
            .get(part)
            .cloned()
            .unwrap_or_else(|| Expr::number(0))
    };
    match node.kind() {
        Kind::Number(_) | Kind::Pi => Expr::number(0),
        Kind::Symbol(name) => Expr::number(i32::from(**name == *symbol)),
        Kind::Sum(terms) => Expr::sum(terms.iter().map(d)),
        Kind::Product(factors) => {
            Expr::sum(factors.iter().enumerate().filter_map(|(i, factor)| {
                let inner = Some(d(factor)).filter(|inner| !inner.is(0))?;
                let mut factors = factors.clone();
                factors[i] = inner;
                Some(Expr::product(factors))
            }))
        }
        Kind::Power(base, exponent) => chain(d(base), || {
            Expr::number(exponent.clone()) * base.pow(Rational::from(exponent - 1))
        }),
        Kind::Call(function, argument) => chain(d(argument), || outer(node, *function, argument)),
        Kind::Min(a, b) => either(a, b, d(a), d(b)),
        Kind::Max(a, b) => either(a, b, d(b), d(a)),
        Kind::Piecewise(branches, otherwise) => {
            let branches: Vec<Branch> = branches
                .iter()
                .map(|branch| Branch {
                    condition: branch.condition.clone(),
                    value: d(&branch.value),
                })
                .collect();
            let otherwise = d(otherwise);
            if branches.iter().all(|branch| branch.value == otherwise) {
                otherwise
            } else {
                Expr::piecewise(branches, otherwise)
            }
        }
    }
}

/// The chain rule.
fn chain(inner: Expr, outer: impl FnOnce() -> Expr) -> Expr {
    if inner.is(0) { inner } else { outer() * inner }
}

/// The derivative of a function at `argument`; `whole` is the function's own value.
fn outer(whole: &Expr, function: Function, argument: &Expr) -> Expr {
    let one = Expr::number(1);
    match function {
        Function::Exp => whole.clone(),
        Function::Ln => argument.recip(),
        Function::Sin => argument.call(Function::Cos),
        Function::Cos => -argument.call(Function::Sin),
        Function::Tan => one + whole.pow(2),
        Function::Sinh => argument.call(Function::Cosh),
        Function::Cosh => argument.call(Function::Sinh),
        Function::Tanh => one - whole.pow(2),
        Function::Atan => (one + argument.pow(2)).recip(),
        Function::Erf => Expr::product([
            Expr::number(2),
            Expr::pi().sqrt().recip(),
            (-argument.pow(2)).exp(),
        ]),
        Function::Abs => argument / whole,
    }
}

/// `below` where a < b, otherwise `above`.
fn either(a: &Expr, b: &Expr, below: Expr, above: Expr) -> Expr {
    if below == above {
        return below;
    }
    let branch = Branch {
        condition: super::Condition {
            left: a.clone(),
            relation: super::Relation::Less,
            right: b.clone(),
        },
        value: below,
    };
    Expr::piecewise(vec![branch], above)
}
