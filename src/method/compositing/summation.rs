//! Sums of many terms: what rounding makes of them.

use super::tree::Tree;
use crate::real::{Format, Real};
use std::fmt;

/// How n terms are added.
///
/// Errors are given to first order, for the unit roundoff u, a sum s and terms whose sizes add up to S.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Summation {
    /// One after the other: at most n u S.
    Naive,
    /// Neighbours first, then neighbouring pairs, and so on: at most u S log₂ n (Higham 2002, section 4.2).
    Pairwise,
    /// One after the other, what each addition rounds off being summed beside: at most u |s| + n² u² S
    /// (Neumaier 1974, algorithm IV).
    Neumaier,
}

/// A sum that can be looked at on the way.
pub(super) enum Sum<R> {
    Naive(R),
    Pairwise { tree: Tree<R>, zero: R },
    Neumaier { sum: R, compensation: R },
}

impl<R: Real> Sum<R> {
    pub(super) fn new(summation: Summation, format: R::Format) -> Self {
        let zero = format.int(0);
        match summation {
            Summation::Naive => Sum::Naive(zero),
            Summation::Pairwise => Sum::Pairwise {
                tree: Tree::new(),
                zero,
            },
            Summation::Neumaier => Sum::Neumaier {
                sum: zero.clone(),
                compensation: zero,
            },
        }
    }

    #[inline]
    pub(super) fn add(&mut self, x: &R) {
        match self {
            Sum::Naive(sum) => *sum += x,
            Sum::Pairwise { tree, .. } => tree.push(x.clone(), |front, behind| front + &behind),
            Sum::Neumaier { sum, compensation } => {
                let total = sum.clone() + x;
                // What the larger one has lost: exact where a sum is rounded to nearest in base 2.
                let lost = if sum.clone().abs() >= x.clone().abs() {
                    sum.clone() - &total + x
                } else {
                    x.clone() - &total + sum
                };
                *compensation += &lost;
                *sum = total;
            }
        }
    }

    #[inline]
    pub(super) fn value(&self) -> R {
        match self {
            Sum::Pairwise { tree, zero } => tree
                .root(|front, behind| front + &behind)
                .unwrap_or_else(|| zero.clone()),
            // Beyond the range of the format there is nothing to compensate.
            Sum::Neumaier { sum, compensation } if sum.is_finite() => sum.clone() + compensation,
            Sum::Naive(sum) | Sum::Neumaier { sum, .. } => sum.clone(),
        }
    }
}

impl fmt::Display for Summation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Summation::Naive => "naive",
            Summation::Pairwise => "pairwise",
            Summation::Neumaier => "neumaier",
        })
    }
}
