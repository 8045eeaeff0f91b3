//! A rule on every segment by itself.

use crate::case::{Nodes, Number};
use crate::quadrature::{Rule, RuleError};
use crate::real::{Format, Real, row};
use rug::Rational;

/// For each segment the depth from its front to `offset` of its length: x·d Σ wₖ τ(λⱼ + x cₖ d).
pub(super) fn partial_depths<N: Nodes>(
    rule: Rule,
    nodes: &N,
    n: u64,
    offset: &Rational,
) -> Result<Vec<Number<N>>, RuleError> {
    let format = nodes.format();
    let table = rule.table(format.bits())?;
    let mut depths: Vec<Number<N>> = Vec::new();
    for (node, weight) in table.nodes.iter().zip(&table.weights) {
        let weight = format.ratio(weight);
        let at = Rational::from(node * offset);
        // The front and the back of a segment are boundaries, which neighbours share.
        let (column, skip) = if at == 0 {
            (nodes.boundaries(n), 0)
        } else if at == 1 {
            (nodes.boundaries(n), 1)
        } else {
            (nodes.interior(n, &at), 0)
        };
        let extinctions = column.extinction[skip..].iter().take(index(n));
        if depths.is_empty() {
            depths = row(extinctions.map(|tau| tau.clone() * &weight));
        } else {
            let mut weighted = format.int(0);
            for (depth, tau) in depths.iter_mut().zip(extinctions) {
                weighted.set(tau);
                weighted *= &weight;
                *depth += &weighted;
            }
        }
    }
    let length = format.ratio(&(Rational::from(offset * nodes.length()) / n));
    for depth in &mut depths {
        *depth *= &length;
    }
    Ok(depths)
}

/// A number of segments as a length in memory.
fn index(n: u64) -> usize {
    usize::try_from(n).unwrap_or(usize::MAX)
}
