//! C̃: the radiance that each segment of the interpolated field emits to its own front.

use super::interpolant::Interpolant;
use super::opacity::{closed_depth, depths_by_rule, evaluate_depth};
use super::polynomial::{antiderivative, compose, evaluate};
use super::series::attenuated_integral;
use crate::case::{Nodes, Structure};
use crate::method::MethodError;
use crate::method::limit::{Limit, Part};
use crate::method::nested::Number;
use crate::quadrature::Rule;
use crate::real::{Format, Real};
use rug::Rational;
use std::fmt;

/// How an integral over a segment is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Integration {
    /// In closed form; needs transfer functions that are polynomials.
    Closed,
    /// By a composite rule.
    SubIntervals {
        /// The number N of sub-intervals, at least 1.
        count: u32,
        /// The rule on each of them.
        rule: Rule,
    },
}

/// How a segment's radiance, ∫ C(s̄) τ(s̄) exp(−∫ τ(s̄)), is computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Color {
    /// s̄.
    pub interpolant: Interpolant,
    /// Whether the exponential is there; without it (Engel, Kraus and Ertl 2001) tables are faster
    /// to compute and the order is 1 (Etiene, Kirby and Silva 2013, equation 31).
    pub attenuated: bool,
    /// How the integral is taken.
    pub integration: Integration,
}

impl Color {
    /// The radiance of each of n segments.
    ///
    /// # Errors
    /// As [`Preintegrated::radiance`](super::Preintegrated::radiance).
    pub fn segments<N: Nodes>(&self, nodes: &N, n: u64) -> Result<Vec<Number<N>>, MethodError> {
        let format = nodes.format();
        let step = format.ratio(&(Rational::from(nodes.length()) / n.max(1)));
        let fields = self.interpolant.segments(nodes, n)?;
        match self.integration {
            Integration::Closed => fields
                .iter()
                .map(|field| self.closed(nodes, field, &step))
                .collect(),
            Integration::SubIntervals { count, rule } => {
                let sum = CompositeSum::new(rule, count, format)?;
                fields
                    .iter()
                    .map(|field| self.by_rule(nodes, field, &step, rule, &sum))
                    .collect()
            }
        }
    }

    fn closed<N: Nodes>(
        &self,
        nodes: &N,
        field: &[Number<N>],
        step: &Number<N>,
    ) -> Result<Number<N>, MethodError> {
        let format = nodes.format();
        let transfer = nodes
            .polynomial_transfer()
            .ok_or(MethodError::NoClosedForm)?;
        let source = compose(&transfer.source, field, format);
        if self.attenuated {
            let depth = closed_depth(nodes, field, step)?;
            Ok(attenuated_integral(&source, &depth)? * step)
        } else {
            Ok(evaluate_depth(
                &antiderivative(&source, step),
                &format.int(1),
            ))
        }
    }

    fn by_rule<N: Nodes>(
        &self,
        nodes: &N,
        field: &[Number<N>],
        step: &Number<N>,
        rule: Rule,
        sum: &CompositeSum<Number<N>>,
    ) -> Result<Number<N>, MethodError> {
        let format = nodes.format();
        let depths = match (self.attenuated, nodes.polynomial_transfer()) {
            (false, _) => vec![format.int(0); sum.places.len()],
            (true, Some(_)) => {
                let depth = closed_depth(nodes, field, step)?;
                sum.places
                    .iter()
                    .map(|x| evaluate_depth(&depth, x))
                    .collect()
            }
            (true, None) => depths_by_rule(nodes, field, step, rule, &sum.places)?,
        };
        let mut total = format.int(0);
        for ((x, weight), depth) in sum.places.iter().zip(&sum.weights).zip(depths) {
            let transfer = nodes.transfer(&evaluate(field, x));
            let mut term = transfer.emission * &transfer.extinction;
            if self.attenuated {
                term *= &(-depth).exp();
            }
            term *= weight;
            total += &term;
        }
        Ok(total * step)
    }

    /// What limits the order, as far as this part goes.
    pub(super) fn limits(&self, structure: &Structure) -> Vec<Limit> {
        let mut limits = Vec::new();
        let exact = self.interpolant.is_exact(structure);
        if !exact {
            limits.push(Limit {
                part: Part::Source,
                order: self.interpolant.order(),
                vanishes: structure.source_is_constant(),
            });
        }
        if !self.attenuated {
            limits.push(Limit::new(Part::NeglectedAttenuation, 1.0));
        } else if !exact && structure.extinction_degree_of(1) != Some(0) {
            // The field is off by O(d^(degree+1)), the depth inside by one order more.
            let order = self.interpolant.degree() as f64 + 2.0;
            limits.push(Limit::new(Part::AttenuationInside, order));
        }
        let order = self.integration.order(None);
        limits.extend(order.map(|order| Limit::new(Part::SubIntervals, order)));
        limits
    }
}

impl fmt::Display for Color {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}{}", self.interpolant, self.integration)?;
        if self.attenuated {
            Ok(())
        } else {
            f.write_str(" without attenuation")
        }
    }
}

impl fmt::Display for Integration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Integration::Closed => Ok(()),
            Integration::SubIntervals { count, rule } => write!(f, " by {count} × {rule}"),
        }
    }
}

impl Integration {
    /// The order in d of N fixed sub-intervals; `None` where the integral is exact, that of a
    /// polynomial of `degree` included.
    pub(super) fn order(self, degree: Option<usize>) -> Option<f64> {
        match (self, degree) {
            (Integration::SubIntervals { rule, .. }, Some(d)) if d <= rule.degree() as usize => {
                None
            }
            (Integration::SubIntervals { rule, .. }, _) => Some(f64::from(rule.order())),
            (Integration::Closed, _) => None,
        }
    }

    /// The ends of the sub-intervals, without 0; the end alone for a closed form.
    pub(super) fn boundaries<F: Format>(self, format: F) -> Result<Vec<F::Real>, MethodError> {
        let count = match self {
            Integration::Closed => 1,
            Integration::SubIntervals { count: 0, .. } => return Err(MethodError::NoSubIntervals),
            Integration::SubIntervals { count, .. } => u64::from(count),
        };
        Ok((1..=count).map(|i| format.fraction(i, count)).collect())
    }
}

/// A composite rule on [0, 1] as one sum, neighbours sharing their common node.
struct CompositeSum<R> {
    places: Vec<R>,
    weights: Vec<R>,
}

impl<R: Real> CompositeSum<R> {
    fn new(rule: Rule, count: u32, format: R::Format) -> Result<Self, MethodError> {
        if count == 0 {
            return Err(MethodError::NoSubIntervals);
        }
        let table = rule.table(format.bits())?;
        let mut places: Vec<Rational> = Vec::new();
        let mut weights: Vec<Rational> = Vec::new();
        for i in 0..count {
            for (node, weight) in table.nodes.iter().zip(&table.weights) {
                let place = Rational::from(node + i) / count;
                let weight = Rational::from(weight / count);
                match weights.last_mut() {
                    Some(last) if places.last() == Some(&place) => *last += weight,
                    _ => {
                        places.push(place);
                        weights.push(weight);
                    }
                }
            }
        }
        let round = |rationals: &[Rational]| rationals.iter().map(|q| format.ratio(q)).collect();
        Ok(CompositeSum {
            places: round(&places),
            weights: round(&weights),
        })
    }
}
