//! What is certain of an expression from its form alone.

use super::{Expr, Function, Kind};
use crate::symbolic::hash::HashMap;

/// What is certain of an expression, whatever real values its symbols have. A `false` says nothing.
// Four independent certainties, not the states of one thing.
#[allow(clippy::struct_excessive_bools)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Facts {
    /// It has a value.
    pub total: bool,
    /// Its value, where it has one, is ≥ 0.
    pub nonnegative: bool,
    /// Its value, where it has one, is ≤ 0.
    pub nonpositive: bool,
    /// Its value, where it has one, is not 0.
    pub nonzero: bool,
}

impl Facts {
    /// Greater than 0.
    #[must_use]
    pub fn positive(self) -> bool {
        self.nonnegative && self.nonzero
    }

    /// Less than 0.
    #[must_use]
    pub fn negative(self) -> bool {
        self.nonpositive && self.nonzero
    }
}

impl Expr {
    /// What is certain of it from its form alone.
    #[must_use]
    pub fn facts(&self) -> Facts {
        let mut known: HashMap<&Expr, Facts> = HashMap::default();
        for node in self.nodes() {
            let facts = of_node(node, &|part| known.get(part).copied().unwrap_or_default());
            known.insert(node, facts);
        }
        known.get(self).copied().unwrap_or_default()
    }
}

fn of_node(node: &Expr, of: &impl Fn(&Expr) -> Facts) -> Facts {
    match node.kind() {
        Kind::Number(q) => Facts {
            total: true,
            nonnegative: *q >= 0,
            nonpositive: *q <= 0,
            nonzero: *q != 0,
        },
        Kind::Pi => Facts {
            total: true,
            nonnegative: true,
            nonpositive: false,
            nonzero: true,
        },
        Kind::Symbol(_) => Facts {
            total: true,
            ..Facts::default()
        },
        Kind::Sum(terms) => {
            let facts: Vec<Facts> = terms.iter().map(of).collect();
            let nonnegative = facts.iter().all(|f| f.nonnegative);
            let nonpositive = facts.iter().all(|f| f.nonpositive);
            Facts {
                total: facts.iter().all(|f| f.total),
                nonnegative,
                nonpositive,
                nonzero: (nonnegative || nonpositive) && facts.iter().any(|f| f.nonzero),
            }
        }
        Kind::Product(factors) => of_product(factors.iter().map(of)),
        Kind::Power(base, exponent) => of_power(of(base), exponent),
        Kind::Call(function, argument) => of_call(*function, of(argument)),
        Kind::Min(a, b) | Kind::Max(a, b) => either(of(a), of(b)),
        Kind::Piecewise(branches, otherwise) => {
            let conditions = branches
                .iter()
                .flat_map(|b| [&b.condition.left, &b.condition.right]);
            let comparable = conditions.into_iter().all(|side| of(side).total);
            let values = branches.iter().map(|b| of(&b.value));
            let facts = values.fold(of(otherwise), either);
            Facts {
                total: facts.total && comparable,
                ..facts
            }
        }
    }
}

/// What holds of both.
fn either(a: Facts, b: Facts) -> Facts {
    Facts {
        total: a.total && b.total,
        nonnegative: a.nonnegative && b.nonnegative,
        nonpositive: a.nonpositive && b.nonpositive,
        nonzero: a.nonzero && b.nonzero,
    }
}

fn of_product(factors: impl Iterator<Item = Facts>) -> Facts {
    let one = Facts {
        total: true,
        nonnegative: true,
        nonpositive: false,
        nonzero: true,
    };
    factors.fold(one, |a, b| Facts {
        total: a.total && b.total,
        nonnegative: a.nonnegative && b.nonnegative || a.nonpositive && b.nonpositive,
        nonpositive: a.nonnegative && b.nonpositive || a.nonpositive && b.nonnegative,
        nonzero: a.nonzero && b.nonzero,
    })
}

fn of_power(base: Facts, exponent: &rug::Rational) -> Facts {
    let integer = *exponent.denom() == 1;
    let even = integer && exponent.numer().is_even();
    // A fractional power exists for bases ≥ 0, a negative one (and the power 0) for bases other than 0.
    let needs_nonzero = *exponent <= 0;
    Facts {
        total: base.total && (integer || base.nonnegative) && (!needs_nonzero || base.nonzero),
        nonnegative: even || !integer || base.nonnegative,
        nonpositive: integer && !even && base.nonpositive,
        // A negative power, where it exists, is a reciprocal.
        nonzero: base.nonzero || needs_nonzero,
    }
}

fn of_call(function: Function, argument: Facts) -> Facts {
    let odd = Facts {
        total: argument.total,
        nonnegative: argument.nonnegative,
        nonpositive: argument.nonpositive,
        nonzero: argument.nonzero,
    };
    let positive = Facts {
        total: argument.total,
        nonnegative: true,
        nonpositive: false,
        nonzero: true,
    };
    match function {
        Function::Exp | Function::Cosh => positive,
        Function::Sinh | Function::Tanh | Function::Atan | Function::Erf => odd,
        Function::Abs => Facts {
            nonnegative: true,
            nonpositive: false,
            ..odd
        },
        Function::Sin | Function::Cos => Facts {
            total: argument.total,
            ..Facts::default()
        },
        Function::Ln => Facts {
            total: argument.total && argument.positive(),
            ..Facts::default()
        },
        Function::Tan => Facts::default(),
    }
}
