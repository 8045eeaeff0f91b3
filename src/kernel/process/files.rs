//! Arrays in files, for kernels that would rather not read them as text.

use super::registry;
use std::fs::{self, DirBuilder, File};
use std::io::{self, BufWriter, Write};
use std::os::unix::fs::DirBuilderExt;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU64, Ordering};

/// A directory of files that live as long as a request.
#[derive(Debug)]
pub(super) struct Files {
    directory: PathBuf,
    written: Vec<PathBuf>,
    count: u64,
}

impl Files {
    pub(super) fn new() -> io::Result<Self> {
        let directory = directory()?;
        registry::hold_directory(&directory);
        Ok(Files {
            directory,
            written: Vec::new(),
            count: 0,
        })
    }

    /// Writes one, and says where.
    pub(super) fn write(&mut self, values: &[f64]) -> io::Result<String> {
        self.count += 1;
        let path = self.directory.join(format!("{}.npy", self.count));
        let Some(name) = path.to_str().map(Into::into) else {
            let problem = format!("{}: no Unicode", path.display());
            return Err(io::Error::new(io::ErrorKind::InvalidFilename, problem));
        };
        let mut file = BufWriter::new(File::create_new(&path)?);
        self.written.push(path);
        npy(&mut file, values)?;
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

/// A new directory for temporary files, which nobody else can read; whoever else has its name already keeps it.
pub(super) fn directory() -> io::Result<PathBuf> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let process = std::process::id();
    // A child may change its own working directory.
    let parent = std::path::absolute(std::env::temp_dir())?;
    loop {
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let path = parent.join(format!("volver-{process}-{count}"));
        match DirBuilder::new().mode(0o700).create(&path) {
            Ok(()) => return Ok(path),
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
        }
    }
}

/// An array as `numpy.save` writes it: version 1.0 of the format, one axis of binary64, little-endian.
fn npy(file: &mut impl Write, values: &[f64]) -> io::Result<()> {
    const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
    /// The values start at a multiple of this.
    const ALIGNMENT: usize = 64;
    let count = values.len();
    let mut header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({count},), }}");
    // Two bytes of length come before it, and a line feed after it.
    let length = MAGIC.len() + 2 + header.len() + 1;
    let padding = length.next_multiple_of(ALIGNMENT) - length;
    header.extend(std::iter::repeat_n(' ', padding));
    header.push('\n');
    let length = u16::try_from(header.len()).map_err(io::Error::other)?;
    file.write_all(MAGIC)?;
    file.write_all(&length.to_le_bytes())?;
    file.write_all(header.as_bytes())?;
    for value in values {
        file.write_all(&value.to_le_bytes())?;
    }
    Ok(())
}

impl Drop for Files {
    fn drop(&mut self) {
        // What cannot be removed is in the way of nobody.
        let _ = fs::remove_dir_all(&self.directory);
        registry::forget_directory(&self.directory);
    }
}
