//! One shard while it runs.

use super::division::{Divisible, Division, DivisionError};
use super::gathered::Gathered;
use super::head::{Head, PART, WHOLE, head_of};
use super::key::Key;
use super::line::sealed;
use super::{FileError, temporary};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// A finished unit, with the seconds that it was foreseen to take and that it took.
#[derive(Serialize)]
struct Finished<'a, U> {
    key: Key,
    foreseen: f64,
    took: f64,
    unit: &'a U,
}

/// A shard's units, kept as they come: in a file with a name of its own until all are there.
#[derive(Debug)]
pub struct Shard {
    /// What the file is called when it is whole.
    whole: PathBuf,
    folder: PathBuf,
    head: Head,
    /// `None` where it was whole before.
    part: Option<(File, PathBuf)>,
    /// The units that are still to be done, with their costs foreseen.
    left: BTreeMap<Key, f64>,
    units: usize,
}

impl Shard {
    /// Begins a shard, counted from 1, or goes on where others left it: what they finished is taken over.
    ///
    /// # Errors
    /// [`DivisionError`] where there is no such shard, or files cannot be read or written.
    pub fn begin<W: Divisible>(
        directory: &Path,
        division: &Division<W>,
        shard: usize,
    ) -> Result<Shard, DivisionError> {
        let range = division.units(shard)?;
        let folder = Division::<W>::folder(directory);
        fs::create_dir_all(&folder).map_err(FileError::at(&folder))?;
        let head = Head::new(division, shard);
        let stem = head.stem();
        let keys = division.work.keys();
        let of_shard = range.clone().filter_map(|unit| keys.get(unit).copied());
        let costs = division.costs.iter().skip(range.start).copied();
        let mut left: BTreeMap<Key, f64> = of_shard.zip(costs).collect();
        let units = left.len();
        let found = Gathered::of_shard(directory, division, shard)?;
        let whole = folder.join(format!("{stem}{WHOLE}"));
        let is_whole = |file: &Path| file == whole.as_path();
        if left
            .keys()
            .all(|key| found.file(*key).is_some_and(is_whole))
        {
            left.clear();
            return Ok(Shard {
                whole,
                folder,
                head,
                part: None,
                left,
                units,
            });
        }
        let part = temporary()
            .prefix(&format!("{stem}."))
            .suffix(PART)
            .tempfile_in(&folder)
            .and_then(|file: NamedTempFile| file.keep().map_err(|error| error.error));
        let (mut file, path) = part.map_err(FileError::at(&folder))?;
        let at = FileError::at(&path);
        let mut text = sealed(&head);
        let mut taken = BTreeSet::new();
        for key in left.keys() {
            if let Some(line) = found.line(*key) {
                text += &line?;
                taken.insert(*key);
            }
        }
        let written = file.write_all(text.as_bytes());
        written.and_then(|()| file.sync_data()).map_err(&at)?;
        left.retain(|key, _| !taken.contains(key));
        Ok(Shard {
            whole,
            folder,
            head,
            part: Some((file, path)),
            left,
            units,
        })
    }

    /// Whether that unit is one of the shard's that is still to be done.
    #[must_use]
    pub fn wants(&self, key: Key) -> bool {
        self.left.contains_key(&key)
    }

    /// How many units it has.
    #[must_use]
    pub fn units(&self) -> usize {
        self.units
    }

    /// How many are still to be done.
    #[must_use]
    pub fn left(&self) -> usize {
        self.left.len()
    }

    /// Keeps a finished unit, which took so many seconds. One that is not wanted is not kept.
    ///
    /// # Errors
    /// [`FileError`] where it cannot be written.
    pub fn append(&mut self, key: Key, took: f64, unit: &impl Serialize) -> Result<(), FileError> {
        let (Some((file, path)), Some(foreseen)) = (&mut self.part, self.left.get(&key).copied())
        else {
            return Ok(());
        };
        let line = sealed(&Finished {
            key,
            foreseen,
            took,
            unit,
        });
        let written = file.write_all(line.as_bytes());
        written
            .and_then(|()| file.sync_data())
            .map_err(FileError::at(path))?;
        self.left.remove(&key);
        Ok(())
    }

    /// Gives the file its name, where all units are there, and clears away what unfinished runs of the shard left. The file.
    ///
    /// # Errors
    /// [`FileError`] where it cannot be named.
    pub fn finish(self) -> Result<PathBuf, FileError> {
        let Some((file, path)) = self.part.filter(|_| self.left.is_empty()) else {
            return Ok(self.whole);
        };
        let at = FileError::at(&self.whole);
        file.sync_all().map_err(&at)?;
        match fs::rename(&path, &self.whole) {
            Ok(()) => {}
            // Another run of the shard was done first, with the same units, and cleared this one's away.
            Err(_) if self.whole.exists() && !path.exists() => {}
            Err(error) => return Err(at(error)),
        }
        // The name is on the disk when the folder is; not every file system lets a folder be synchronised.
        if let Ok(folder) = File::open(&self.folder) {
            let _ = folder.sync_all();
        }
        for entry in fs::read_dir(&self.folder).map_err(&at)?.flatten() {
            let name = entry.file_name();
            let name = name.to_string_lossy();
            let rest = name.strip_prefix(&self.head.stem());
            let is_part = rest.is_some_and(|rest| rest.starts_with('.') && rest.ends_with(PART));
            // What is in it counts, not what it is called.
            let is_ours = || head_of(&entry.path()).is_none_or(|head| head == self.head);
            if is_part && is_ours() {
                // Whoever writes there still has the same units to write.
                let _ = fs::remove_file(entry.path());
            }
        }
        Ok(self.whole)
    }
}
