//! C̃: the radiance that each segment of the interpolated field emits to its own front.

use super::integration::{CompositeSum, Integration};
use super::interpolant::Interpolant;
use super::opacity::{closed_depth, depths_by_rule, evaluate_depth};
use super::polynomial::{antiderivative, compose, evaluate};
use super::series::attenuated_integral;
use crate::case::{Break, Nodes, Number, Structure};
use crate::method::MethodError;
use crate::method::breaks::{Allowed, Meeting};
use crate::method::limit::{Limit, Part, euler_maclaurin};
use crate::quadrature::Rule;
use crate::real::{Format, Real, row};
use rug::Rational;
use std::fmt;

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
        match self.integration {
            Integration::Closed => {
                let integrate = |field: &_| self.closed(nodes, field, &step);
                self.interpolant.integrals(nodes, n, integrate)
            }
            Integration::SubIntervals { count, rule } => {
                self.interpolant.check_segments(n)?;
                let sum = CompositeSum::new(rule, count, format)?;
                let integrate = |field: &_| self.by_rule(nodes, field, &step, rule, &sum);
                self.interpolant.integrals(nodes, n, integrate)
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
                row(sum.places.iter().map(|x| evaluate_depth(&depth, x)))
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

    /// What a break allows the integral over C(s̄)·τ(s̄), attenuated or not.
    pub(super) fn allowed_by(
        &self,
        structure: &Structure,
        place: &Break,
        ladder: Option<&[u64]>,
    ) -> Allowed {
        let power = if self.attenuated {
            place.under_transmittance()
        } else {
            place.source.clone()
        };
        let exact = self.interpolant.is_exact(structure);
        power.map_or(Allowed::All, |power| {
            let meeting = Meeting::of(place, &power, ladder);
            self.integration.allowed_by(exact, &meeting)
        })
    }

    /// What limits the order, as far as this part goes.
    pub(super) fn limits(&self, structure: &Structure) -> Vec<Limit> {
        let mut limits = Vec::new();
        let exact = self.interpolant.is_exact(structure);
        if !exact {
            let by_parabolas = self.interpolant == Interpolant::QuadraticMidpoint
                && structure.along.parabolas_hide_source;
            limits.push(Limit {
                part: Part::Source,
                order: Some(self.interpolant.order()),
                vanishes: structure.source_is_constant() || by_parabolas,
            });
            if by_parabolas && !structure.source_is_constant() {
                // By symmetry there are even orders alone.
                limits.push(Limit::new(Part::Source, self.interpolant.order() + 2.0));
            }
        }
        if !self.attenuated {
            limits.push(Limit::new(Part::NeglectedAttenuation, 1.0));
        } else if !exact && structure.extinction_degree_of(1) != Some(0) {
            // The field is off by O(d^(degree+1)), the depth inside by one order more.
            let order = self.interpolant.degree() as f64 + 2.0;
            limits.push(Limit::new(Part::AttenuationInside, order));
        }
        limits.extend(self.sub_interval_limits(structure));
        limits
    }

    /// What the rule on sub-intervals leaves of ∫ C τ e^(−t).
    ///
    /// Along an interpolated field, which has corners at all boundaries, errors of derivatives at the ends
    /// of the segments do not add up to those at the ends of the ray; errors of values do. The depth
    /// inside a segment, where it is by a rule too, is off by one order more.
    fn sub_interval_limits(&self, structure: &Structure) -> Vec<Limit> {
        let Integration::SubIntervals { rule, .. } = self.integration else {
            return Vec::new();
        };
        let order = f64::from(rule.order());
        let mut limits = euler_maclaurin(Part::SubIntervals, rule, structure);
        if !self.attenuated {
            limits = vec![Limit::new(Part::SubIntervals, order)];
        } else if !self.interpolant.is_exact(structure) {
            // Interpolants are continuous: only what is off by the values at the ends can vanish.
            limits.truncate(if rule.order() == 1 { 2 } else { 1 });
            for limit in limits.iter_mut().filter(|limit| limit.order > Some(1.0)) {
                limit.vanishes = false;
            }
        }
        let depth_is_exact = structure.transfer.is_some()
            || self
                .integration
                .order(structure.extinction_degree())
                .is_none();
        if limits.len() > 1 && !depth_is_exact {
            limits.push(Limit::new(Part::SubIntervals, order + 1.0));
        }
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
