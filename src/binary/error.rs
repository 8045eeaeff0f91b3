//! Why a file is not read or not written.

use std::io;
use std::path::{Path, PathBuf};

/// A file, and why it is not read or not written.
#[derive(Debug, thiserror::Error)]
#[error("{}: {trouble}", path.display())]
pub struct FileError {
    /// Which.
    pub path: PathBuf,
    /// Why.
    pub trouble: Trouble,
}

/// Why a file is not read or not written.
#[derive(Debug, thiserror::Error)]
pub enum Trouble {
    /// The system refuses it.
    #[error("{0} (allowed: a file that can be opened, and a folder that can be written to)")]
    System(io::Error),
    /// The end of its name is none that is known.
    #[error("a name that ends with '{ending}' (allowed: {allowed})")]
    Ending {
        /// After the last point.
        ending: String,
        /// What is known.
        allowed: &'static str,
    },
    /// It says something that is not taken.
    #[error("{what} (allowed: {allowed})")]
    Refused {
        /// What it says.
        what: String,
        /// What it may say.
        allowed: String,
    },
    /// It holds another number of bytes than it says.
    #[error("{have} bytes of data (allowed: {need}, as its header says)")]
    Size {
        /// How many there are.
        have: u64,
        /// How many there should be.
        need: u64,
    },
    /// It does not fit the memory.
    #[error("takes {need} bytes of memory (allowed: up to {most}, which are free)")]
    Memory {
        /// How many it takes.
        need: u64,
        /// How many there are.
        most: u64,
    },
}

impl From<io::Error> for Trouble {
    fn from(error: io::Error) -> Trouble {
        use io::ErrorKind::{InvalidData, InvalidInput, UnexpectedEof};
        match error.kind() {
            UnexpectedEof => refused("data that end too early", "as many as the header says"),
            // What decoders say.
            InvalidData | InvalidInput => refused(error.to_string(), "data as the header says"),
            _ => Trouble::System(error),
        }
    }
}

impl Trouble {
    /// Of a file.
    pub(crate) fn at(self, path: &Path) -> FileError {
        FileError {
            path: path.to_path_buf(),
            trouble: self,
        }
    }
}

/// What is not taken, and what would be.
pub(crate) fn refused(what: impl Into<String>, allowed: impl Into<String>) -> Trouble {
    Trouble::Refused {
        what: what.into(),
        allowed: allowed.into(),
    }
}
