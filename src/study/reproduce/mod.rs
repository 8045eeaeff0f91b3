//! The paper's tables, measured again: each entry with the paper's figure, the paper's protocol, and
//! the order that exact arithmetic shows on a longer ladder.

mod deterministic;
mod entry;
mod explain;
mod protocol;
mod stochastic;
mod tables;

pub use entry::{Entry, Level};
pub use tables::{Table, TableError, TableNumber};

use super::Progress;
use crate::case::{Reciprocal, SineSquared};
use crate::convergence::{FitError, ReplicasError};
use crate::method::MethodError;
use crate::real::FormatName;

/// Bits of the runs that serve as truth, and in which orders are measured where nothing else is asked
/// for: the finest error of Table 1 is near 1e-23, the floor near 1e-33.
pub const ORACLE_BITS: u32 = 128;

/// The ladder orders are measured on where nothing else is asked for.
pub const LADDER: [u64; 10] = [8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096];

/// Replicas of every Monte Carlo entry.
pub const REPLICAS: usize = 64;

/// What to run.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Which tables.
    pub tables: Vec<TableNumber>,
    /// The formats that orders are measured in, one set of entries each. Monte Carlo always runs in
    /// binary64, whose roundoff is far below its scatter.
    pub formats: Vec<FormatName>,
    /// The levels n that orders are measured on.
    pub ladder: Vec<u64>,
    /// The seed of the first replica.
    pub seed: u64,
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            tables: vec![TableNumber::One, TableNumber::Two],
            formats: vec![FormatName::Mpfr(ORACLE_BITS)],
            ladder: LADDER.to_vec(),
            seed: 1,
        }
    }
}

impl Settings {
    /// Whether every level suits every method: known before anything runs.
    ///
    /// # Errors
    /// [`MethodError::Segments`] for the first that does not.
    pub fn check(&self) -> Result<(), MethodError> {
        let mut methods = Vec::new();
        if self.tables.contains(&TableNumber::One) {
            methods.extend(tables::nested().into_iter().map(|cell| cell.method));
        }
        if self.tables.contains(&TableNumber::Two) {
            methods.extend(tables::preintegrated().into_iter().map(|cell| cell.method));
        }
        for method in methods {
            for &n in &self.ladder {
                method.check_segments(n)?;
            }
        }
        Ok(())
    }
}

/// Why the tables cannot be measured.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReproduceError {
    /// A level does not suit a method.
    #[error(transparent)]
    Method(#[from] MethodError),
    /// The errors cannot be fitted.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The replicas cannot be fitted.
    #[error(transparent)]
    Replicas(#[from] ReplicasError),
}

/// Measures the tables; entries come table by table and row by row, each format after the other.
///
/// # Errors
/// [`ReproduceError::Method`] where a level is no multiple of 4, which Boole's rule needs.
pub fn reproduce(
    settings: &Settings,
    progress: &dyn Progress,
) -> Result<Vec<Entry>, ReproduceError> {
    settings.check()?;
    let mut entries = Vec::new();
    if settings.tables.contains(&TableNumber::One) {
        let cells = tables::nested();
        entries.extend(deterministic::entries(
            &SineSquared,
            &cells,
            settings,
            progress,
        )?);
        let cells = tables::monte_carlo();
        entries.extend(stochastic::entries(
            &SineSquared,
            &cells,
            settings.seed,
            progress,
        )?);
        entries.sort_by_key(|entry| entry.table);
    }
    if settings.tables.contains(&TableNumber::Two) {
        let cells = tables::preintegrated();
        entries.extend(deterministic::entries(
            &Reciprocal,
            &cells,
            settings,
            progress,
        )?);
    }
    Ok(entries)
}

/// How many units [`Progress`] will hear of in all.
#[must_use]
pub fn work(settings: &Settings) -> u64 {
    let mut units = 0;
    if settings.tables.contains(&TableNumber::One) {
        units += deterministic::work(&tables::nested(), settings);
        units += stochastic::work();
    }
    if settings.tables.contains(&TableNumber::Two) {
        units += deterministic::work(&tables::preintegrated(), settings);
    }
    units
}
