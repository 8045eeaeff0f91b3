//! Taylor remainders |f(x + hv) − f(x) − h g·v|: of the second order where g is the gradient of f.

use super::table::Remainder;
use super::{Fit, FitError, Sample, Verdict, fit};
use crate::method::Expected;
use rug::Float;

/// The order of the remainder of a right gradient.
const ORDER: f64 = 2.0;
/// Least part of the remainder at the finest step that shows as one of the first order …
const PART: f64 = 0.05;
/// … and so many times what two powers leave unexplained.
const MARGIN: f64 = 3.0;
/// Coarse steps, where more powers are, are left out until two powers explain the rest to such a part: the first that does.
const EXPLAINED: [f64; 3] = [0.001, 0.01, 0.05];
/// Fewest levels that two powers are believed of.
const LEVELS: usize = 4;
/// Most: the finest of them.
const MOST_LEVELS: usize = 32;
/// Finest levels that fall more slowly than that are roundoff: of a gradient, however wrong, remainders fall as h …
const ROUNDOFF: f64 = 0.6;
/// … if there are so many.
const ROUNDED: usize = 3;
/// An order this close to 1 is one.
const FIRST: f64 = 0.25;

/// What remainders say of a gradient.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Smoothness {
    /// Of the second order: the gradient is right.
    Second,
    /// Of a higher order: the gradient is right, and f has no curvature along v.
    Higher,
    /// 0 at every step: the gradient is right, and f is linear along v.
    Zero,
    /// A part of the first order is left: the gradient is wrong.
    First,
    /// A remainder is NaN or infinite.
    NotFinite,
    /// The steps do not tell.
    Unclear,
}

impl Smoothness {
    /// Its name, as in JSON.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Smoothness::Second => "second-order",
            Smoothness::Higher => "higher-order",
            Smoothness::Zero => "zero",
            Smoothness::First => "first-order",
            Smoothness::NotFinite => "not-finite",
            Smoothness::Unclear => "unclear",
        }
    }

    /// Whether the gradient is right.
    #[must_use]
    pub fn passes(self) -> bool {
        matches!(
            self,
            Smoothness::Second | Smoothness::Higher | Smoothness::Zero
        )
    }
}

/// Remainders as two powers, a h + b h².
#[derive(Clone, Debug, PartialEq)]
pub struct Taylor {
    /// What they say.
    pub smoothness: Smoothness,
    /// The order of those above roundoff, with 2 expected.
    pub fit: Fit,
    /// All of them.
    pub samples: Vec<Sample>,
    /// The first level at roundoff.
    pub roundoff: Option<usize>,
    /// a, where four steps or more are two powers; its sign is unknown.
    pub first: Option<f64>,
    /// b, likewise.
    pub second: Option<f64>,
    /// |f′| along v, as given or from the changes.
    pub slope: Option<f64>,
}

impl Taylor {
    /// How much of the slope the gradient is off, where that is known and the gradient wrong.
    #[must_use]
    pub fn wrong_by(&self) -> Option<f64> {
        if self.smoothness != Smoothness::First {
            return None;
        }
        let part = self.first?.abs() / self.slope?.abs();
        part.is_finite().then_some(part)
    }
}

/// Two powers, and the largest relative residual.
#[derive(Clone, Copy, Debug)]
struct Powers {
    first: f64,
    second: f64,
    residual: f64,
}

/// Fits remainders from the largest step to the smallest. `slope` is g·v, where no changes are there; `floor` the
/// roundoff of every remainder, where it is known: else it is found where remainders stop falling.
///
/// # Errors
/// [`FitError`] where steps do not descend, or the floor is negative.
pub fn taylor(
    remainders: &[Remainder],
    slope: Option<f64>,
    floor: Option<&Float>,
) -> Result<Taylor, FitError> {
    let samples: Vec<Sample> = remainders
        .iter()
        .map(|one| Sample {
            n: None,
            step: one.step,
            error: one.remainder.clone().abs(),
            floor: floor.map_or_else(|| Float::new(f64::MANTISSA_DIGITS), Float::clone),
        })
        .collect();
    let own = if floor.is_none() {
        slow(&samples)
    } else {
        None
    };
    let above = samples
        .get(..own.unwrap_or(samples.len()))
        .unwrap_or_default();
    let fit = fit(above, Some(Expected::Order(ORDER)))?;
    let roundoff = fit.cut.as_ref().map(|cut| cut.level).or(own);
    let usable = roundoff.unwrap_or(samples.len());
    let above = samples.get(..usable).unwrap_or_default();
    let points: Vec<(f64, f64)> = above
        .iter()
        .map(|sample| (sample.step, sample.error.to_f64()))
        .collect();
    let (levels, powers) = explained(&points).unzip();
    let smoothness = judge(&fit, &points, powers);
    let first = match (smoothness, powers) {
        // One power alone: more levels than two powers explain.
        (Smoothness::First, None) => points.last().map(|(step, size)| size / step),
        (_, powers) => powers.map(|powers| powers.first.abs()),
    };
    let changes: Option<Vec<(f64, f64)>> = remainders
        .get(..usable)
        .unwrap_or_default()
        .iter()
        .map(|one| Some((one.step, one.change.as_ref()?.to_f64().abs())))
        .collect();
    let of_changes = changes.and_then(|changes| {
        let finest = changes.len().checked_sub(levels.unwrap_or(LEVELS))?;
        two_powers(changes.get(finest..)?).map(|powers| powers.first.abs())
    });
    Ok(Taylor {
        smoothness,
        first,
        second: powers.map(|powers| powers.second.abs()),
        slope: slope.map(f64::abs).or(of_changes),
        fit,
        samples,
        roundoff,
    })
}

/// The first of the levels from which on remainders hardly fall.
fn slow(samples: &[Sample]) -> Option<usize> {
    let last = samples.last()?;
    let size = |sample: &Sample| sample.error.to_f64();
    let is_slow = |(_, sample): &(usize, &Sample)| {
        let order = (size(sample) / size(last)).ln() / (sample.step / last.step).ln();
        order < ROUNDOFF
    };
    let candidates = samples.len().checked_sub(ROUNDED - 1)?;
    let levels = samples.iter().enumerate().take(candidates).rev();
    // Where two powers cancel they fall slowly too, and then as h again.
    levels.take_while(is_slow).last().map(|(level, _)| level)
}

fn judge(fit: &Fit, points: &[(f64, f64)], powers: Option<Powers>) -> Smoothness {
    let part = powers.zip(points.last()).map(|(powers, (step, _))| {
        let [first, second] = [powers.first * step, powers.second * step * step].map(f64::abs);
        (first / (first + second), powers.residual)
    });
    let shows_first = part.is_some_and(|(part, residual)| part >= PART.max(MARGIN * residual));
    let is_first = fit.verdict == Verdict::TooLow
        && fit.order.is_some_and(|order| (order - 1.0).abs() <= FIRST);
    match fit.verdict {
        Verdict::NotFinite => Smoothness::NotFinite,
        Verdict::Exact => Smoothness::Zero,
        _ if is_first || shows_first => Smoothness::First,
        Verdict::Confirmed => Smoothness::Second,
        Verdict::TooHigh => Smoothness::Higher,
        _ => Smoothness::Unclear,
    }
}

/// Two powers of the finest levels, as many as they explain, and of how many; `None` of fewer than four.
fn explained(points: &[(f64, f64)]) -> Option<(usize, Powers)> {
    let levels = (LEVELS..=points.len().min(MOST_LEVELS)).rev();
    let fits: Vec<(usize, Powers)> = levels
        .filter_map(|levels| {
            let finest = points.get(points.len() - levels..)?;
            Some((levels, two_powers(finest)?))
        })
        .collect();
    let within = |part: &f64| {
        let mut fits = fits.iter();
        fits.find(|(_, powers)| powers.residual <= *part).copied()
    };
    EXPLAINED.iter().find_map(within)
}

/// |a h + b h²| by least squares of relative errors. Where a and b differ in sign it changes sign once, somewhere: all
/// places are tried.
fn two_powers(points: &[(f64, f64)]) -> Option<Powers> {
    let tried = (0..points.len()).filter_map(|turned| {
        let signed = points.iter().enumerate().map(|(index, (step, size))| {
            let sign = if index < turned { -1.0 } else { 1.0 };
            // Relative: the equation of a level is divided by its size.
            (sign * step / size, sign * step * step / size)
        });
        solve(&signed.collect::<Vec<(f64, f64)>>())
    });
    let best = tried.min_by(|a, b| a.residual.total_cmp(&b.residual));
    best.filter(|powers| powers.residual.is_finite())
}

/// a u + b w ≈ 1 at every level.
fn solve(equations: &[(f64, f64)]) -> Option<Powers> {
    // Steps may be of any size: columns are scaled to 1.
    let scale = |of: &dyn Fn(&(f64, f64)) -> f64| {
        equations
            .iter()
            .map(|one| of(one).abs())
            .fold(0.0, f64::max)
    };
    let (of_u, of_w) = (scale(&|one| one.0), scale(&|one| one.1));
    let scaled: Vec<(f64, f64)> = equations
        .iter()
        .map(|(u, w)| (u / of_u, w / of_w))
        .collect();
    let sum = |of: &dyn Fn(&(f64, f64)) -> f64| scaled.iter().map(of).sum::<f64>();
    let (uu, uw, ww) = (
        sum(&|e| e.0 * e.0),
        sum(&|e| e.0 * e.1),
        sum(&|e| e.1 * e.1),
    );
    let (u, w) = (sum(&|e| e.0), sum(&|e| e.1));
    let determinant = uu * ww - uw * uw;
    if !(determinant.is_finite() && determinant > 0.0) {
        return None;
    }
    let (a, b) = (
        (u * ww - w * uw) / determinant,
        (w * uu - u * uw) / determinant,
    );
    let off = scaled.iter().map(|e| (a * e.0 + b * e.1 - 1.0).abs());
    Some(Powers {
        first: a / of_u,
        second: b / of_w,
        residual: off.fold(0.0, f64::max),
    })
}
