//! What time it is for one thread, and where the thread runs.

use std::time::Duration;

/// What the clock measures.
#[must_use]
pub fn clock_name() -> &'static str {
    if cfg!(target_os = "linux") {
        "processor time of the measuring thread"
    } else {
        "time by the wall clock"
    }
}

/// Time since some moment, of this thread alone where the system tells: what else runs here costs it nothing.
#[cfg(target_os = "linux")]
pub(super) fn now() -> Duration {
    use rustix::time::{ClockId, clock_gettime};
    let time = clock_gettime(ClockId::ThreadCPUTime);
    let seconds = u64::try_from(time.tv_sec).unwrap_or(0);
    Duration::from_secs(seconds) + Duration::from_nanos(u64::try_from(time.tv_nsec).unwrap_or(0))
}

/// Time since some moment.
#[cfg(not(target_os = "linux"))]
pub(super) fn now() -> Duration {
    use std::sync::LazyLock;
    use std::time::Instant;
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

/// The thread stays on the core where it is, if the system lets it, until this is dropped.
#[derive(Debug)]
pub struct Pin {
    #[cfg(target_os = "linux")]
    before: Option<rustix::thread::CpuSet>,
}

impl Pin {
    /// Pins this thread.
    #[cfg(target_os = "linux")]
    #[must_use]
    pub fn here() -> Pin {
        use rustix::thread::{CpuSet, sched_getaffinity, sched_getcpu, sched_setaffinity};
        let pinned = sched_getaffinity(None).ok().filter(|_| {
            let mut one = CpuSet::new();
            let core = sched_getcpu();
            // The system names no core that a set has no room for, but a set would not survive it.
            core < CpuSet::MAX_CPU && {
                one.set(core);
                sched_setaffinity(None, &one).is_ok()
            }
        });
        Pin { before: pinned }
    }

    /// Does nothing: there is no such thing here.
    #[cfg(not(target_os = "linux"))]
    #[must_use]
    pub fn here() -> Pin {
        Pin {}
    }

    /// Whether it worked.
    #[must_use]
    pub fn is_pinned(&self) -> bool {
        #[cfg(target_os = "linux")]
        return self.before.is_some();
        #[cfg(not(target_os = "linux"))]
        false
    }
}

#[cfg(target_os = "linux")]
impl Drop for Pin {
    fn drop(&mut self) {
        if let Some(before) = &self.before {
            // Where that fails the thread stays where it is: slower, not wrong.
            let _ = rustix::thread::sched_setaffinity(None, before);
        }
    }
}
