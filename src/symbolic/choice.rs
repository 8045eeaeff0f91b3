//! Nodes that are one of two things by the sign of a difference: min, max, abs and the branches of piecewise.

use super::{Expr, Function, Kind, Relation};
use std::cmp::Ordering;

/// Expressions of more choices are not resolved.
const MAX_CHOICES: usize = 256;

/// A node that is one of two things by the sign of a difference.
pub(super) struct Choice {
    pub(super) node: Expr,
    pub(super) difference: Expr,
    /// Where the difference is > 0.
    above: Expr,
    /// Where it is 0.
    equal: Expr,
    /// Where it is < 0.
    below: Expr,
    /// Both are the same where the difference is 0: the node is as continuous as its parts.
    is_continuous: bool,
}

impl Choice {
    /// What it is where the difference has that sign.
    pub(super) fn taken(&self, sign: Ordering) -> &Expr {
        match sign {
            Ordering::Greater => &self.above,
            Ordering::Equal => &self.equal,
            Ordering::Less => &self.below,
        }
    }

    /// Whether it has another value where the difference is 0 than where it has that sign.
    pub(super) fn differs_at_zero(&self, sign: Ordering) -> bool {
        !self.is_continuous && self.equal != *self.taken(sign)
    }
}

/// Which choices count.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Which {
    /// All of them.
    All,
    /// Those of piecewise alone, the only ones that may jump.
    Branches,
}

/// The first choice that has no other choice in what decides it.
pub(super) fn innermost(expr: &Expr, which: Which) -> Option<Choice> {
    // Parts come before what is made of them.
    expr.nodes().into_iter().find_map(|node| match node.kind() {
        Kind::Piecewise(branches, otherwise) => {
            let (first, rest) = branches.split_first()?;
            let others = Expr::piecewise(rest.to_vec(), otherwise.clone());
            let value = first.value.clone();
            let relation = first.condition.relation;
            let (above, below) = match relation {
                Relation::Less | Relation::LessEqual => (others.clone(), value.clone()),
                Relation::Greater | Relation::GreaterEqual => (value.clone(), others.clone()),
            };
            let equal = if relation.holds(&0, &0) {
                value
            } else {
                others
            };
            Some(Choice {
                node: node.clone(),
                difference: &first.condition.left - &first.condition.right,
                above,
                equal,
                below,
                is_continuous: false,
            })
        }
        _ if which == Which::Branches => None,
        Kind::Min(a, b) => Some(continuous(node, a - b, b, a)),
        Kind::Max(a, b) => Some(continuous(node, a - b, a, b)),
        Kind::Call(Function::Abs, x) => Some(continuous(node, x.clone(), x, &-x)),
        _ => None,
    })
}

fn continuous(node: &Expr, difference: Expr, above: &Expr, below: &Expr) -> Choice {
    Choice {
        node: node.clone(),
        difference,
        above: above.clone(),
        equal: above.clone(),
        below: below.clone(),
        is_continuous: true,
    }
}

/// The expression without those choices, each decided by the sign of its difference; `None` where a sign
/// is not known.
pub(super) fn resolve(
    expr: &Expr,
    which: Which,
    sign: &dyn Fn(&Expr) -> Option<Ordering>,
) -> Option<Expr> {
    let mut resolved = expr.clone();
    for _ in 0..MAX_CHOICES {
        let Some(choice) = innermost(&resolved, which) else {
            return Some(resolved);
        };
        let taken = choice.taken(sign(&choice.difference)?);
        resolved = resolved.rebuild(|node| (*node == choice.node).then(|| taken.clone()));
    }
    None
}

/// The differences of all choices in an expression, however they are decided.
pub(super) fn differences(expr: &Expr) -> Vec<Expr> {
    let nodes = expr.nodes().into_iter();
    let of_node = |node: &Expr| match node.kind() {
        Kind::Min(a, b) | Kind::Max(a, b) => vec![a - b],
        Kind::Call(Function::Abs, x) => vec![x.clone()],
        Kind::Piecewise(branches, _) => branches
            .iter()
            .map(|branch| &branch.condition.left - &branch.condition.right)
            .collect(),
        _ => Vec::new(),
    };
    nodes.flat_map(of_node).collect()
}
