//! Finished units, one a line, appended as they come.

use super::Errors;
use super::record::{Header, LevelRecord, Row, State, Unit};
use crate::input;
use crate::study::shards;
use serde::Serialize;
use std::collections::{HashMap, HashSet};
use std::fs::{File, OpenOptions};
use std::io::{self, BufRead, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// A file of finished units behind a header. Every line is written whole and to the disk; a last line that was
/// cut off is dropped and done again.
#[derive(Debug)]
pub struct Journal {
    /// `None` where nobody will go on with it.
    kept: Option<Kept>,
    units: Vec<Unit>,
}

/// Where it is kept.
#[derive(Debug)]
struct Kept {
    path: PathBuf,
    file: File,
}

/// Why a journal cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum JournalError {
    /// The file cannot be read or written.
    #[error("{path}: {error} (allowed: a file that can be read and written)")]
    File {
        /// The file.
        path: String,
        /// What the system said.
        error: io::Error,
    },
    /// A shard's file cannot be read.
    #[error(transparent)]
    Shard(#[from] shards::FileError),
    /// There are results already.
    #[error("{path} holds results already (allowed: --resume to go on, or another directory)")]
    Exists {
        /// The file.
        path: String,
    },
    /// The first line is none of this program's.
    #[error("{path} is no journal of a study (allowed: a directory that volver study wrote)")]
    NoHeader {
        /// The file.
        path: String,
    },
    /// The results belong to a study of something else.
    #[error(
        "{path} holds another study: its {what} are {found}, not {wanted} (allowed: the study it was begun with)"
    )]
    OtherStudy {
        /// The file.
        path: String,
        /// What differs.
        what: &'static str,
        /// What the file says.
        found: String,
        /// What is asked for.
        wanted: String,
    },
    /// A line in the middle is no unit of this study.
    #[error("{path}, line {line}: {reason} (allowed: lines as volver study writes them)")]
    Line {
        /// The file.
        path: String,
        /// Which line, from 1.
        line: usize,
        /// What is wrong.
        reason: String,
    },
}

impl Journal {
    /// A journal that is kept nowhere: of a study whose results nobody goes on with.
    #[must_use]
    pub fn unkept() -> Journal {
        Journal {
            kept: None,
            units: Vec::new(),
        }
    }

    /// Begins a journal; there must be none yet.
    ///
    /// # Errors
    /// [`JournalError::Exists`], [`JournalError::File`].
    pub fn begin(path: &Path, header: &Header) -> Result<Journal, JournalError> {
        let opened = OpenOptions::new()
            .read(true)
            .append(true)
            .create_new(true)
            .open(path);
        let file = match opened {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                return Err(JournalError::Exists {
                    path: path.display().to_string(),
                });
            }
            Err(error) => return Err(at(path)(error)),
        };
        let mut journal = Journal {
            kept: Some(Kept {
                path: path.into(),
                file,
            }),
            units: Vec::new(),
        };
        journal.write(header)?;
        Ok(journal)
    }

    /// Goes on with a journal of the same study, or begins it where there is none.
    ///
    /// # Errors
    /// [`JournalError`] where the file is no such journal.
    pub fn resume(path: &Path, header: &Header) -> Result<Journal, JournalError> {
        let opened = OpenOptions::new().read(true).append(true).open(path);
        let mut file = match opened {
            Ok(file) => file,
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                return Journal::begin(path, header);
            }
            Err(error) => return Err(at(path)(error)),
        };
        let (units, whole) = read(path, &mut file, header)?;
        // What is left of a line that was cut off.
        file.set_len(whole).map_err(at(path))?;
        file.seek(SeekFrom::End(0)).map_err(at(path))?;
        let mut journal = Journal {
            kept: Some(Kept {
                path: path.into(),
                file,
            }),
            units,
        };
        if whole == 0 {
            journal.write(header)?;
        }
        Ok(journal)
    }

    /// Takes a finished unit.
    ///
    /// # Errors
    /// [`JournalError::File`].
    pub fn append(&mut self, unit: Unit) -> Result<(), JournalError> {
        self.write(&unit)?;
        self.units.push(unit);
        Ok(())
    }

    /// Case and format of all units that are finished.
    #[must_use]
    pub fn names(&self) -> HashSet<(&str, &str)> {
        self.units.iter().map(name).collect()
    }

    /// How many units are finished.
    #[must_use]
    pub fn len(&self) -> usize {
        self.units.len()
    }

    /// Whether none is.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.units.is_empty()
    }

    /// The finished units in the order of the header, whichever came first.
    #[must_use]
    pub fn ordered(&self, header: &Header) -> Vec<&Unit> {
        let places: HashMap<(&str, &str), &Unit> =
            self.units.iter().map(|unit| (name(unit), unit)).collect();
        let find = |name: (&str, &str)| places.get(&name).copied();
        header.units().filter_map(find).collect()
    }

    /// Writes the journal anew, its units in the order of the header: so that the file is the same, whichever
    /// unit was finished first.
    ///
    /// # Errors
    /// [`JournalError::File`].
    pub fn finish(self, header: &Header) -> Result<Vec<Unit>, JournalError> {
        let units: Vec<Unit> = self.ordered(header).into_iter().cloned().collect();
        let Some(Kept { path, .. }) = self.kept else {
            return Ok(units);
        };
        write_whole(&path, header, &units)?;
        Ok(units)
    }

    fn write(&mut self, value: &impl Serialize) -> Result<(), JournalError> {
        let Some(Kept { path, file }) = &mut self.kept else {
            return Ok(());
        };
        let written = file.write_all(line(value).as_bytes());
        written.and_then(|()| file.sync_data()).map_err(at(path))
    }
}

/// Writes a journal of finished units, in one piece.
pub(super) fn write_whole(
    path: &Path,
    header: &Header,
    units: &[Unit],
) -> Result<(), JournalError> {
    let temporary = path.with_extension("jsonl.new");
    let file = File::create(&temporary).map_err(at(&temporary))?;
    let mut writer = BufWriter::new(&file);
    let mut lines = std::iter::once(line(header)).chain(units.iter().map(line));
    let written = lines.try_for_each(|line| writer.write_all(line.as_bytes()));
    let written = written.and_then(|()| writer.flush());
    written
        .and_then(|()| file.sync_all())
        .map_err(at(&temporary))?;
    std::fs::rename(&temporary, path).map_err(at(path))
}

/// The units of a journal, and how many of its bytes are whole lines.
fn read(path: &Path, file: &mut File, header: &Header) -> Result<(Vec<Unit>, u64), JournalError> {
    let mut reader = BufReader::new(file);
    let shape = Shape::new(header);
    let mut units: Vec<Unit> = Vec::new();
    let mut names = HashSet::new();
    let mut whole = 0;
    for number in 1.. {
        let mut bytes = Vec::new();
        let mut line_of = (&mut reader).take(input::COMPUTED + 1);
        let count = line_of.read_until(b'\n', &mut bytes).map_err(at(path))?;
        if count as u64 > input::COMPUTED {
            return Err(JournalError::Line {
                path: path.display().to_string(),
                line: number,
                reason: format!("more than {} bytes", input::COMPUTED),
            });
        }
        if bytes.last() != Some(&b'\n') {
            // The end, or a line that was cut off; a file of something else is not for us to cut.
            if number == 1 && !line(header).as_bytes().starts_with(&bytes) {
                return Err(JournalError::NoHeader {
                    path: path.display().to_string(),
                });
            }
            break;
        }
        if number == 1 {
            let found = serde_json::from_slice(&bytes);
            let found: Header = found.map_err(|_| JournalError::NoHeader {
                path: path.display().to_string(),
            })?;
            same(path, &found, header)?;
        } else {
            let wrong = |reason: String| JournalError::Line {
                path: path.display().to_string(),
                line: number,
                reason,
            };
            let unit: Unit = serde_json::from_slice(&bytes).map_err(|e| wrong(e.to_string()))?;
            shape.check(&unit).map_err(wrong)?;
            if !names.insert((unit.case.clone(), unit.format.clone())) {
                return Err(wrong(format!(
                    "{} in {} stands there twice",
                    unit.case, unit.format
                )));
            }
            units.push(unit);
        }
        whole += count as u64;
    }
    Ok((units, whole))
}

/// What the units of a study look like.
pub(super) struct Shape<'h> {
    header: &'h Header,
    units: HashSet<(&'h str, &'h str)>,
    between: Vec<u64>,
}

impl<'h> Shape<'h> {
    pub(super) fn new(header: &'h Header) -> Self {
        Shape {
            header,
            units: header.units().collect(),
            between: header.errors.between(&header.levels),
        }
    }

    /// Whether a unit is one of this study.
    pub(super) fn check(&self, unit: &Unit) -> Result<(), String> {
        let Unit {
            case, format, rows, ..
        } = unit;
        let header = self.header;
        if !self.units.contains(&(case.as_str(), format.as_str())) {
            return Err(format!("{case} in {format} is no unit of this study"));
        }
        let methods = rows.iter().map(|row| &row.method);
        if !methods.eq(&header.methods) {
            return Err("the methods are not those of this study".into());
        }
        let complete = |found: &[LevelRecord], wanted: &[u64]| {
            found.iter().map(|level| level.n).eq(wanted.iter().copied())
        };
        let is_complete = |row: &Row| {
            complete(&row.levels, &header.levels) && complete(&row.between, &self.between)
        };
        if !rows.iter().all(is_complete) {
            return Err("the levels are not those of this study".into());
        }
        let is_of_this_kind = |level: &LevelRecord| match header.errors {
            Errors::Split => level.state != State::Total && level.floor.is_none(),
            Errors::Total => matches!(
                level.state,
                State::Total | State::NotFinite | State::Refused(_)
            ),
        };
        let mut levels = rows
            .iter()
            .flat_map(|row| row.levels.iter().chain(&row.between));
        if !levels.all(is_of_this_kind) {
            return Err(format!(
                "the errors are not {} as in this study",
                header.errors
            ));
        }
        Ok(())
    }
}

fn same(path: &Path, found: &Header, wanted: &Header) -> Result<(), JournalError> {
    match found.difference(wanted) {
        Some((what, found, wanted)) => Err(JournalError::OtherStudy {
            path: path.display().to_string(),
            what,
            found,
            wanted,
        }),
        None => Ok(()),
    }
}

/// What a unit is called.
fn name(unit: &Unit) -> (&str, &str) {
    (&unit.case, &unit.format)
}

/// One line of JSON; records are made of text and numbers, which always have one.
fn line(value: &impl Serialize) -> String {
    let mut line = serde_json::to_string(value).unwrap_or_default();
    line.push('\n');
    line
}

fn at(path: &Path) -> impl Fn(io::Error) -> JournalError {
    let path = path.display().to_string();
    move |error| JournalError::File {
        path: path.clone(),
        error,
    }
}
