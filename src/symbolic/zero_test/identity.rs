//! Proofs that an expression without branches is 0 on a stretch, where its normal form is not.
//!
//! - sin(atan u) and its like are functions of u;
//! - c·R + g = 0 for a root R = a^(p/n) where cⁿ·aᵖ = (−g)ⁿ, and −g·c ≥ 0 where n is even: real numbers have
//!   one n-th root of their own sign;
//! - what has a slope of 0 everywhere, and is 0 at one place, is 0.

use crate::symbolic::constant::{ConstantTest, without_inverse_angles};
use crate::symbolic::normal_form::{Reduction, reduce};
use crate::symbolic::pieces::Stretch;
use crate::symbolic::{Claim, Expr, Kind, expand};

/// How many such steps stand within one another.
const DEPTH: u32 = 4;
/// Expressions of more nodes are left to the normal form.
const MAX_NODES: usize = 300;
/// Roots of higher orders are not taken apart.
const MAX_ROOT: u32 = 12;

/// What stands for a root while what is around it is looked at; no symbol of users has a space.
const ROOT: &str = "a root";

/// Whether the expression is certainly 0 strictly inside the stretch, wherever it has a value, and at those of its
/// ends where it has one.
pub(super) fn is_identity(expr: &Expr, stretch: &Stretch<'_>) -> bool {
    is_zero(expr, stretch, DEPTH)
}

fn is_zero(expr: &Expr, stretch: &Stretch<'_>, depth: u32) -> bool {
    if reduce(expr) == Reduction::Zero {
        return true;
    }
    if depth == 0 || expr.nodes().len() > MAX_NODES {
        return false;
    }
    let rewritten = without_inverse_angles(expr);
    if rewritten != *expr && reduce(&rewritten) == Reduction::Zero {
        return true;
    }
    is_zero_by_root(&rewritten, stretch, depth) || is_zero_by_slope(expr, stretch, depth)
}

fn is_zero_by_root(expr: &Expr, stretch: &Stretch<'_>, depth: u32) -> bool {
    let roots = expr.nodes().into_iter().rev();
    let roots = roots
        .filter(|node| matches!(node.kind(), Kind::Power(_, exponent) if *exponent.denom() != 1));
    roots
        .into_iter()
        .any(|root| is_zero_by_this_root(expr, root, stretch, depth))
}

fn is_zero_by_this_root(expr: &Expr, root: &Expr, stretch: &Stretch<'_>, depth: u32) -> bool {
    let Kind::Power(base, exponent) = root.kind() else {
        return false;
    };
    let Some(n) = exponent.denom().to_u32().filter(|n| *n <= MAX_ROOT) else {
        return false;
    };
    let symbol = Expr::symbol(ROOT);
    let of_root = expr.rebuild(|node| (node == root).then(|| symbol.clone()));
    let factor = of_root.differentiate(ROOT);
    let factor = expand(&factor).unwrap_or(factor);
    if factor.contains(ROOT) || factor.is(0) {
        return false;
    }
    let rest = of_root.substitute(ROOT, &Expr::number(0));
    let rest = expand(&rest).unwrap_or(rest);
    let power = base.pow(exponent.numer().clone());
    let difference = factor.pow(n) * power - (-&rest).pow(n);
    let difference = expand(&difference).unwrap_or(difference);
    let is_even = n.is_multiple_of(2);
    is_zero(&difference, stretch, depth - 1)
        && (!is_even || stretch.proves(&(-rest * factor), Claim::NonNegative))
}

fn is_zero_by_slope(expr: &Expr, stretch: &Stretch<'_>, depth: u32) -> bool {
    let slope = stretch.slope(expr);
    if slope.nodes().len() > MAX_NODES {
        return false;
    }
    stretch.proves(expr, Claim::Defined)
        && stretch.is_analytic(expr)
        && is_zero(&slope, stretch, depth - 1)
        && stretch
            .places()
            .any(|place| place.value(expr, stretch.symbol()) == ConstantTest::Zero)
}
