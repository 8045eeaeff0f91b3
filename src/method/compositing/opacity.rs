//! A segment's opacity from its optical depth.

use crate::real::special::relative_opacity;
use crate::real::{Format, Real, row};
use std::fmt;

/// How the opacity α of a segment is computed from its optical depth x = τ d.
///
/// The first three are 1 − e^(−x) in exact arithmetic. At small x the subtraction loses what e^(−x) has lost
/// beside 1: an absolute error of half a unit of 1 in an opacity of size x.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum OpacityFormula {
    /// 1 − exp(−x), as renderers mostly have it (Max 1995, equation 9).
    Subtraction,
    /// −expm1(−x).
    Expm1,
    /// x·(1 − e^(−x))/x, with [`relative_opacity`].
    Relative,
    /// x, uncorrected: the first term of the series, of order 1 whatever the position.
    Linear,
}

impl OpacityFormula {
    /// α of a segment of optical depth x.
    #[inline]
    pub fn of<R: Real>(self, x: &R) -> R {
        match self {
            OpacityFormula::Subtraction => x.format().int(1) - &(-x.clone()).exp(),
            OpacityFormula::Expm1 => -(-x.clone()).exp_m1(),
            OpacityFormula::Relative => relative_opacity(x) * x,
            OpacityFormula::Linear => x.clone(),
        }
    }

    /// α of each of a row, with the bits of [`OpacityFormula::of`].
    pub(super) fn of_row<R: Real>(self, x: &[R]) -> Vec<R> {
        let negatives = || row(x.iter().map(|x| -x.clone()));
        match self {
            OpacityFormula::Subtraction => {
                let mut transmittances = negatives();
                R::exp_row(&negatives(), &mut transmittances);
                row(transmittances.iter().map(|t| t.format().int(1) - t))
            }
            OpacityFormula::Expm1 => {
                let mut opacities = negatives();
                R::exp_m1_row(&negatives(), &mut opacities);
                row(opacities.into_iter().map(|opacity| -opacity))
            }
            OpacityFormula::Relative | OpacityFormula::Linear => row(x.iter().map(|x| self.of(x))),
        }
    }
}

impl fmt::Display for OpacityFormula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            OpacityFormula::Subtraction => "subtraction",
            OpacityFormula::Expm1 => "expm1",
            OpacityFormula::Relative => "relative",
            OpacityFormula::Linear => "linear",
        })
    }
}
