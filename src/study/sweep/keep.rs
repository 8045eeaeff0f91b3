//! Where finished units go.

use super::journal::Journal;
use super::record::Unit;
use super::stopped::SweepError;

/// Takes units as they are finished.
pub trait Keep: Send {
    /// Whether that unit is still to be done.
    fn wants(&self, case: &str, format: &str) -> bool;

    /// Takes one, which took so many seconds.
    ///
    /// # Errors
    /// [`SweepError`] where it cannot be kept.
    fn keep(&mut self, unit: Unit, took: f64) -> Result<(), SweepError>;
}

impl Keep for Journal {
    fn wants(&self, case: &str, format: &str) -> bool {
        !self.has(case, format)
    }

    fn keep(&mut self, unit: Unit, _: f64) -> Result<(), SweepError> {
        Ok(self.append(unit)?)
    }
}
