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
    /// What goes to the log as it comes.
    kept: Kept,
    log: Option<Log>,
}

/// What of an answer is text, and goes to the log as it comes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kept {
    All,
    /// Up to the end of the line.
    Line,
    Nothing,
}

/// What comes of reading.
enum Came {
    Bytes,
    NotYet,
    End,
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
            kept: Kept::All,
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
            match self.read()? {
                Came::Bytes => {}
                Came::NotYet => self.wait(!unwritten.is_empty(), deadline)?,
                Came::End if self.buffer.is_empty() => return Err(Trouble::Closed("answer")),
                Came::End => return Err(Trouble::garbage("half a line", &self.buffer)),
            }
        }
    }

    /// The same of an answer that has bytes behind its line: `read` makes what it is of the line, and says how many.
    pub(super) fn exchange_frame<H>(
        &mut self,
        message: &[u8],
        deadline: Option<Instant>,
        read: impl FnOnce(&[u8]) -> Result<(H, usize), Trouble>,
    ) -> Result<(H, Vec<u8>), Trouble> {
        self.kept = Kept::Line;
        let line = self.exchange(message, deadline)?;
        let (head, count) = read(&line)?;
        while self.buffer.len() < count {
            match self.read()? {
                Came::Bytes => {}
                Came::NotYet => self
                    .wait(false, deadline)
                    .map_err(|trouble| match trouble {
                        Trouble::TimedOut => Trouble::HalfFrame,
                        other => other,
                    })?,
                Came::End => {
                    let got = self.buffer.len();
                    let problem = format!("a frame cut short, {got} of {count} bytes,");
                    return Err(Trouble::garbage(problem, &line));
                }
            }
        }
        let rest = self.buffer.split_off(count);
        let bytes = std::mem::replace(&mut self.buffer, rest);
        self.kept = Kept::All;
        // What is too much is seen when the next line is read, and kept for whoever looks for it.
        if let Some(log) = self.log.as_ref().filter(|_| !self.buffer.is_empty()) {
            let kept = log.keep(Stream::Answers, &self.buffer);
            kept.map_err(Trouble::System)?;
        }
        Ok((head, bytes))
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

    /// As much as there is, up to a chunk.
    fn read(&mut self) -> Result<Came, Trouble> {
        let mut chunk = [0; CHUNK];
        loop {
            match self.answers.read(&mut chunk) {
                Ok(0) => return Ok(Came::End),
                Ok(count) => {
                    let read = chunk.get(..count).unwrap_or_default();
                    self.keep(read).map_err(Trouble::System)?;
                    self.buffer.extend_from_slice(read);
                    return Ok(Came::Bytes);
                }
                Err(error) => match error.kind() {
                    ErrorKind::Interrupted => {}
                    ErrorKind::WouldBlock => return Ok(Came::NotYet),
                    _ => return Err(Trouble::System(error)),
                },
            }
        }
    }

    /// Logs what was read, as far as it is text.
    fn keep(&mut self, read: &[u8]) -> io::Result<()> {
        let Some(log) = &self.log else {
            return Ok(());
        };
        let text = match self.kept {
            Kept::All => read,
            Kept::Nothing => return Ok(()),
            Kept::Line => match read.iter().position(|byte| *byte == b'\n') {
                None => read,
                Some(end) => {
                    self.kept = Kept::Nothing;
                    read.get(..=end).unwrap_or(read)
                }
            },
        };
        log.keep(Stream::Answers, text)
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
