//! Why a report cannot be made or written.

use std::io;
use std::path::PathBuf;

/// A report that cannot be made or written.
#[derive(Debug, thiserror::Error)]
pub enum ReportError {
    /// A directory cannot be made.
    #[error("cannot create the directory '{}': {reason}", path.display())]
    Directory {
        /// The directory.
        path: PathBuf,
        /// What the operating system says.
        #[source]
        reason: io::Error,
    },
    /// A file cannot be written; what stood there before is untouched.
    #[error("cannot write '{}': {reason}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What the operating system says.
        #[source]
        reason: io::Error,
    },
    /// A value has no place in JSON.
    #[error("cannot write JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A table has no place in CSV.
    #[error("cannot write CSV: {0}")]
    Csv(#[source] io::Error),
    /// A table has no place in Parquet.
    #[error("cannot write Parquet: {0}")]
    Parquet(String),
}
