//! Arrays in files, for kernels that would rather not read them as text.

use super::registry;
use npyz::{DType, WriterBuilder};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::PathBuf;
use tempfile::TempDir;

/// A directory of files that live as long as a request.
#[derive(Debug)]
pub(super) struct Files {
    directory: TempDir,
    written: Vec<PathBuf>,
    count: u64,
}

impl Files {
    pub(super) fn new() -> io::Result<Self> {
        let directory = tempfile::Builder::new().prefix("volver-").tempdir()?;
        registry::hold_directory(directory.path());
        Ok(Files {
            directory,
            written: Vec::new(),
            count: 0,
        })
    }

    /// Writes one, and says where.
    pub(super) fn write(&mut self, values: &[f64]) -> io::Result<String> {
        self.count += 1;
        let path = self.directory.path().join(format!("{}.npy", self.count));
        let Some(name) = path.to_str().map(Into::into) else {
            let problem = format!("{}: no Unicode", path.display());
            return Err(io::Error::new(io::ErrorKind::InvalidFilename, problem));
        };
        let mut file = BufWriter::new(File::create_new(&path)?);
        self.written.push(path);
        let little_endian = "<f8".parse().map_err(io::Error::other)?;
        let mut writer = npyz::WriteOptions::new()
            .dtype(DType::Plain(little_endian))
            .shape(&[values.len() as u64])
            .writer(&mut file)
            .begin_nd()?;
        writer.extend(values)?;
        writer.finish()?;
        file.flush()?;
        Ok(name)
    }

    /// Removes those of the last request.
    pub(super) fn clear(&mut self) {
        for path in self.written.drain(..) {
            // What cannot be removed now goes with the directory.
            let _ = fs::remove_file(path);
        }
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        registry::forget_directory(self.directory.path());
    }
}
