//! Riemann, midpoint and closed Newton–Cotes rules: their coefficients are rationals.
//!
//! Source: Davis and Rabinowitz, *Methods of Numerical Integration*, 2nd ed. (1984), section 2.5.

use super::{Rule, UnitRule};
use rug::Rational;

/// Nodes and weights on [0, 1]; empty for Gauss–Legendre, which has its own table.
pub(super) fn table(rule: Rule) -> UnitRule {
    let (node_parts, nodes, weight_parts, weights): (u32, &[u32], u32, &[u32]) = match rule {
        Rule::RiemannLeft => (1, &[0], 1, &[1]),
        Rule::RiemannRight => (1, &[1], 1, &[1]),
        Rule::Midpoint => (2, &[1], 1, &[1]),
        Rule::Trapezoid => (1, &[0, 1], 2, &[1, 1]),
        Rule::Simpson => (2, &[0, 1, 2], 6, &[1, 4, 1]),
        Rule::Boole => (4, &[0, 1, 2, 3, 4], 90, &[7, 32, 12, 32, 7]),
        Rule::GaussLegendre(_) => (1, &[], 1, &[]),
    };
    UnitRule {
        nodes: over(nodes, node_parts),
        weights: over(weights, weight_parts),
    }
}

fn over(numerators: &[u32], denominator: u32) -> Vec<Rational> {
    numerators
        .iter()
        .map(|&k| Rational::from((k, denominator)))
        .collect()
}
