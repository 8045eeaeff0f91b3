//! What shards have finished so far, whichever file has it.

use super::FileError;
use super::division::{Divisible, Division, DivisionError};
use super::head::{Head, PART, WHOLE};
use super::key::Key;
use super::line::{next, opened};
use serde::Deserialize;
use serde_json::value::RawValue;
use std::collections::HashMap;
use std::fs::{self, File};
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// Finished units of a division: where each stands, once.
#[derive(Debug)]
pub struct Gathered {
    files: Vec<PathBuf>,
    places: HashMap<Key, Place>,
    /// What is wrong with files.
    pub troubles: Vec<Trouble>,
    /// The files, whole ones first.
    pub parts: Vec<Part>,
}

/// Where a unit stands.
#[derive(Clone, Copy, Debug)]
struct Place {
    file: usize,
    offset: u64,
    length: u64,
    /// Of the unit alone, without what it took.
    result: Key,
    foreseen: f64,
    took: f64,
}

/// What is wrong with a file; its other lines count.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Trouble {
    /// A line is not as it was written.
    #[error("{path}, line {line}: not as it was written")]
    Corrupt {
        /// The file.
        path: String,
        /// Which line, from 1.
        line: usize,
    },
    /// A unit came out otherwise in two runs.
    #[error("{unit} came out differently in {first} and {second}")]
    Differs {
        /// The unit's name.
        unit: String,
        /// A file.
        first: String,
        /// Another one.
        second: String,
    },
}

/// A file of a shard.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// The shard, counted from 1.
    pub shard: usize,
    /// Whether it is whole, and has its name.
    pub is_whole: bool,
    /// Units in it.
    pub units: usize,
    /// Bytes of it.
    pub bytes: u64,
}

/// A finished unit as its line has it.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Finished<'a> {
    key: Key,
    foreseen: f64,
    took: f64,
    #[serde(borrow)]
    unit: &'a RawValue,
}

impl Gathered {
    /// All that is there of a division.
    ///
    /// # Errors
    /// [`DivisionError`] where files cannot be read, or belong to another division.
    pub fn new<W: Divisible>(
        directory: &Path,
        division: &Division<W>,
    ) -> Result<Gathered, DivisionError> {
        Self::of(directory, division, None)
    }

    /// What is there of one shard.
    pub(super) fn of_shard<W: Divisible>(
        directory: &Path,
        division: &Division<W>,
        shard: usize,
    ) -> Result<Gathered, DivisionError> {
        Self::of(directory, division, Some(shard))
    }

    fn of<W: Divisible>(
        directory: &Path,
        division: &Division<W>,
        only: Option<usize>,
    ) -> Result<Gathered, DivisionError> {
        let keys = division.work.keys();
        let units: HashMap<Key, usize> = keys.iter().copied().zip(0..).collect();
        let mut gathered = Gathered {
            files: Vec::new(),
            places: HashMap::new(),
            troubles: Vec::new(),
            parts: Vec::new(),
        };
        let digest = division.digest();
        for (path, is_whole) in files(&Division::<W>::folder(directory))? {
            gathered.take(path, is_whole, division, digest, &units, only)?;
        }
        Ok(gathered)
    }

    /// Reads a file.
    fn take<W: Divisible>(
        &mut self,
        path: PathBuf,
        is_whole: bool,
        division: &Division<W>,
        digest: Key,
        units: &HashMap<Key, usize>,
        only: Option<usize>,
    ) -> Result<(), DivisionError> {
        let at = FileError::at(&path);
        let shown = path.display().to_string();
        let file = match File::open(&path) {
            Ok(file) => file,
            // The run that wrote it is done meanwhile, and another file has its units.
            Err(error) if !is_whole && error.kind() == io::ErrorKind::NotFound => return Ok(()),
            Err(error) => return Err(at(error).into()),
        };
        let mut reader = BufReader::new(file);
        let first = next(&mut reader).map_err(&at)?;
        let Some(head) = opened(&first).and_then(|text| serde_json::from_str::<Head>(&text).ok())
        else {
            // A run that was killed as it began leaves nothing to see; a file that has its name was whole once.
            if is_whole {
                self.troubles.push(Trouble::Corrupt {
                    path: shown,
                    line: 1,
                });
            }
            return Ok(());
        };
        if head.division != digest || head.volver != division.volver {
            return Err(DivisionError::Other {
                path: shown,
                kind: W::KIND,
                what: "shards",
                found: format!("those of division {}", head.division),
                wanted: format!("those of {digest}"),
            });
        }
        if only.is_some_and(|only| only != head.shard) {
            return Ok(());
        }
        let index = self.files.len();
        let mut offset = first.len() as u64;
        let mut count = 0;
        for line in 2.. {
            let bytes = next(&mut reader).map_err(&at)?;
            if bytes.is_empty() {
                break;
            }
            let (begin, length) = (offset, bytes.len() as u64);
            offset += length;
            let text = opened(&bytes);
            let finished = text.as_deref().and_then(|text| read(text, units));
            let Some((unit, key, place)) = finished else {
                // A last line without its end is one that was not finished.
                if bytes.ends_with(b"\n") || is_whole {
                    self.troubles.push(Trouble::Corrupt {
                        path: shown.clone(),
                        line,
                    });
                }
                continue;
            };
            count += 1;
            match self.places.get(&key) {
                None => {
                    let place = Place {
                        file: index,
                        offset: begin,
                        length,
                        ..place
                    };
                    self.places.insert(key, place);
                }
                Some(known) if known.result == place.result => {}
                Some(known) => self.troubles.push(Trouble::Differs {
                    unit: division.work.name(unit),
                    first: self.shown(known.file),
                    second: shown.clone(),
                }),
            }
        }
        self.parts.push(Part {
            shard: head.shard,
            is_whole,
            units: count,
            bytes: offset,
        });
        self.files.push(path);
        Ok(())
    }

    fn shown(&self, file: usize) -> String {
        let path = self.files.get(file);
        path.map_or_else(String::new, |path| path.display().to_string())
    }

    /// Whether a unit is there.
    #[must_use]
    pub fn has(&self, key: Key) -> bool {
        self.places.contains_key(&key)
    }

    /// How many units are there.
    #[must_use]
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether none is.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// Seconds that a unit was foreseen to take and took.
    #[must_use]
    pub fn seconds(&self, key: Key) -> Option<(f64, f64)> {
        let place = self.places.get(&key)?;
        Some((place.foreseen, place.took))
    }

    /// The file in which a unit stands.
    pub(super) fn file(&self, key: Key) -> Option<&Path> {
        let place = self.places.get(&key)?;
        self.files.get(place.file).map(PathBuf::as_path)
    }

    /// A unit's line as it stands there.
    pub(super) fn line(&self, key: Key) -> Option<Result<String, FileError>> {
        let place = self.places.get(&key)?;
        let path = self.files.get(place.file)?;
        Some(line_at(path, place).map_err(FileError::at(path)))
    }

    /// A unit, as JSON; `None` where it is not there.
    ///
    /// # Errors
    /// [`FileError`] where its file cannot be read any more, or is another one now.
    #[must_use]
    pub fn unit(&self, key: Key) -> Option<Result<String, FileError>> {
        let line = match self.line(key)? {
            Ok(line) => line,
            Err(error) => return Some(Err(error)),
        };
        let path = self.file(key)?;
        let text = opened(line.as_bytes());
        let unit = text.as_deref().and_then(|text| {
            let finished: Finished<'_> = serde_json::from_str(text).ok()?;
            (finished.key == key).then(|| finished.unit.get().to_string())
        });
        let changed = || io::Error::other("it was changed while it was read");
        Some(unit.ok_or_else(|| FileError::at(path)(changed())))
    }
}

/// The unit's number, its key, and what its line says.
fn read(text: &str, units: &HashMap<Key, usize>) -> Option<(usize, Key, Place)> {
    let finished: Finished<'_> = serde_json::from_str(text).ok()?;
    let unit = *units.get(&finished.key)?;
    let place = Place {
        file: 0,
        offset: 0,
        length: 0,
        result: Key::of([finished.unit.get()]),
        foreseen: finished.foreseen,
        took: finished.took,
    };
    Some((unit, finished.key, place))
}

fn line_at(path: &Path, place: &Place) -> io::Result<String> {
    let mut file = File::open(path)?;
    file.seek(SeekFrom::Start(place.offset))?;
    let mut line = String::new();
    file.take(place.length).read_to_string(&mut line)?;
    Ok(line)
}

/// The files of shards, whole ones first, each kind by name: which of two equal units is taken is the same everywhere.
fn files(folder: &Path) -> Result<Vec<(PathBuf, bool)>, FileError> {
    let entries = match fs::read_dir(folder) {
        Ok(entries) => entries,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(error) => return Err(FileError::at(folder)(error)),
    };
    let mut files = Vec::new();
    for entry in entries {
        let path = entry.map_err(FileError::at(folder))?.path();
        let name = path.file_name().map(|name| name.to_string_lossy());
        let ends = |end: &str| name.as_ref().is_some_and(|name| name.ends_with(end));
        let (is_whole, is_part) = (ends(WHOLE), ends(PART));
        if is_whole || is_part {
            files.push((path, is_whole));
        }
    }
    files.sort_by(|(a, a_whole), (b, b_whole)| b_whole.cmp(a_whole).then_with(|| a.cmp(b)));
    Ok(files)
}
