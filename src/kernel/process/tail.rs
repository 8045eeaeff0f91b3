//! The end of what a child prints.

use super::log::{Log, Stream};
use std::collections::VecDeque;
use std::io::{self, Read};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

/// How many bytes are kept.
const KEPT: usize = 4096;
/// How many characters of a line are shown.
const SHOWN: usize = 200;
/// How long the last words of a child that is dead are waited for: its pipe is empty soon, unless a process that
/// left the group holds it open.
const PATIENCE: Duration = Duration::from_millis(500);

/// How many are being read.
static READING: AtomicUsize = AtomicUsize::new(0);

/// Waits for the last words of all children, which are dead.
pub(super) fn settle() {
    let deadline = Instant::now() + PATIENCE;
    while READING.load(Ordering::Acquire) > 0 && Instant::now() < deadline {
        thread::sleep(Duration::from_millis(1));
    }
}

/// Reads all that comes, so that nobody who prints is ever blocked, and keeps the end of it.
#[derive(Debug)]
pub(super) struct Tail {
    kept: Arc<Mutex<VecDeque<u8>>>,
    /// Hung up when all is read.
    reading: Receiver<()>,
}

impl Tail {
    /// Reads `source` to its end, in a thread of its own; all of it goes to the log, if there is one.
    pub(super) fn of(
        source: impl Read + Send + 'static,
        log: Option<(Log, Stream)>,
    ) -> io::Result<Tail> {
        let kept = Arc::new(Mutex::new(VecDeque::with_capacity(2 * KEPT)));
        let (busy, reading) = mpsc::channel();
        let into = Arc::clone(&kept);
        let drain = move || {
            drain(source, &into, log.as_ref());
            READING.fetch_sub(1, Ordering::Release);
            drop(busy);
        };
        READING.fetch_add(1, Ordering::Relaxed);
        let thread = thread::Builder::new().name("volver-drain".into());
        if let Err(error) = thread.spawn(drain) {
            READING.fetch_sub(1, Ordering::Relaxed);
            return Err(error);
        }
        Ok(Tail { kept, reading })
    }

    /// All that is kept.
    pub(super) fn text(&self) -> String {
        let kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
        let (first, second) = kept.as_slices();
        String::from_utf8_lossy(&[first, second].concat()).into_owned()
    }

    /// Waits for the last words of a child that is dead.
    pub(super) fn settle(&self) {
        // Hung up or given up: what is there is what there is.
        let _ = self.reading.recv_timeout(PATIENCE);
    }

    /// The last `count` lines of a child that is dead, cut short, without what a terminal would obey.
    pub(super) fn last_lines(&self, count: usize) -> String {
        self.settle();
        let text = self.text();
        let lines = text.lines().rev().map(shown);
        let mut last: Vec<String> = lines.filter(|line| !line.is_empty()).take(count).collect();
        last.reverse();
        last.join("\n")
    }
}

fn shown(line: &str) -> String {
    let mut shown: String = line.trim().chars().take(SHOWN).collect();
    shown.retain(|c| !c.is_control());
    shown
}

fn drain(mut source: impl Read, into: &Mutex<VecDeque<u8>>, log: Option<&(Log, Stream)>) {
    let mut chunk = [0; KEPT];
    loop {
        match source.read(&mut chunk) {
            Ok(0) => return,
            Ok(count) => {
                if let Some((log, stream)) = log {
                    // The next message fails as well, and says why.
                    let _ = log.keep(*stream, chunk.get(..count).unwrap_or_default());
                }
                let mut kept = into.lock().unwrap_or_else(PoisonError::into_inner);
                kept.extend(chunk.iter().take(count));
                let surplus = kept.len().saturating_sub(KEPT);
                kept.drain(..surplus);
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(_) => return,
        }
    }
}
