//! Whether a child has ended.

use rustix::io::Errno;
use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
use std::thread;
use std::time::{Duration, Instant};

/// How long it may take to end when it is told to by SIGTERM.
pub(super) const TERMINATION: Duration = Duration::from_millis(500);

/// Whether the leader of a group has ended, or does so in that time; it is not reaped, so that its number stays its
/// own.
pub(super) fn ends_within(leader: Pid, time: Duration) -> bool {
    let deadline = Instant::now() + time;
    let look = WaitIdOptions::EXITED | WaitIdOptions::NOHANG | WaitIdOptions::NOWAIT;
    let mut pause = Duration::from_micros(100);
    loop {
        match waitid(WaitId::Pid(leader), look) {
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
