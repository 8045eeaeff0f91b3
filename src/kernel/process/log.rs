//! What a kernel and volver say to each other, kept as it comes.

use crate::kernel::KernelError;
use std::fs::File;
use std::io::{self, Write};
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};

/// A file of all that goes over a kernel's descriptors.
///
/// Every line begins with the number of the descriptor that it went over, as the kernel has it, and a blank; with `-`
/// where volver says what became of the process. What comes is written at once, without a buffer, so that nothing is
/// lost whoever is killed. A line that another one came into goes on behind the number and a `+`.
#[derive(Clone, Debug)]
pub struct Log(Arc<Mutex<Lines>>);

/// Where something comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stream {
    Volver,
    Output,
    Errors,
    Requests,
    Answers,
}

#[derive(Debug)]
struct Lines {
    file: File,
    /// Whose line the last one is, where it has no end yet.
    open: Option<Stream>,
    /// Whose lines were broken off.
    broken: Vec<Stream>,
}

impl Log {
    /// A new, empty file; one that is there is emptied.
    ///
    /// # Errors
    /// What the system says where it cannot be written.
    pub fn create(path: &Path) -> io::Result<Log> {
        Ok(Log(Arc::new(Mutex::new(Lines {
            file: File::create(path)?,
            open: None,
            broken: Vec::new(),
        }))))
    }

    /// Keeps what came.
    pub(super) fn keep(&self, stream: Stream, bytes: &[u8]) -> io::Result<()> {
        let mut lines = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let text = lines.text(stream, bytes);
        lines.file.write_all(&text).map_err(|error| {
            let problem = format!("the log cannot be written: {error}");
            io::Error::new(error.kind(), problem)
        })
    }

    /// The same, for whoever talks to a kernel.
    pub(super) fn tell(&self, stream: Stream, bytes: &[u8]) -> Result<(), KernelError> {
        self.keep(stream, bytes).map_err(|error| KernelError::Log {
            reason: error.to_string(),
        })
    }

    /// Keeps what volver says of the process.
    pub(super) fn note(&self, words: &str) -> io::Result<()> {
        self.keep(Stream::Volver, format!("{words}\n").as_bytes())
    }
}

/// Two are the same where they are one file.
impl PartialEq for Log {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for Log {}

impl Stream {
    fn mark(self) -> &'static str {
        match self {
            Stream::Volver => "-",
            Stream::Output => "1",
            Stream::Errors => "2",
            Stream::Requests => "3",
            Stream::Answers => "4",
        }
    }
}

impl Lines {
    /// What is to be written of it.
    fn text(&mut self, stream: Stream, bytes: &[u8]) -> Vec<u8> {
        let mut text = Vec::with_capacity(bytes.len() + 8);
        for line in bytes.split_inclusive(|byte| *byte == b'\n') {
            if let Some(other) = self.open.filter(|other| *other != stream) {
                text.push(b'\n');
                self.broken.push(other);
            }
            if self.open != Some(stream) {
                text.extend_from_slice(stream.mark().as_bytes());
                if self.broken.contains(&stream) {
                    self.broken.retain(|broken| *broken != stream);
                    text.push(b'+');
                }
                text.push(b' ');
            }
            text.extend_from_slice(line);
            self.open = (!line.ends_with(b"\n")).then_some(stream);
        }
        text
    }
}
