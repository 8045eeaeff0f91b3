//! Cases × methods × formats × levels, every error split into its parts or known as a whole alone.
//!
//! Work comes in units of one case in one format, under all methods at all levels, or in [`Block`]s of these. A [`Journal`]
//! takes each unit when it is finished; what is reported is made of a journal's units alone, so that a study that was cut
//! off and resumed gives the same bytes as one that was not.

mod between;
mod block;
mod divided;
mod errors;
mod estimate;
mod file;
mod floor;
mod journal;
mod keep;
mod kept;
mod number;
mod pieces;
mod record;
mod results;
mod run;
mod stopped;
mod summary;
mod total;

pub use between::between;
pub use block::Block;
pub use divided::{Divided, StudyShard};
pub use errors::{Errors, ErrorsError};
pub use estimate::Estimate;
pub use file::{FileLevels, StudyFile, StudyFileError, StudyFileProblem};
pub use journal::{Journal, JournalError};
pub use keep::Keep;
pub use record::{Header, LevelRecord, Part, Row, State, Theory, Unit};
pub use results::{Line, Results};
pub use run::{Statistics, run};
pub use stopped::SweepError;
pub use summary::{Bits, SplitSummary, Summary, TOLERANCES, summarize};

use crate::case::SymbolicCase;
use crate::method::Method;
use crate::real::FormatName;

/// What to run.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The cases, each with the name it is reported by; names differ.
    pub cases: Vec<(String, SymbolicCase)>,
    /// The methods.
    pub methods: Vec<Method>,
    /// The formats.
    pub formats: Vec<FormatName>,
    /// Numbers of segments, ascending.
    pub levels: Vec<u64>,
    /// Whether errors are split.
    pub errors: Errors,
}
