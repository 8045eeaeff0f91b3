//! The paper's tables, measured again: each entry with the paper's figure, the paper's protocol, and
//! the order that exact arithmetic shows on a longer ladder.

mod deterministic;
mod entry;
mod explain;
mod protocol;
mod stochastic;
mod tables;

pub use entry::{Entry, Level};
pub use tables::{RuleName, RuleNameError, Table, TableError, TableNumber};

use self::tables::{Cell, Stochastic};
use super::Progress;
use crate::case::{Reciprocal, SineSquared};
use crate::convergence::{FitError, ReplicasError};
use crate::method::{Method, MethodError};
use crate::real::FormatName;
use crate::reference::ReferenceError;

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
    /// The inner rules of Table 1 that are asked for; none asks for all of them.
    pub inner: Vec<RuleName>,
    /// The outer rules of Table 1 that are asked for; none asks for all of them.
    pub outer: Vec<RuleName>,
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
            inner: Vec::new(),
            outer: Vec::new(),
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
        for cell in self.nested().iter().chain(&self.preintegrated()) {
            for &n in &self.ladder {
                cell.method.check_segments(n)?;
            }
        }
        Ok(())
    }

    fn nested(&self) -> Vec<Cell<Method>> {
        self.of_table(TableNumber::One, tables::nested)
    }

    fn monte_carlo(&self) -> Vec<Cell<Stochastic>> {
        self.of_table(TableNumber::One, tables::monte_carlo)
    }

    fn preintegrated(&self) -> Vec<Cell<Method>> {
        if self.tables.contains(&TableNumber::Two) {
            tables::preintegrated()
        } else {
            Vec::new()
        }
    }

    fn of_table<M>(&self, table: TableNumber, cells: fn() -> Vec<Cell<M>>) -> Vec<Cell<M>> {
        if self.tables.contains(&table) {
            tables::chosen(cells(), &self.inner, &self.outer)
        } else {
            Vec::new()
        }
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
    /// The exact radiance is not to be had.
    #[error(transparent)]
    Reference(#[from] ReferenceError),
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
    let mut entries = deterministic::entries(&SineSquared, &settings.nested(), settings, progress)?;
    entries.extend(stochastic::entries(
        &SineSquared,
        &settings.monte_carlo(),
        settings.seed,
        progress,
    )?);
    entries.sort_by_key(|entry| entry.table);
    entries.extend(deterministic::entries(
        &Reciprocal,
        &settings.preintegrated(),
        settings,
        progress,
    )?);
    Ok(entries)
}

/// Bytes that a segment takes at 128 bits: all methods of a table keep their nodes.
const BYTES: f64 = 1024.0;
/// Seconds that a unit takes at 128 bits, roughly.
const SECONDS: f64 = 1e-6;

/// How many times 128 bits the widest format has.
fn width(settings: &Settings) -> f64 {
    let bits = settings.formats.iter().map(|format| format.bits());
    bits.fold(1.0, |most, bits| f64::max(most, f64::from(bits) / 128.0))
}

/// Bytes that it will take, within a factor of a few.
#[must_use]
pub fn bytes(settings: &Settings) -> f64 {
    let finest = settings.ladder.iter().copied().max().unwrap_or(0);
    finest as f64 * BYTES * width(settings)
}

/// Seconds that it will take, within a factor of a few.
#[must_use]
pub fn seconds(settings: &Settings) -> f64 {
    // Products of long numbers take longer than they are long.
    work(settings) as f64 * SECONDS * width(settings).powf(1.6)
}

/// How many units [`Progress`] will hear of in all.
#[must_use]
pub fn work(settings: &Settings) -> u64 {
    deterministic::work(&settings.nested(), settings)
        + stochastic::work(&settings.monte_carlo())
        + deterministic::work(&settings.preintegrated(), settings)
}
