//! Where finished units go.

use super::Sweep;
use super::block::Block;
use super::journal::Journal;
use super::record::Unit;
use super::stopped::SweepError;

/// Takes units as they are finished.
pub trait Keep: Send {
    /// What is still to be done.
    fn left(&self, sweep: &Sweep) -> Vec<Block>;

    /// Takes what a block has of its unit, which took so many seconds.
    ///
    /// # Errors
    /// [`SweepError`] where it cannot be kept.
    fn keep(&mut self, block: &Block, unit: Unit, took: f64) -> Result<(), SweepError>;
}

impl Keep for Journal {
    fn left(&self, sweep: &Sweep) -> Vec<Block> {
        let names = sweep.cases.iter().flat_map(|(name, _)| {
            let formats = sweep.formats.iter();
            formats.map(move |format| (name, format.to_string()))
        });
        let done = self.names();
        let whole = Block::whole_of(sweep).into_iter().zip(names);
        let left =
            whole.filter(|(_, (case, format))| !done.contains(&(case.as_str(), format.as_str())));
        left.map(|(block, _)| block).collect()
    }

    fn keep(&mut self, _: &Block, unit: Unit, _: f64) -> Result<(), SweepError> {
        Ok(self.append(unit)?)
    }
}
