//! The process that started this one and is the kernel itself, by two descriptors that it hands down.

use super::log::Log;
use super::pipes::Pipes;
use crate::kernel::KernelError;
use rustix::fs::{FileType, Mode, OFlags, fstat, open};
use rustix::io::Errno;
use std::io::{PipeReader, PipeWriter};
use std::num::ParseIntError;
use std::os::fd::OwnedFd;
use std::str::FromStr;

/// Descriptors below are those of standard input, output and error.
const FIRST: u16 = 3;

/// The descriptors of pipes to a kernel that started this process, as this process has them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Descriptors {
    /// What answers are read from.
    pub read: u16,
    /// What requests are written to.
    pub write: u16,
}

/// What names no descriptors.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "no descriptors (allowed: fd:READ,WRITE, two different numbers from {FIRST} to {})",
    u16::MAX
)]
pub struct DescriptorsError;

impl FromStr for Descriptors {
    type Err = DescriptorsError;

    /// `READ,WRITE`.
    fn from_str(text: &str) -> Result<Self, DescriptorsError> {
        let (read, write) = text.split_once(',').ok_or(DescriptorsError)?;
        let number = |text: &str| text.parse().map_err(|_: ParseIntError| DescriptorsError);
        let (read, write) = (number(read)?, number(write)?);
        if read == write || read < FIRST || write < FIRST {
            return Err(DescriptorsError);
        }
        Ok(Descriptors { read, write })
    }
}

impl Descriptors {
    /// The pipes themselves. What is opened anew need not be taken over from nowhere, which would be unsafe; and whether
    /// it blocks is this side's own.
    pub(super) fn pipes(self, log: Option<Log>) -> Result<Pipes, KernelError> {
        let answers = PipeReader::from(opened(self.read, OFlags::RDONLY)?);
        let requests = PipeWriter::from(opened(self.write, OFlags::WRONLY)?);
        let pipes = Pipes::new(requests, answers, log);
        pipes.map_err(|error| KernelError::Descriptor {
            descriptor: self.write,
            problem: error.to_string(),
        })
    }
}

fn opened(descriptor: u16, access: OFlags) -> Result<OwnedFd, KernelError> {
    let failed = |problem: String| KernelError::Descriptor {
        descriptor,
        problem,
    };
    // To write to a pipe that nobody reads would wait for a reader.
    let flags = access | OFlags::CLOEXEC | OFlags::NONBLOCK;
    let path = format!("/dev/fd/{descriptor}");
    let file = open(path, flags, Mode::empty()).map_err(|error| match error {
        Errno::NOENT | Errno::BADF => failed("it is not open".into()),
        Errno::NXIO => failed("nobody is at its other end".into()),
        other => failed(other.to_string()),
    })?;
    let kind = fstat(&file).map(|status| FileType::from_raw_mode(status.st_mode));
    match kind {
        Ok(FileType::Fifo) => Ok(file),
        Ok(_) => Err(failed("it is no pipe".into())),
        Err(error) => Err(failed(error.to_string())),
    }
}
