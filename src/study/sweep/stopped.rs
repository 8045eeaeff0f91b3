//! Why a study comes to no end.

use super::journal::JournalError;
use crate::study::shards;

/// Why a study stopped.
#[derive(Debug, thiserror::Error)]
pub enum SweepError {
    /// Its journal cannot be written.
    #[error(transparent)]
    Journal(#[from] JournalError),
    /// Its shard's file cannot be written.
    #[error(transparent)]
    Shard(#[from] shards::FileError),
    /// A thread ended before its work did.
    #[error("a thread of the study ended early (allowed: enough memory for the study)")]
    Thread,
}
