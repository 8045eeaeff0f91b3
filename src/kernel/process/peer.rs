//! Who is talked to: a child of this process, or the one that started it.

use super::caller::Descriptors;
use super::child::Child;
use super::log::{Log, Stream};
use super::pipes::Pipes;
use super::trouble::Trouble;
use crate::kernel::KernelError;
use std::time::{Duration, Instant};

/// Where the other side comes from.
#[derive(Clone, Debug)]
pub(super) enum Origin {
    Program {
        program: String,
        arguments: Vec<String>,
    },
    Caller(Descriptors),
}

/// The other side.
#[derive(Debug)]
pub(super) enum Peer {
    Child(Box<Child>),
    Caller(Pipes),
}

impl Origin {
    /// The other side, to which nothing was said.
    pub(super) fn peer(&self, log: Option<&Log>) -> Result<Peer, KernelError> {
        match self {
            Origin::Caller(descriptors) => {
                let pipes = descriptors.pipes(log.cloned())?;
                if let Some(log) = log {
                    log.tell(Stream::Volver, b"the process that started this one\n")?;
                }
                Ok(Peer::Caller(pipes))
            }
            Origin::Program { program, arguments } => {
                let child = Child::start(program, arguments, log);
                let child = child.map_err(|error| KernelError::Start {
                    program: program.clone(),
                    reason: error.to_string(),
                })?;
                if let Some(log) = log {
                    let words = arguments.iter().map(String::as_str);
                    let words: Vec<&str> = std::iter::once(program.as_str()).chain(words).collect();
                    let command = words.join(" ");
                    let note = format!("process {}: {}\n", child.id(), command.escape_debug());
                    log.tell(Stream::Volver, note.as_bytes())?;
                }
                Ok(Peer::Child(Box::new(child)))
            }
        }
    }

    /// Whether what failed can be had anew.
    pub(super) fn starts_anew(&self) -> bool {
        matches!(self, Origin::Program { .. })
    }
}

impl Peer {
    pub(super) fn exchange(
        &mut self,
        message: &[u8],
        deadline: Option<Instant>,
    ) -> Result<Vec<u8>, Trouble> {
        self.pipes().exchange(message, deadline)
    }

    pub(super) fn exchange_frame<H>(
        &mut self,
        message: &[u8],
        deadline: Option<Instant>,
        read: impl FnOnce(&[u8]) -> Result<(H, usize), Trouble>,
    ) -> Result<(H, Vec<u8>), Trouble> {
        self.pipes().exchange_frame(message, deadline, read)
    }

    fn pipes(&mut self) -> &mut Pipes {
        match self {
            Peer::Child(child) => child.pipes(),
            Peer::Caller(pipes) => pipes,
        }
    }

    /// The child, if it is one.
    pub(super) fn child(&self) -> Option<&Child> {
        match self {
            Peer::Child(child) => Some(child),
            Peer::Caller(_) => None,
        }
    }

    /// Has done with it for its trouble, which was met while `what` was waited for; a child is ended.
    pub(super) fn fail(self, trouble: Trouble, what: &'static str, after: Duration) -> KernelError {
        match self {
            Peer::Child(child) => child.fail(trouble, what, after),
            Peer::Caller(_) => trouble.said(what, after, None, String::new()),
        }
    }
}
