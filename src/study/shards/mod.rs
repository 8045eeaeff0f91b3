//! Work of many units on many machines: divided, done apart, gathered.
//!
//! A [`Division`] is kept in a directory that all machines see. Each shard runs by itself, knows its number alone, and writes
//! finished units into a file of its own, which gets its name when it is whole. Nothing is locked, and no clock is compared: a
//! shard that runs twice writes the same units twice, one that was killed leaves those it had finished, and [`Gathered`] takes
//! every unit once, whichever file has it.

mod cut;
mod division;
mod gathered;
mod head;
mod key;
mod line;
mod shard;

pub use cut::cut;
pub use division::{Divisible, Division, DivisionError, kind_in};
pub use gathered::{Gathered, Part, Trouble};
pub use key::Key;
pub use shard::Shard;

use std::io;
use std::path::Path;

/// Where a directory keeps the files of its shards.
const FOLDER: &str = "shards";

/// A file for all that the directory lets in, where temporary files are private otherwise.
fn temporary<'a>() -> tempfile::Builder<'a, 'a> {
    let mut builder = tempfile::Builder::new();
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    builder
}

/// A file that cannot be used.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {error} (allowed: a file that can be read and written)")]
pub struct FileError {
    /// The file.
    pub path: String,
    /// What the system said.
    pub error: io::Error,
}

impl FileError {
    fn at(path: &Path) -> impl Fn(io::Error) -> FileError + use<> {
        let path = path.display().to_string();
        move |error| FileError {
            path: path.clone(),
            error,
        }
    }
}
