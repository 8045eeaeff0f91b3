//! How work is divided, kept where all machines see it.

use super::cut::cut;
use super::key::Key;
use super::{FOLDER, FileError, temporary};
use crate::input;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::fs;
use std::io::{self, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Where a directory keeps its division.
const FILE: &str = "shards.json";

/// Work in units that any machine can do.
pub trait Divisible: Serialize + DeserializeOwned {
    /// What it is, for a message: `study`.
    const KIND: &'static str;

    /// The command that does it: `study`.
    const COMMAND: &'static str;

    /// The key of every unit, in the order in which they are reported.
    fn keys(&self) -> Vec<Key>;

    /// A unit's name for a message.
    fn name(&self, unit: usize) -> String;

    /// What another one has otherwise, this one's and the other's; `None` where both are the same, however they are divided.
    fn difference(&self, other: &Self) -> Option<(&'static str, String, String)>;
}

/// Work and its shards.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Division<W> {
    /// What it is of: [`Divisible::KIND`].
    pub kind: String,
    /// The version of the program.
    pub volver: String,
    /// The command that does all of it on one machine.
    pub command: Vec<String>,
    /// What is divided.
    pub work: W,
    /// Seconds that each unit takes by the model of costs alone.
    pub model: Vec<f64>,
    /// The same as it is divided by: what is known of earlier runs comes in.
    pub costs: Vec<f64>,
    /// The first unit behind each shard.
    pub ends: Vec<usize>,
}

/// What a directory divides: [`Divisible::KIND`], where it divides something.
#[must_use]
pub fn kind_in(directory: &Path) -> Option<String> {
    let found = value(&directory.join(FILE)).ok()?;
    found.get("kind")?.as_str().map(Into::into)
}

fn value(path: &Path) -> Result<serde_json::Value, String> {
    let text = input::text(path, input::COMPUTED).map_err(|e| e.to_string())?;
    serde_json::from_str(&text).map_err(|e| e.to_string())
}

/// Why work is not divided so.
#[derive(Debug, thiserror::Error)]
pub enum DivisionError {
    /// A file cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// More shards than units, or none.
    #[error("{shards} shards of {units} units (allowed: 1 to {units})")]
    Shards {
        /// As asked.
        shards: usize,
        /// How many there are.
        units: usize,
    },
    /// No such shard.
    #[error("shard {shard} of {shards} (allowed: 1 to {shards})")]
    NoShard {
        /// As asked.
        shard: usize,
        /// How many there are.
        shards: usize,
    },
    /// Nothing is divided there.
    #[error("{path} is not there (allowed: a directory of shards that volver {command} made)")]
    Missing {
        /// The file.
        path: String,
        /// What makes one.
        command: &'static str,
    },
    /// What is there is no division.
    #[error("{path}: {reason} (allowed: a division as volver {command} writes it)")]
    Unreadable {
        /// The file.
        path: String,
        /// What is wrong.
        reason: String,
        /// What makes one.
        command: &'static str,
    },
    /// Another number of shards.
    #[error("{path} has {found} shards, not {wanted} (allowed: {found}, or another directory)")]
    OtherCount {
        /// The file.
        path: String,
        /// What it says.
        found: usize,
        /// As asked.
        wanted: usize,
    },
    /// Something else is divided there.
    #[error(
        "{path} divides another {kind}: its {what} are {found}, not {wanted} (allowed: the {kind} it was begun with, or another directory)"
    )]
    Other {
        /// The file.
        path: String,
        /// What it is of.
        kind: &'static str,
        /// What differs.
        what: &'static str,
        /// What the file says.
        found: String,
        /// What is asked for.
        wanted: String,
    },
}

impl<W: Divisible> Division<W> {
    /// Of work whose units cost so many seconds each by the `model`, and as far as is known.
    ///
    /// # Errors
    /// [`DivisionError::Shards`].
    pub fn new(
        work: W,
        command: Vec<String>,
        model: Vec<f64>,
        costs: Vec<f64>,
        shards: usize,
    ) -> Result<Self, DivisionError> {
        let units = costs.len();
        if !(1..=units).contains(&shards) {
            return Err(DivisionError::Shards { shards, units });
        }
        Ok(Division {
            kind: W::KIND.into(),
            volver: env!("CARGO_PKG_VERSION").into(),
            command,
            ends: cut(&costs, shards),
            work,
            model,
            costs,
        })
    }

    /// The division in a directory: this one, which is kept there if there is none yet. Of several that begin at once one is
    /// kept, whole.
    ///
    /// # Errors
    /// [`DivisionError`] where another one is there, or it cannot be kept.
    pub fn kept_in(self, directory: &Path) -> Result<Self, DivisionError> {
        let folder = directory.join(FOLDER);
        fs::create_dir_all(&folder).map_err(FileError::at(&folder))?;
        let path = directory.join(FILE);
        let at = FileError::at(&path);
        let mut file = temporary().tempfile_in(&folder).map_err(&at)?;
        let text = serde_json::to_string(&self).map_err(|e| at(e.into()))?;
        let written = file.write_all(text.as_bytes());
        written
            .and_then(|()| file.as_file().sync_all())
            .map_err(&at)?;
        match file.persist_noclobber(&path) {
            Ok(_) => Ok(self),
            Err(error) if error.error.kind() == io::ErrorKind::AlreadyExists => {
                let found = Division::<W>::open(directory)?;
                found.is_that(&self, &path)?;
                Ok(found)
            }
            Err(error) => Err(at(error.error).into()),
        }
    }

    /// The division that a directory has.
    ///
    /// # Errors
    /// [`DivisionError`] where there is none, or it is none of this version.
    pub fn open(directory: &Path) -> Result<Self, DivisionError> {
        let path = directory.join(FILE);
        if !path.exists() {
            return Err(DivisionError::Missing {
                path: path.display().to_string(),
                command: W::COMMAND,
            });
        }
        let unreadable = |reason: String| DivisionError::Unreadable {
            path: path.display().to_string(),
            reason,
            command: W::COMMAND,
        };
        let found = value(&path).map_err(unreadable)?;
        let kind = found.get("kind").and_then(serde_json::Value::as_str);
        if kind != Some(W::KIND) {
            let kind = kind.unwrap_or("nothing known").escape_debug();
            return Err(unreadable(format!("it divides a {kind}, no {}", W::KIND)));
        }
        let version = found.get("volver").and_then(serde_json::Value::as_str);
        let ours = env!("CARGO_PKG_VERSION");
        if let Some(version) = version.filter(|version| *version != ours) {
            return Err(DivisionError::Other {
                path: path.display().to_string(),
                kind: W::KIND,
                what: "numbers",
                found: format!("those of volver {}", version.escape_debug()),
                wanted: format!("those of {ours}"),
            });
        }
        let found: Division<W> =
            serde_json::from_value(found).map_err(|e| unreadable(e.to_string()))?;
        let units = found.work.keys().len();
        let ascends = found.ends.iter().is_sorted() && found.ends.last() == Some(&units);
        if !ascends || found.costs.len() != units || found.model.len() != units {
            return Err(unreadable("its shards do not cover its units".into()));
        }
        Ok(found)
    }

    /// Whether it is the one that is wanted.
    fn is_that(&self, wanted: &Self, path: &Path) -> Result<(), DivisionError> {
        if let Some((what, found, wanted)) = self.work.difference(&wanted.work) {
            return Err(DivisionError::Other {
                path: path.display().to_string(),
                kind: W::KIND,
                what,
                found,
                wanted,
            });
        }
        if self.ends.len() != wanted.ends.len() {
            return Err(DivisionError::OtherCount {
                path: path.display().to_string(),
                found: self.ends.len(),
                wanted: wanted.ends.len(),
            });
        }
        Ok(())
    }

    /// How many shards there are.
    #[must_use]
    pub fn shards(&self) -> usize {
        self.ends.len()
    }

    /// Seconds that a shard takes in the mean, and the slowest one, as they are foreseen. No shard takes less than its dearest unit,
    /// so that many shards of few dear units are uneven.
    #[must_use]
    pub fn seconds(&self) -> (f64, f64) {
        let mut begin = 0;
        let sums = self.ends.iter().map(|&end| {
            let units = self.costs.get(begin..end).unwrap_or_default();
            begin = end;
            units.iter().sum::<f64>()
        });
        let slowest = sums.fold(0.0, f64::max);
        (
            self.costs.iter().sum::<f64>() / self.shards().max(1) as f64,
            slowest,
        )
    }

    /// The units of a shard, counted from 1.
    ///
    /// # Errors
    /// [`DivisionError::NoShard`].
    pub fn units(&self, shard: usize) -> Result<Range<usize>, DivisionError> {
        let of = |place: Option<usize>| place.and_then(|place| self.ends.get(place)).copied();
        let place = shard.checked_sub(1);
        let end = of(place).ok_or(DivisionError::NoShard {
            shard,
            shards: self.shards(),
        })?;
        let begin = of(place.and_then(|place| place.checked_sub(1)));
        Ok(begin.unwrap_or(0)..end)
    }

    /// The shard that a unit is in, counted from 1.
    #[must_use]
    pub fn shard_of(&self, unit: usize) -> usize {
        self.ends.partition_point(|end| *end <= unit) + 1
    }

    /// What shards of it know each other by.
    pub(super) fn digest(&self) -> Key {
        let keys: Vec<String> = self.work.keys().iter().map(ToString::to_string).collect();
        let ends = format!("{:?}", self.ends);
        Key::of(keys.iter().map(String::as_str).chain([ends.as_str()]))
    }

    /// Where the files of its shards are.
    pub(super) fn folder(directory: &Path) -> PathBuf {
        directory.join(FOLDER)
    }
}
