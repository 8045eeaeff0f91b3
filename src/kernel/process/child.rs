//! A child process: its start, its pipes, its end.

use super::pipes::Pipes;
use super::registry;
use super::tail::Tail;
use super::trouble::Trouble;
use crate::kernel::KernelError;
use command_fds::{CommandFdExt, FdMapping};
use rustix::io::Errno;
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process_group, waitid};
use std::io;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

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
/// How long it may take to end when it is told to.
const TERMINATION: Duration = Duration::from_millis(500);

/// A child that leads a process group. However it is left, nothing of the group lives on.
#[derive(Debug)]
pub(super) struct Child {
    process: std::process::Child,
    group: Pid,
    pipes: Pipes,
    output: Tail,
    errors: Tail,
    reaped: bool,
}

impl Child {
    pub(super) fn start(program: &str, arguments: &[String]) -> io::Result<Child> {
        let (requests, ours) = io::pipe()?;
        let (answers, theirs) = io::pipe()?;
        let pipes = Pipes::new(ours, answers)?;
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
        let tails = tail(process.stdout.take()).and_then(|output| {
            let errors = tail(process.stderr.take())?;
            Ok((output, errors))
        });
        match tails {
            Ok((output, errors)) => Ok(Child {
                process,
                group,
                pipes,
                output,
                errors,
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

    pub(super) fn exchange(
        &mut self,
        message: &[u8],
        deadline: Option<Instant>,
    ) -> Result<Vec<u8>, Trouble> {
        self.pipes.exchange(message, deadline)
    }

    /// Kills it for its trouble, which was met while `what` was waited for, and says what befell it.
    pub(super) fn fail(
        mut self,
        trouble: Trouble,
        what: &'static str,
        after: Duration,
    ) -> KernelError {
        let ended = matches!(trouble, Trouble::Closed(_)) && self.ends_within(ENDING);
        let status = self.kill();
        let stderr = self.errors.last_lines(LAST_LINES);
        match trouble {
            Trouble::TimedOut => KernelError::TimedOut {
                what,
                after,
                stderr,
            },
            Trouble::Closed(pipe) => KernelError::Exited {
                how: status
                    .filter(|_| ended)
                    .map_or_else(|| format!("closed its {pipe} pipe"), how),
                stderr,
            },
            Trouble::System(error) => KernelError::Exited {
                how: format!("cannot be talked to: {error}"),
                stderr,
            },
            Trouble::Garbage { problem, excerpt } => KernelError::Garbage {
                problem,
                excerpt,
                stderr,
            },
            Trouble::Greeting { problem } => KernelError::Greeting { problem, stderr },
            Trouble::WrongId { got, wanted } => KernelError::WrongId {
                got,
                wanted,
                stderr,
            },
        }
    }

    /// Whether it has ended, or does so in that time; it is not reaped, so that its number stays its own.
    fn ends_within(&self, time: Duration) -> bool {
        let deadline = Instant::now() + time;
        let look = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
        let mut pause = Duration::from_micros(100);
        loop {
            match waitid(WaitId::Pid(self.group), look) {
                // Or somebody else reaped it.
                Ok(Some(_)) | Err(Errno::CHILD) => return true,
                Ok(None) | Err(_) => {}
            }
            if Instant::now() >= deadline {
                return false;
            }
            thread::sleep(pause);
            pause = (2 * pause).min(Duration::from_millis(10));
        }
    }

    fn kill(&mut self) -> Option<ExitStatus> {
        self.reaped = true;
        self.pipes.close_requests();
        reap(&mut self.process, self.group)
    }
}

impl Drop for Child {
    /// Lets it end by itself, then tells it to, then kills it.
    fn drop(&mut self) {
        if self.reaped {
            return;
        }
        self.pipes.close_requests();
        if !self.ends_within(FAREWELL) {
            let _ = kill_process_group(self.group, Signal::TERM);
            self.ends_within(TERMINATION);
        }
        self.kill();
    }
}

/// Kills all that lives in the group; only then is its number given up.
fn reap(process: &mut std::process::Child, group: Pid) -> Option<ExitStatus> {
    // A group of which only the dead leader is left cannot be killed everywhere.
    let _ = kill_process_group(group, Signal::KILL);
    registry::forget(group);
    process.wait().ok()
}

fn tail(source: Option<impl io::Read + Send + 'static>) -> io::Result<Tail> {
    Tail::of(source.ok_or_else(|| io::Error::other("no pipe for what it prints"))?)
}

fn how(status: ExitStatus) -> String {
    match (status.code(), status.signal()) {
        (Some(code), _) => format!("exited with code {code}"),
        (None, Some(signal)) => format!("was killed by signal {signal}"),
        (None, None) => "ended".into(),
    }
}
