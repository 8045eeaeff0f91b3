//! How an integral over a segment is taken.

use crate::method::MethodError;
use crate::method::breaks::{Allowed, Meeting};
use crate::quadrature::Rule;
use crate::real::{Format, Real, row};
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

    /// What a break allows, met along a field that is `exact` or only interpolated. On segment boundaries
    /// it is what any rule is allowed; inside, the sub-intervals are segments of their own, but the
    /// attenuation there rests on steps from node to node, of which nothing more is claimed than the
    /// leading power where that does not vanish.
    pub(super) fn allowed_by(self, exact: bool, meeting: &Meeting<'_>) -> Allowed {
        let Integration::SubIntervals { count, rule } = self else {
            return Allowed::Unknown;
        };
        if !exact {
            return Allowed::Unknown;
        }
        if meeting.is_on_nodes() {
            return meeting.allows(Some(rule), 1, false);
        }
        let Some(part) = meeting.part else {
            return meeting.allows(Some(rule), 1, false);
        };
        // n segments of `count` sub-intervals each are as many segments of one.
        let part = Rational::from(part * count);
        let within = Meeting {
            part: Some(&part),
            ..*meeting
        };
        let leading = Allowed::Order(1.0 + meeting.power.to_f64());
        match within.allows(Some(rule), 1, false) {
            allowed if allowed == leading => leading,
            _ => Allowed::Unknown,
        }
    }

    /// The ends of the sub-intervals, without 0; the end alone for a closed form.
    pub(super) fn boundaries<F: Format>(self, format: F) -> Result<Vec<F::Real>, MethodError> {
        let count = match self {
            Integration::Closed => 1,
            Integration::SubIntervals { count: 0, .. } => return Err(MethodError::NoSubIntervals),
            Integration::SubIntervals { count, .. } => u64::from(count),
        };
        Ok(row((1..=count).map(|i| format.fraction(i, count))))
    }
}

/// A composite rule on [0, 1] as one sum, neighbours sharing their common node.
pub(super) struct CompositeSum<R> {
    pub(super) places: Vec<R>,
    pub(super) weights: Vec<R>,
}

impl<R: Real> CompositeSum<R> {
    pub(super) fn new(rule: Rule, count: u32, format: R::Format) -> Result<Self, MethodError> {
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
        let round = |rationals: &[Rational]| row(rationals.iter().map(|q| format.ratio(q)));
        Ok(CompositeSum {
            places: round(&places),
            weights: round(&weights),
        })
    }
}
