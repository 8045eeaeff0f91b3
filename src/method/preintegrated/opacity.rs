//! α̃: the transmittance of each segment of the interpolated field.

use super::integration::Integration;
use super::interpolant::Interpolant;
use super::polynomial::{antiderivative, compose, evaluate};
use crate::case::{Break, Nodes, Number, Structure};
use crate::method::MethodError;
use crate::method::breaks::{Allowed, Meeting};
use crate::method::limit::{Limit, Part};
use crate::quadrature::Rule;
use crate::real::{Format, Real, row};
use rug::Rational;
use std::fmt;

/// How the transmittance of a segment, exp(−∫ τ(s̄)), is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Opacity {
    /// s̄.
    pub interpolant: Interpolant,
    /// How its integral is taken.
    pub integration: Integration,
}

impl Opacity {
    /// The transmittance of each of n segments.
    ///
    /// # Errors
    /// As [`Preintegrated::radiance`](super::Preintegrated::radiance).
    pub fn segments<N: Nodes>(&self, nodes: &N, n: u64) -> Result<Vec<Number<N>>, MethodError> {
        let format = nodes.format();
        let step = format.ratio(&(Rational::from(nodes.length()) / n.max(1)));
        let end = format.int(1);
        let grid = self.integration.boundaries(format)?;
        self.interpolant.integrals(nodes, n, |field| {
            let depth = match self.integration {
                Integration::Closed => evaluate_depth(&closed_depth(nodes, field, &step)?, &end),
                Integration::SubIntervals { rule, .. } => {
                    let depths = depths_by_rule(nodes, field, &step, rule, &grid)?;
                    depths.last().cloned().unwrap_or_else(|| format.int(0))
                }
            };
            Ok((-depth).exp())
        })
    }

    /// What a break allows the integral over τ(s̄).
    pub(super) fn allowed_by(
        &self,
        structure: &Structure,
        place: &Break,
        ladder: Option<&[u64]>,
    ) -> Allowed {
        let exact = self.interpolant.is_exact(structure);
        place.extinction.as_ref().map_or(Allowed::All, |power| {
            let meeting = Meeting::of(place, power, ladder);
            self.integration.allowed_by(exact, &meeting)
        })
    }

    /// What limits the order, as far as this part goes.
    pub(super) fn limits(&self, structure: &Structure) -> Vec<Limit> {
        let mut limits = Vec::new();
        if !self.interpolant.is_exact(structure) && structure.extinction_degree_of(1) != Some(0) {
            limits.push(Limit::new(Part::Opacity, self.interpolant.order()));
        }
        let degree = if self.interpolant.is_exact(structure) {
            structure.extinction_degree()
        } else {
            structure.extinction_degree_of(self.interpolant.degree())
        };
        let order = self.integration.order(degree);
        limits.extend(order.map(|order| Limit::new(Part::SubIntervals, order)));
        limits
    }
}

impl fmt::Display for Opacity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.interpolant, self.integration)
    }
}

/// θ(x) = d ∫₀ˣ τ(s̄), without its constant term 0.
pub(super) fn closed_depth<N: Nodes>(
    nodes: &N,
    field: &[Number<N>],
    step: &Number<N>,
) -> Result<Vec<Number<N>>, MethodError> {
    let transfer = nodes
        .polynomial_transfer()
        .ok_or(MethodError::NoClosedForm)?;
    let extinction = compose(&transfer.extinction, field, nodes.format());
    Ok(antiderivative(&extinction, step))
}

/// θ(x) from its coefficients.
pub(super) fn evaluate_depth<R: Real>(depth: &[R], x: &R) -> R {
    evaluate(depth, x) * x
}

/// θ at each place of `grid` (ascending, from 0 on), the rule applied from each place to the next.
pub(super) fn depths_by_rule<N: Nodes>(
    nodes: &N,
    field: &[Number<N>],
    step: &Number<N>,
    rule: Rule,
    grid: &[Number<N>],
) -> Result<Vec<Number<N>>, MethodError> {
    let format = nodes.format();
    let table = rule.table(format.bits())?;
    let round = |q: &Rational| format.ratio(q);
    let offsets = row(table.nodes.iter().map(round));
    let weights = row(table.weights.iter().map(round));
    let mut depth = format.int(0);
    let mut from = format.int(0);
    let mut depths = Vec::with_capacity(grid.len());
    for to in grid {
        let width = to.clone() - &from;
        let mut mean = format.int(0);
        for (offset, weight) in offsets.iter().zip(&weights) {
            let x = width.clone() * offset + &from;
            let extinction = nodes.transfer(&evaluate(field, &x)).extinction;
            mean += &(extinction * weight);
        }
        depth += &(mean * &width * step);
        depths.push(depth.clone());
        from.set(to);
    }
    Ok(depths)
}
