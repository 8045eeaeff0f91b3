//! Input of a bounded length: a file, a pipe or a device is read to the end, or refused once it is too long.
//!
//! All that users hand in is read here, so that none of it can fill the memory.

use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The most bytes of a file that people write: a case, a scene, a study.
pub const WRITTEN: u64 = 1 << 20;
/// The most bytes of data that a scene names: samples, and tables of transfer functions.
pub const DATA: u64 = 1 << 24;
/// The most bytes of what programs write: plans, baselines, pages, a line of a journal, and tables of measurements.
pub const COMPUTED: u64 = 1 << 26;

/// Why there is no input.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// It cannot be read.
    #[error("{error} (allowed: a readable file of at most {most} bytes)")]
    Unreadable {
        /// What the system said.
        error: io::Error,
        /// How many bytes it may have.
        most: u64,
    },
    /// It goes on beyond its end.
    #[error("more than {most} bytes (allowed: at most {most} bytes)")]
    TooLong {
        /// How many bytes it may have.
        most: u64,
    },
    /// It is no text.
    #[error("byte {at} is not UTF-8 (allowed: a text in UTF-8, of at most {most} bytes)")]
    NotText {
        /// The first byte that is none of a text, counted from 1.
        at: usize,
        /// How many bytes it may have.
        most: u64,
    },
}

/// The bytes of a file.
///
/// # Errors
/// [`InputError`] where it cannot be read, or has more than `most` bytes.
pub fn file(path: &Path, most: u64) -> Result<Vec<u8>, InputError> {
    match File::open(path) {
        Ok(file) => bytes(file, most),
        Err(error) => Err(InputError::Unreadable { error, most }),
    }
}

/// The text of a file.
///
/// # Errors
/// [`InputError`] where it cannot be read, has more than `most` bytes, or is no text.
pub fn text(path: &Path, most: u64) -> Result<String, InputError> {
    as_text(file(path, most)?, most)
}

/// The text of standard input.
///
/// # Errors
/// As for [`text`].
pub fn standard(most: u64) -> Result<String, InputError> {
    as_text(bytes(io::stdin().lock(), most)?, most)
}

/// All that comes, of which no more than a byte beyond `most` is taken.
///
/// # Errors
/// [`InputError`] where it cannot be read, or is longer.
pub fn bytes(source: impl Read, most: u64) -> Result<Vec<u8>, InputError> {
    let mut bytes = Vec::new();
    let read = source.take(most.saturating_add(1)).read_to_end(&mut bytes);
    match read {
        Ok(count) if count as u64 > most => Err(InputError::TooLong { most }),
        Ok(_) => Ok(bytes),
        Err(error) => Err(InputError::Unreadable { error, most }),
    }
}

fn as_text(bytes: Vec<u8>, most: u64) -> Result<String, InputError> {
    String::from_utf8(bytes).map_err(|error| InputError::NotText {
        at: error.utf8_error().valid_up_to() + 1,
        most,
    })
}
