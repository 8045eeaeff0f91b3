//! `volver reproduce --nonsmooth`: what jumps and kinks cost.

use super::Reproduce;
use crate::cli::about::about;
use crate::cli::{Bar, Failure, Outcome, width};
use volver::report::nonsmooth::{json, text, write};
use volver::study::nonsmooth::{Cell, measure, work};

impl Reproduce {
    pub(super) fn nonsmooth(&self) -> Result<Outcome, Failure> {
        let bar = Bar::new(work());
        let cells = measure(&bar);
        bar.finish();
        let cells = cells.map_err(|error| Failure::Usage(error.to_string()))?;
        self.hand_out(
            || text(&cells, width(), self.color.is_on()),
            |directory| write(directory, &cells, &about()),
            || json(&cells),
        )?;
        Ok(if cells.iter().any(Cell::contradicts_theory) {
            Outcome::CheckFailed
        } else {
            Outcome::Good
        })
    }
}
