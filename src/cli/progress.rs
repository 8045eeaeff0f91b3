//! How far a run has come.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;
use volver::study::Progress;

/// What is done by then needs no line that says so.
const PATIENCE: Duration = Duration::from_secs(1);
/// How often such a line moves.
const TICK: Duration = Duration::from_millis(200);

/// A bar on the terminal, none where standard error is something else.
pub(crate) struct Bar(ProgressBar);

impl Bar {
    pub(crate) fn new(units: u64) -> Self {
        let bar = ProgressBar::new(units);
        let template = "{wide_bar} {percent:>3} %, {eta} left";
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Bar(bar)
    }

    /// What an earlier run has done tells nothing of the time that is left.
    pub(crate) fn skip(&self, units: u64) {
        self.0.inc(units);
        self.0.reset_eta();
    }

    /// Lets `print` write where the bar stands.
    pub(crate) fn above(&self, print: impl FnOnce()) {
        self.0.suspend(print);
    }

    pub(crate) fn finish(&self) {
        self.0.finish_and_clear();
    }
}

impl Progress for Bar {
    fn advance(&self, units: u64) {
        self.0.inc(units);
    }
}

/// Does what nobody knows the length of; where it takes longer than a second, a line on the terminal says what is
/// being done, and for how long already.
pub(crate) fn waiting<T>(what: &'static str, work: impl FnOnce() -> T) -> T {
    let (end, ended) = channel::<()>();
    let line = thread::spawn(move || {
        if ended.recv_timeout(PATIENCE) != Err(RecvTimeoutError::Timeout) {
            return;
        }
        let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg}, {elapsed}") {
            bar.set_style(style);
        }
        // The clock of the line is behind by what was waited for already.
        let bar = bar.with_elapsed(PATIENCE).with_message(what);
        bar.enable_steady_tick(TICK);
        // Nothing is ever sent: the channel closes.
        let _ = ended.recv();
        bar.finish_and_clear();
    });
    let done = work();
    drop(end);
    // A line that panicked has nothing more to say.
    let _ = line.join();
    done
}
