//! What the levels of a row tell together.

use super::Errors;
use super::record::{LevelRecord, Part, Row, State, Unit};
use crate::convergence::{Best, ErrorModel, Fit, FitError, Laws, Sample, Split, fit};
use crate::method::Expected;
use crate::real::{MpfrReal, Real};
use rug::Float;
use serde::Serialize;

/// Errors relative to |I| for which the bits they need are told.
pub const TOLERANCES: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

/// One method on one case in one format, all levels together.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// The order of the total error: what a user of the format sees, roundoff being its floor.
    pub total: Fit,
    /// What the parts tell; `None` of a study of [`Errors::Total`].
    #[serde(flatten)]
    pub split: Option<SplitSummary>,
}

/// What the parts of errors tell, all levels together.
#[derive(Clone, Debug, Serialize)]
pub struct SplitSummary {
    /// The order of the discretization error, with what theory expects.
    pub discretization: Fit,
    /// How roundoff grows with n.
    pub laws: Laws,
    /// n*: from there on roundoff is larger than discretization.
    pub crossing: Option<f64>,
    /// The least error that the method can reach in the format.
    pub best: Option<Best>,
    /// The fewest bits for each of [`TOLERANCES`], by the model.
    pub bits_needed: [Bits; TOLERANCES.len()],
    /// The model behind n* and the least error.
    #[serde(skip)]
    pub model: ErrorModel,
}

impl Summary {
    /// The order that is set beside theory: of the discretization where that is known, else of the total.
    #[must_use]
    pub fn order(&self) -> &Fit {
        self.split
            .as_ref()
            .map_or(&self.total, |split| &split.discretization)
    }
}

/// The bits that a tolerance needs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bits {
    /// Relative to |I|.
    pub tolerance: f64,
    /// The fewest significant bits with which some n reaches it; `None` where none does, or I is 0.
    pub bits: Option<u32>,
}

/// The summary of a row of `unit`, on a ray of that length. Without a level that is split, or known as a whole where that is
/// asked for, there is nothing to fit, and the verdict says so.
///
/// # Errors
/// [`FitError`], which levels that ascend do not cause.
pub fn summarize(unit: &Unit, row: &Row, length: f64, errors: Errors) -> Result<Summary, FitError> {
    Ok(Summary {
        total: total(unit, row, length)?,
        split: match errors {
            Errors::Split => Some(summarize_split(unit, row, length)?),
            Errors::Total => None,
        },
    })
}

fn total(unit: &Unit, row: &Row, length: f64) -> Result<Fit, FitError> {
    let unit_roundoff = Float::with_val(64, unit.radiance.abs_ref()) >> unit.bits;
    let total: Vec<Sample> = row
        .levels
        .iter()
        .filter(|level| !matches!(level.state, State::Refused(_)))
        .filter_map(|level| {
            let error = level.part(Part::Total)?;
            // Where the error is neither split nor its floor foreseen, nothing is known of that but u·|I|.
            let rounding = level.split().map(|split| split.rounding().abs());
            let floor = rounding
                .or_else(|| level.floor.clone())
                .filter(|r| *r > unit_roundoff)
                .unwrap_or_else(|| unit_roundoff.clone());
            Some(sample(level.n, length, error, &floor))
        })
        .collect();
    fit(&total, Some(Expected::from(row.expected)))
}

fn summarize_split(unit: &Unit, row: &Row, length: f64) -> Result<SplitSummary, FitError> {
    let expected = Expected::from(row.expected);
    let split = |level: &LevelRecord| Some((level.n, level.split()?));
    let splits: Vec<(u64, Split)> = row.levels.iter().filter_map(split).collect();
    let discretization: Vec<Sample> = splits
        .iter()
        .map(|(n, split)| sample(*n, length, &split.discretization, &split.resolution))
        .collect();
    let discretization = fit(&discretization, Some(expected))?;
    let mut all = splits;
    all.extend(row.between.iter().filter_map(split));
    all.sort_by_key(|(n, _)| *n);
    let by_reference: Vec<(u64, &Split)> = all.iter().map(|(n, split)| (*n, split)).collect();
    let order = discretization
        .window
        .and(discretization.order)
        .or(match expected {
            Expected::Order(p) | Expected::Blind { here: p, .. } if p > 0.0 => Some(p),
            _ => None,
        });
    let model = ErrorModel::new(&by_reference, unit.bits, order);
    Ok(SplitSummary {
        discretization,
        laws: model.laws,
        crossing: model.crossing(),
        best: model.best(),
        bits_needed: bits_needed(&model, &unit.radiance),
        model,
    })
}

fn bits_needed(model: &ErrorModel, radiance: &Float) -> [Bits; TOLERANCES.len()] {
    let size = MpfrReal::from(radiance.clone()).log2_abs();
    let wanted = TOLERANCES.map(|tolerance| size + tolerance.log2());
    // Relative to 0 nothing is asked for.
    let found = if size.is_finite() {
        model.bits_for_each(wanted)
    } else {
        [None; TOLERANCES.len()]
    };
    let mut found = found.into_iter();
    TOLERANCES.map(|tolerance| Bits {
        tolerance,
        bits: found.next().flatten(),
    })
}

fn sample(n: u64, length: f64, error: &Float, floor: &Float) -> Sample {
    Sample {
        n: Some(n),
        step: length / n as f64,
        error: error.clone(),
        floor: floor.clone(),
    }
}
