//! Figures: convergence plots, and cases along their ray.
//!
//! Convergence is |error| against segments on logarithmic axes, with the slope of every order found.
//! Marks stand at levels, filled where the order was fitted; a mark that points down is an error
//! below 0, so that sign changes show. Logarithms are taken of the numbers themselves: errors below
//! binary64's range are drawn like any other. Errors that are 0, NaN or infinite have no place on a
//! logarithmic axis; the curve breaks there, and the legend says the verdict.
//!
//! The same measurement gives the same bytes. Text is left to the reader's sans-serif font.

mod area;
mod axes;
pub(super) mod canvas;
mod case;
mod curve;
mod figure;
mod guide;
mod heat;
mod key;
mod mark;
mod of_fit;
mod panel;
mod place;
pub(super) mod plots;
mod scale;
mod slopes;
mod split;
pub(super) mod style;
mod tradeoff;
mod triangle;

use super::{Group, ReportError};
use crate::case::manufacture::Manufactured;
use crate::convergence::{Fit, Sample};
use crate::study::sweep::Line;
use crate::study::tradeoff::{CaseResults, Cost};

/// One panel for every row of a table, in it one curve a column. With replicas the curve is their
/// standard deviation, and |bias| is dashed.
///
/// Rows without a single error to draw have no panel; a line of text names them.
///
/// # Errors
///
/// [`ReportError::Draw`], which no entry is known to cause.
pub fn table_plot(group: &Group<'_>) -> Result<String, ReportError> {
    figure::figure(&group.title(), &curve::panels(group))
}

/// One set of samples, coarse to fine, with its fit.
///
/// Against segments n where every sample has n, otherwise against the step.
///
/// # Errors
///
/// [`ReportError::Draw`], which no sample is known to cause.
pub fn convergence_plot(samples: &[Sample], fit: &Fit, title: &str) -> Result<String, ReportError> {
    figure::figure(title, &[of_fit::of_fit(samples, fit)])
}

/// The channels of one case along its ray: field, emission, extinction, transmittance and radiance, in
/// panels one below the other.
///
/// Places where the case is not analytic are dashed; curves break at jumps and where there is no value.
///
/// # Errors
///
/// [`ReportError::Draw`], which no case is known to cause.
pub fn case_plot(title: &str, channels: &[Manufactured]) -> Result<String, ReportError> {
    case::figure(title, channels)
}

/// The parts of a method's error on a case against n, one panel a format: measured, with thin curves that were
/// fitted, and a line at n*, from where on roundoff is larger than discretization.
///
/// Levels where a part is 0, or so small that the oracle's rounding hides it, are left out.
///
/// # Errors
///
/// [`ReportError::Draw`], which no study is known to cause.
pub fn split_plot(title: &str, lines: &[&Line]) -> Result<String, ReportError> {
    figure::figure(title, &split::panels(lines))
}

/// A map of correct decimal digits over n and the bits of a format, from lines that differ in bits alone.
///
/// # Errors
///
/// [`ReportError::Draw`], which no study is known to cause.
pub fn digits_plot(title: &str, lines: &[&Line]) -> Result<String, ReportError> {
    heat::figure(title, lines)
}

/// Error against cost of every run on a case, both logarithmic, with the Pareto front and what is usual.
///
/// The front's methods are numbered, and listed beside. Runs without an error that has a logarithm are counted
/// below.
///
/// # Errors
///
/// [`ReportError::Draw`], which no comparison is known to cause.
pub fn tradeoff_plot(case: &CaseResults, cost: Cost) -> Result<String, ReportError> {
    tradeoff::figure(case, cost)
}

#[cfg(test)]
mod tests;
