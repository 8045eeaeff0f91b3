//! Bytes of a file from a place on.

use super::{Trouble, refused};
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

/// A file, and how long it is.
pub(crate) struct Bytes {
    file: BufReader<File>,
    length: u64,
    at: u64,
}

/// Opens a file whose length is known: pipes and devices are none.
pub(crate) fn open(path: &Path) -> Result<Bytes, Trouble> {
    let file = File::open(path)?;
    let about = file.metadata()?;
    if !about.is_file() {
        return Err(refused(
            "no file: its length cannot be known before it is read",
            "a file on a disk",
        ));
    }
    Ok(Bytes {
        length: about.len(),
        file: BufReader::with_capacity(1 << 16, file),
        at: 0,
    })
}

impl Bytes {
    /// Where the next byte is.
    pub(crate) fn at(&self) -> u64 {
        self.at
    }

    /// How many are left.
    pub(crate) fn left(&self) -> u64 {
        self.length.saturating_sub(self.at)
    }

    /// The next byte is that of this place.
    pub(crate) fn go_to(&mut self, place: u64) -> Result<(), Trouble> {
        self.file.seek(SeekFrom::Start(place))?;
        self.at = place;
        Ok(())
    }

    /// The bytes up to the end of the next line, without that; `None` at the end of the file.
    ///
    /// # Errors
    /// [`Trouble::Refused`] of a line of more than `most` bytes: such a file has no header.
    pub(crate) fn line(&mut self, most: usize) -> Result<Option<String>, Trouble> {
        let mut line = Vec::new();
        let mut byte = [0];
        loop {
            if self.read(&mut byte)? == 0 {
                if line.is_empty() {
                    return Ok(None);
                }
                break;
            }
            if byte == *b"\n" {
                break;
            }
            line.push(byte[0]);
            if line.len() > most {
                return Err(refused(
                    format!("a line of more than {most} bytes in its header"),
                    "a header of short lines",
                ));
            }
        }
        if line.ends_with(b"\r") {
            line.pop();
        }
        String::from_utf8(line).map(Some).map_err(|_| {
            refused(
                "a header that is no text in UTF-8",
                "a header of lines of text",
            )
        })
    }

    /// Whether as many bytes are left as are needed, no more and no less.
    pub(crate) fn exactly(&self, need: u64) -> Result<(), Trouble> {
        let have = self.left();
        if have == need {
            return Ok(());
        }
        Err(Trouble::Size { have, need })
    }

    /// Whether as many are left as are needed.
    pub(crate) fn at_least(&self, need: u64) -> Result<(), Trouble> {
        let have = self.left();
        if have >= need {
            return Ok(());
        }
        Err(Trouble::Size { have, need })
    }
}

impl Read for Bytes {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.file.read(buffer)?;
        self.at += read as u64;
        Ok(read)
    }
}
