//! What would be left behind if this process ended now: every child that lives, every directory.

use super::ending::{TERMINATION, ends_within};
use super::tail;
use rustix::process::{Pid, Signal, kill_process_group};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

struct Left {
    groups: Vec<Pid>,
    directories: Vec<PathBuf>,
    stopped: bool,
}

static LEFT: Mutex<Left> = Mutex::new(Left {
    groups: Vec::new(),
    directories: Vec::new(),
    stopped: false,
});

fn left() -> MutexGuard<'static, Left> {
    // Lists are whole at every moment: who panicked beside them did them no harm.
    LEFT.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Tells every child of every [`ProcessKernel`](super::ProcessKernel) to end, kills what does not within half a second
/// with its whole process group, removes their files, and lets none start any more: for handlers of Ctrl-C, before
/// the process ends. A terminal's own signal does not reach them, as each has a group of its own.
pub fn stop_all() {
    stop(&mut left());
}

/// The same, and ends this process: no thread that waits for a kernel hears of its end and tells of it.
pub fn stop_all_and_exit(code: i32) -> ! {
    // Held until the end: whoever gives up a child has to have it.
    let mut left = left();
    stop(&mut left);
    std::process::exit(code)
}

fn stop(left: &mut Left) {
    left.stopped = true;
    for group in &left.groups {
        let _ = kill_process_group(*group, Signal::TERM);
    }
    let deadline = Instant::now() + TERMINATION;
    for group in &left.groups {
        ends_within(*group, deadline.saturating_duration_since(Instant::now()));
        // One that is dead already needs no killing.
        let _ = kill_process_group(*group, Signal::KILL);
    }
    tail::settle();
    for directory in left.directories.drain(..) {
        let _ = std::fs::remove_dir_all(directory);
    }
}

/// Starts a child that leads a process group; nothing comes between the start and its being listed.
pub(super) fn spawn(command: &mut Command) -> io::Result<(Child, Pid)> {
    let mut left = left();
    if left.stopped {
        return Err(io::Error::other("all kernels are being stopped"));
    }
    let mut child = command.spawn()?;
    let id = i32::try_from(child.id()).ok().and_then(Pid::from_raw);
    let Some(group) = id else {
        let _ = child.kill();
        let _ = child.wait();
        return Err(io::Error::other("a process without an identity"));
    };
    left.groups.push(group);
    Ok((child, group))
}

/// To be called before the leader of the group is reaped: its number may be another's afterwards.
pub(super) fn forget(group: Pid) {
    left().groups.retain(|listed| *listed != group);
}

pub(super) fn hold_directory(path: &Path) {
    left().directories.push(path.into());
}

pub(super) fn forget_directory(path: &Path) {
    left().directories.retain(|listed| listed != path);
}
