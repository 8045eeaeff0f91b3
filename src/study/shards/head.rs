//! Files of shards: their names, and the first line.

use super::division::{Divisible, Division};
use super::key::Key;
use super::line::{next, opened};
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

/// The end of the name of a file that is being written.
pub(super) const PART: &str = ".part";
/// The end of the name of one that is whole.
pub(super) const WHOLE: &str = ".jsonl";

/// The first line of a file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Head {
    pub(super) volver: String,
    pub(super) division: Key,
    pub(super) shard: usize,
    pub(super) of: usize,
}

impl Head {
    pub(super) fn new<W: Divisible>(division: &Division<W>, shard: usize) -> Head {
        Head {
            volver: division.volver.clone(),
            division: division.digest(),
            shard,
            of: division.shards(),
        }
    }

    /// What names of the shard's files begin with.
    pub(super) fn stem(&self) -> String {
        format!("{}-of-{}", self.shard, self.of)
    }
}

/// The first line of a file, where it is one of a shard's.
pub(super) fn head_of(path: &Path) -> Option<Head> {
    let line = next(&mut BufReader::new(File::open(path).ok()?)).ok()?;
    serde_json::from_str(&opened(&line)?).ok()
}
