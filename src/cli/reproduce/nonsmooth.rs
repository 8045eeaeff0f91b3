//! `volver reproduce --nonsmooth`: what jumps and kinks cost.

use super::Reproduce;
use crate::cli::about::about;
use crate::cli::{Bar, Failure, Outcome};
use volver::report::nonsmooth::{document, json, write};
use volver::study::nonsmooth::{Cell, measure, work};

impl Reproduce {
    pub(super) fn nonsmooth(&self) -> Result<Outcome, Failure> {
        let bar = Bar::new(work());
        let cells = measure(&bar);
        bar.finish();
        let cells = cells.map_err(|error| Failure::Usage(error.to_string()))?;
        self.output().hand_out(
            &document(&cells, &about()),
            |directory| write(directory, &cells, &about()),
            |_| json(&cells),
        )?;
        Ok(if cells.iter().any(Cell::contradicts_theory) {
            Outcome::CheckFailed
        } else {
            Outcome::Good
        })
    }
}
