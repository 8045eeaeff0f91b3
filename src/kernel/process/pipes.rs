//! One message there, one line back, within a time.
//!
//! Both pipes are read and written without blocking, by the thread that asks: a child that does not read cannot
//! hold it up, and between requests nothing of what a child says is read, so that no child can fill the memory.

use super::log::{Log, Stream};
use super::trouble::Trouble;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::io::{Errno, ioctl_fionbio};
use std::io::{self, ErrorKind, PipeReader, PipeWriter, Read, Write};
use std::time::Instant;

/// The longest line a child may write, in bytes.
pub(super) const MAX_LINE: usize = 1 << 20;
/// How much is read at once.
const CHUNK: usize = 1 << 14;

/// This side's ends of a child's pipes.
#[derive(Debug)]
pub(super) struct Pipes {
    requests: Option<PipeWriter>,
    answers: PipeReader,
    /// Read, but not yet taken.
    buffer: Vec<u8>,
    /// So much of the buffer has no end of a line.
    searched: usize,
    log: Option<Log>,
}

impl Pipes {
    pub(super) fn new(
        requests: PipeWriter,
        answers: PipeReader,
        log: Option<Log>,
    ) -> io::Result<Self> {
        ioctl_fionbio(&requests, true)?;
        ioctl_fionbio(&answers, true)?;
        Ok(Pipes {
            requests: Some(requests),
            answers,
            buffer: Vec::new(),
            searched: 0,
            log,
        })
    }

    /// Tells the child that no more requests come.
    pub(super) fn close_requests(&mut self) {
        self.requests = None;
    }

    /// Writes the message, and returns the next line without its end; waits for ever where there is no deadline.
    pub(super) fn exchange(
        &mut self,
        message: &[u8],
        deadline: Option<Instant>,
    ) -> Result<Vec<u8>, Trouble> {
        let mut unwritten = message;
        loop {
            unwritten = self.write(unwritten)?;
            if let Some(line) = self.line()? {
                if !unwritten.is_empty() {
                    return Err(Trouble::garbage(
                        "a line before the request was read",
                        &line,
                    ));
                }
                return Ok(line);
            }
            if !self.read()? {
                self.wait(!unwritten.is_empty(), deadline)?;
            }
        }
    }

    /// As much as fits into the pipe; returns the rest.
    fn write<'m>(&mut self, mut message: &'m [u8]) -> Result<&'m [u8], Trouble> {
        let requests = self.requests.as_mut().ok_or(Trouble::Closed("request"))?;
        while !message.is_empty() {
            match requests.write(message) {
                Ok(count) => message = message.get(count..).unwrap_or_default(),
                Err(error) => match error.kind() {
                    ErrorKind::Interrupted => {}
                    ErrorKind::WouldBlock => break,
                    ErrorKind::BrokenPipe => return Err(Trouble::Closed("request")),
                    _ => return Err(Trouble::System(error)),
                },
            }
        }
        Ok(message)
    }

    /// Whether there was something to read.
    fn read(&mut self) -> Result<bool, Trouble> {
        let mut chunk = [0; CHUNK];
        loop {
            match self.answers.read(&mut chunk) {
                Ok(0) if self.buffer.is_empty() => return Err(Trouble::Closed("answer")),
                Ok(0) => return Err(Trouble::garbage("half a line", &self.buffer)),
                Ok(count) => {
                    let read = chunk.get(..count).unwrap_or_default();
                    if let Some(log) = &self.log {
                        log.keep(Stream::Answers, read).map_err(Trouble::System)?;
                    }
                    self.buffer.extend_from_slice(read);
                    return Ok(true);
                }
                Err(error) => match error.kind() {
                    ErrorKind::Interrupted => {}
                    ErrorKind::WouldBlock => return Ok(false),
                    _ => return Err(Trouble::System(error)),
                },
            }
        }
    }

    /// The first line of the buffer, if it has one.
    fn line(&mut self) -> Result<Option<Vec<u8>>, Trouble> {
        let unsearched = self.buffer.get(self.searched..).unwrap_or_default();
        let Some(end) = unsearched.iter().position(|byte| *byte == b'\n') else {
            self.searched = self.buffer.len();
            return self.bounded(self.searched).map(|()| None);
        };
        let end = self.searched + end;
        self.bounded(end)?;
        let rest = self.buffer.split_off(end + 1);
        let mut line = std::mem::replace(&mut self.buffer, rest);
        line.truncate(end);
        self.searched = 0;
        Ok(Some(line))
    }

    fn bounded(&self, length: usize) -> Result<(), Trouble> {
        if length > MAX_LINE {
            let problem = format!("a line too long (allowed: up to {MAX_LINE} bytes)");
            return Err(Trouble::garbage(problem, &self.buffer));
        }
        Ok(())
    }

    /// Until the child has written, or has read if there is something left to write.
    fn wait(&self, writing: bool, deadline: Option<Instant>) -> Result<(), Trouble> {
        let left = deadline.map(|deadline| deadline.saturating_duration_since(Instant::now()));
        if left.is_some_and(|left| left.is_zero()) {
            return Err(Trouble::TimedOut);
        }
        let mut ends = vec![PollFd::new(&self.answers, PollFlags::IN)];
        if let Some(requests) = self.requests.as_ref().filter(|_| writing) {
            ends.push(PollFd::new(requests, PollFlags::OUT));
        }
        // What is too long for the system to count is as good as no bound.
        let left = left.and_then(|left| Timespec::try_from(left).ok());
        match poll(&mut ends, left.as_ref()) {
            Ok(_) | Err(Errno::INTR) => Ok(()),
            Err(error) => Err(Trouble::System(error.into())),
        }
    }
}
