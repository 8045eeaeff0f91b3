//! Finished units, one a line, as they come: what is done stays, whatever ends the run.

use super::Unit;
use crate::study::sweep::Header;
use serde::Serialize;
use std::fs::File;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A file of JSON lines: what is run, then every finished unit.
#[derive(Debug)]
pub struct Journal {
    path: PathBuf,
    file: File,
}

/// The journal cannot be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write '{}': {reason} (allowed: a directory that can be written)", path.display())]
pub struct JournalError {
    path: PathBuf,
    #[source]
    reason: io::Error,
}

impl Journal {
    /// Begins a journal anew.
    ///
    /// # Errors
    /// [`JournalError`] with the path and the system's reason.
    pub fn begin(path: &Path, header: &Header) -> Result<Journal, JournalError> {
        let file = File::create(path).map_err(|reason| JournalError {
            path: path.into(),
            reason,
        })?;
        let mut journal = Journal {
            path: path.into(),
            file,
        };
        journal.write(header)?;
        Ok(journal)
    }

    /// Takes a finished unit.
    ///
    /// # Errors
    /// [`JournalError`] with the path and the system's reason.
    pub fn append(&mut self, unit: &Unit) -> Result<(), JournalError> {
        self.write(unit)
    }

    fn write(&mut self, value: &impl Serialize) -> Result<(), JournalError> {
        // The line goes in whole.
        let line = serde_json::to_vec(value).map_err(io::Error::from);
        let written = line.and_then(|mut line| {
            line.push(b'\n');
            self.file.write_all(&line)
        });
        written.map_err(|reason| JournalError {
            path: self.path.clone(),
            reason,
        })
    }
}
