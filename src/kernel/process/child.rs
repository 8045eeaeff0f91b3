//! A child process: its start, its pipes, its end.

use super::ending::{TERMINATION, ends_within};
use super::log::{Log, Stream};
use super::pipes::Pipes;
use super::registry;
use super::tail::Tail;
use super::trouble::Trouble;
use crate::kernel::KernelError;
use command_fds::{CommandFdExt, FdMapping};
use rustix::process::{Pid, Signal, kill_process_group};
use std::fs::File;
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Command, ExitStatus, Stdio};
use std::time::Duration;

/// The child's descriptor that it reads requests from.
const REQUESTS: i32 = 3;
/// The child's descriptor that it writes answers to.
const ANSWERS: i32 = 4;
/// How many of its last lines are shown.
const LAST_LINES: usize = 3;
/// How long a child that closed a pipe is waited for, to see whether it was about to end, and how.
const ENDING: Duration = Duration::from_millis(500);
/// How long it may take to end by itself when no more requests come.
const FAREWELL: Duration = Duration::from_secs(2);
/// The same of one that is of no use any more.
const DISMISSAL: Duration = Duration::from_millis(200);

/// A child that leads a process group. However it is left, nothing of the group lives on.
#[derive(Debug)]
pub(super) struct Child {
    process: std::process::Child,
    group: Pid,
    pipes: Pipes,
    output: Tail,
    errors: Tail,
    log: Option<Log>,
    reaped: bool,
}

impl Child {
    pub(super) fn start(
        program: &str,
        arguments: &[String],
        log: Option<&Log>,
    ) -> io::Result<Child> {
        let (requests, ours) = io::pipe()?;
        let (answers, theirs) = io::pipe()?;
        let pipes = Pipes::new(ours, answers, log.cloned())?;
        let mut command = Command::new(program);
        command
            .args(arguments)
            .env("VOLVER_PROTOCOL", super::VERSION.to_string())
            .env("VOLVER_REQUESTS", REQUESTS.to_string())
            .env("VOLVER_ANSWERS", ANSWERS.to_string())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .process_group(0);
        let mapping = |parent_fd, child_fd| FdMapping {
            parent_fd,
            child_fd,
        };
        let mappings = vec![
            mapping(requests.into(), REQUESTS),
            mapping(theirs.into(), ANSWERS),
        ];
        command.fd_mappings(mappings).map_err(io::Error::other)?;
        let (mut process, group) = registry::spawn(&mut command)?;
        // It holds this side's copies of the child's ends: as long as they are open, no end is ever seen.
        drop(command);
        let tail = |source| tail(source, log);
        let output = process.stdout.take();
        let output = tail(output.map(|pipe| (pipe.into(), Stream::Output)));
        let tails = output.and_then(|output| {
            let errors = process.stderr.take();
            let errors = tail(errors.map(|pipe| (pipe.into(), Stream::Errors)))?;
            Ok((output, errors))
        });
        match tails {
            Ok((output, errors)) => Ok(Child {
                process,
                group,
                pipes,
                output,
                errors,
                log: log.cloned(),
                reaped: false,
            }),
            Err(error) => {
                reap(&mut process, group);
                Err(error)
            }
        }
    }

    /// Its process, which is also its group.
    pub(super) fn id(&self) -> u32 {
        self.process.id()
    }

    /// The end of what it printed.
    pub(super) fn output(&self) -> String {
        self.output.text()
    }

    pub(super) fn pipes(&mut self) -> &mut Pipes {
        &mut self.pipes
    }

    /// Ends it for its trouble, which was met while `what` was waited for, and says what befell it.
    pub(super) fn fail(
        mut self,
        trouble: Trouble,
        what: &'static str,
        after: Duration,
    ) -> KernelError {
        let ended = matches!(trouble, Trouble::Closed(_)) && ends_within(self.group, ENDING);
        let status = self.end(DISMISSAL);
        let stderr = self.errors.last_lines(LAST_LINES);
        trouble.said(what, after, status.filter(|_| ended).map(how), stderr)
    }

    /// Tells it that no more comes, then to end, and kills what is left of its group.
    fn end(&mut self, patience: Duration) -> Option<ExitStatus> {
        self.reaped = true;
        self.pipes.close_requests();
        if !ends_within(self.group, patience) {
            let _ = kill_process_group(self.group, Signal::TERM);
            ends_within(self.group, TERMINATION);
        }
        let status = reap(&mut self.process, self.group);
        if let Some(log) = &self.log {
            self.output.settle();
            self.errors.settle();
            if let Some(status) = status {
                // Nobody is left who could be told.
                let _ = log.note(&format!("the process {}", how(status)));
            }
        }
        status
    }
}

impl Drop for Child {
    fn drop(&mut self) {
        if !self.reaped {
            self.end(FAREWELL);
        }
    }
}

/// Kills all that lives in the group; only then is its number given up.
pub(super) fn reap(process: &mut std::process::Child, group: Pid) -> Option<ExitStatus> {
    // A group of which only the dead leader is left cannot be killed everywhere.
    let _ = kill_process_group(group, Signal::KILL);
    registry::forget(group);
    process.wait().ok()
}

fn tail(source: Option<(OwnedFd, Stream)>, log: Option<&Log>) -> io::Result<Tail> {
    let (pipe, stream) = source.ok_or_else(|| io::Error::other("no pipe for what it prints"))?;
    Tail::of(File::from(pipe), log.map(|log| (log.clone(), stream)))
}

pub(super) fn how(status: ExitStatus) -> String {
    match (status.code(), status.signal()) {
        (Some(code), _) => format!("exited with code {code}"),
        (None, Some(signal)) => format!("was killed by signal {signal}"),
        (None, None) => "ended".into(),
    }
}
